// SPDX-License-Identifier: MIT
//
// The lights of a frame as the shaders take them, with an exposure that suits them, in rounds of
// eight.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/render/renderer.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/shadows/view.hpp>

namespace gnomon::render::internal {

/// As many as a light mask of eight bits tells apart.
inline constexpr std::size_t lights_a_round = 8;

// std140, as in frame.glsl.
struct LightUniforms {
    glm::vec4 light_view;
    glm::vec4 color;
    glm::vec4 spot_axis;
    glm::vec4 spot_range;
};
struct RoundUniforms {
    glm::vec4 sky;
    glm::vec4 ground;
    glm::vec4 up_view;
    glm::vec4 depth_range;
    glm::uvec4 lit_by{0};
    std::array<LightUniforms, lights_a_round> lights;
};

struct FrameLight {
    LightUniforms uniforms;
    /// Its place in the draw list; none: it is lit without shadow.
    std::optional<std::size_t> draws;
    /// Whether it may light anything that the view shows.
    bool in_view = true;
};

/// One per entry of `lights` and then of `unshadowed`, in their order. glTF's units go in (lux,
/// candela); what comes out is scaled by `exposure`, or without it so that the strongest light on
/// the scene exposes a white surface well.
[[nodiscard]] std::vector<FrameLight> frame_lights(const scene::Scene& scene,
                                                   const scene::Bounds& bounds,
                                                   std::span<const shadows::LightDraws> lights,
                                                   std::span<const scene::Entity> unshadowed,
                                                   const shadows::View& view,
                                                   std::optional<float> exposure);

/// Of `lights`, at most lights_a_round. `first`: what comes without a light is in it.
[[nodiscard]] RoundUniforms round_uniforms(const shadows::View& view,
                                           std::span<const FrameLight> lights,
                                           const Environment& environment, bool first);

}  // namespace gnomon::render::internal
