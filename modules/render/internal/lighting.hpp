// SPDX-License-Identifier: MIT
//
// The lights of a frame as the shaders take them, with an exposure that suits them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/scene/scene.hpp>
#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/shadows/view.hpp>

namespace gnomon::render::internal {

// std140, as in ambient.frag and light.frag.
struct AmbientUniforms {
    glm::vec4 sky;
    glm::vec4 ground;
    glm::vec4 up_view;
    glm::vec4 depth_range;
};
struct LightUniforms {
    glm::vec4 light_view;
    glm::vec4 color;
    glm::vec4 spot_axis;
    glm::vec4 spot_range;
    glm::vec4 depth_range;
};

struct FrameLight {
    LightUniforms uniforms;
    glm::dvec4 position_world{0.0};
    double range_m = 0.0;  ///< 0: none
};

/// One per entry of `lights`, in their order. glTF's units go in (lux, candela); what comes out is
/// scaled so that the strongest light on the scene exposes a white surface well.
[[nodiscard]] std::vector<FrameLight> frame_lights(const scene::Scene& scene,
                                                   const scene::Bounds& bounds,
                                                   std::span<const shadows::LightDraws> lights,
                                                   const shadows::View& view);

[[nodiscard]] AmbientUniforms ambient_uniforms(const shadows::View& view);

}  // namespace gnomon::render::internal
