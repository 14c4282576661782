// SPDX-License-Identifier: MIT
//
// How a light's shadow map is taken: fitted to what is seen and can be shadowed, as one would in a
// renderer, so that its texels are not spent elsewhere.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/scene/scene.hpp>
#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/view.hpp>

namespace gnomon::report::internal {

/// Corners of what is seen of a box, in the world: of the part of it within the view. Empty where
/// that is none. Any perspective that is infinite.
[[nodiscard]] std::vector<glm::dvec3> seen_part(const scene::Bounds& box,
                                                const shadows::View& view);

/// The eight corners of a posed box.
[[nodiscard]] std::array<glm::dvec3, 8> corners_of(const scene::Bounds& box,
                                                   const glm::dmat4& world_from_box);

/// Whether all of these corners lie beyond one of the four sides of a clip space, or nearer than
/// its near plane.
[[nodiscard]] bool is_outside(const std::array<glm::dvec3, 8>& corners,
                              const glm::dmat4& clip_from_world);

struct Projector {
    bool cube = false;
    glm::dmat4 receiver_from_world{1.0};  ///< into clip space, or relative to the light
    /// One a face: reversed depth, infinite for point lights. Without a face: nothing seen can be
    /// in shadow.
    std::vector<glm::dmat4> clip_from_world = {};
    std::vector<std::uint8_t> is_needed = {};  ///< by face: something is seen there
    double near_m = 0.0;
    /// A texel's width, in the map's depth for a directional light, as a share of the distance for
    /// a point light.
    double texel = 0.0;
};

/// What a map needs to know of a frame.
struct Fitting {
    std::span<const glm::dvec3> seen;  ///< seen_part() of the receivers
    scene::Bounds casters;
    glm::dvec3 view_forward{0.0, 0.0, -1.0};
    double scale_m = 1.0;  ///< the scene's diagonal
    std::uint32_t size = 1024;
};

/// A directional light: an orthographic map. A point light: one perspective map where all that is
/// seen lies within 60 degrees of some direction, else a cube.
[[nodiscard]] Projector fit_projector(const shadows::Light& light, const Fitting& fitting);

}  // namespace gnomon::report::internal
