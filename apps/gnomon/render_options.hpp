// SPDX-License-Identifier: MIT
//
// What `gnomon render` was asked for, already understood.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/shadows/technique.hpp>

#include "arguments.hpp"

namespace gnomon::cli {

struct RenderOptions {
    std::string scene;
    std::filesystem::path out = {};
    std::string stencil_prefix = {};
    std::filesystem::path stats = {};
    bool meter = false;
    std::string backend = {};
    std::string gl_stencil = {};
    Size size = {};
    std::uint32_t samples = 1;
    std::optional<glm::dvec3> eye = std::nullopt;
    std::optional<glm::dvec3> target = std::nullopt;
    glm::dvec3 up{0.0, 1.0, 0.0};
    std::optional<double> fovy_deg = std::nullopt;
    std::vector<LightArgument> lights = {};
    std::optional<std::uint32_t> max_shadowed_lights = std::nullopt;
    std::optional<std::string> casters = std::nullopt;    ///< glob; none: all
    std::optional<std::string> receivers = std::nullopt;  ///< glob; none: all
    bool cull_back = false;
    std::optional<shadows::Technique> technique = std::nullopt;
    shadows::NearCaps near_caps = shadows::NearCaps::Facing;
    std::string silhouette = "auto";
    shadows::LayerBound layer_bound = shadows::LayerBound::Proved;
    shadows::FillOptions fill = {};
    render::Overlays overlays = {};
    std::uint32_t frames = 1;
    Motion motion = {};
    std::optional<double> time_s = std::nullopt;          ///< none: as the file's nodes stand
    std::optional<std::string> animation = std::nullopt;  ///< name or number; none: the first
    std::optional<double> near_m = std::nullopt;
    bool quiet = false;
};

/// Runs it. Writes its files only after the last frame.
[[nodiscard]] Status run_render(const RenderOptions& options);

}  // namespace gnomon::cli
