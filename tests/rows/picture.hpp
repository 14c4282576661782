// SPDX-License-Identifier: MIT
//
// Draws a row on a device and brings back what suites compare: the raw stencil of every light, and
// the depth buffer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/render/renderer.hpp>
#include <gnomon/shadows/shadow_system.hpp>

#include "tests/rows/rows.hpp"

namespace gnomon::test {

struct PictureOptions {
    std::uint32_t width = row_width;
    std::uint32_t height = row_height;
    std::uint32_t samples = 1;
    gpu::Format depth_stencil_format = gpu::Format::Depth32FloatStencil8;
    shadow_pass::ExtrusionPath extrusion = shadow_pass::ExtrusionPath::VertexShader;
    std::optional<shadows::Technique> technique = std::nullopt;
    shadows::NearCaps near_caps = shadows::NearCaps::Facing;
    shadow_pass::AvertedFaces averted_faces = shadow_pass::AvertedFaces::Shadowed;
    std::uint32_t max_layers = 255;
    shadows::LayerBound layer_bound = shadows::LayerBound::Proved;
    shadows::CapOptions caps = {};
    shadows::Receivers receivers = shadows::Receivers::Submitted;
    shadows::FillOptions fill = {};
    std::string silhouette = "auto";
    /// Frames before the one that is drawn, in which the lights come to their places in small
    /// steps: for strategies that remember.
    int approach_frames = 0;
    bool cull_back_faces = false;
    gpu::Compare volume_depth_compare = gpu::Compare::Greater;
    std::function<void(shadows::DrawList&)> mutate =
        {};  ///< spoils the volumes before they are drawn
};

struct Picture {
    /// [light][sample]: one byte a pixel, row 0 on top.
    std::vector<std::vector<std::vector<std::uint8_t>>> masks;
    std::vector<std::uint8_t> depth;  ///< raw bytes of the floats; empty when multisampled
    shadows::DrawList list;
};

[[nodiscard]] Result<Picture> take_picture(gpu::Device& device, const Setting& setting,
                                           const PictureOptions& options);

/// How many bytes differ.
[[nodiscard]] std::size_t differing_bytes(std::span<const std::uint8_t> a,
                                          std::span<const std::uint8_t> b);

/// Writes actual, expected and difference as PGM files under the build's test-output folder and
/// says where.
std::string save_difference(const std::string& name, std::uint32_t width, std::uint32_t height,
                            std::span<const std::uint8_t> actual,
                            std::span<const std::uint8_t> expected);

}  // namespace gnomon::test
