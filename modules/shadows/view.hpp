// SPDX-License-Identifier: MIT
//
// View: where a picture is taken from, as the choice between depth-pass and depth-fail needs it;
// and the makers of projection matrices. Clip space is WebGPU's (y up, z in 0..1); depth is
// reversed: 1 at the near plane, 0 far away.
#pragma once

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// What far vertices have to be like.
enum class ProjectionKind : std::uint8_t {
    InfinitePerspective,  ///< no far plane: a point at infinity lands at depth exactly 0
    FinitePerspective,    ///< with a far plane
    Orthographic,         ///< parallel, with a far plane
};

/// Where a picture is taken from.
struct View {
    glm::dmat4 view_from_world{1.0};  ///< rigid; the camera looks along -Z
    glm::dmat4 clip_from_view{1.0};   ///< clip space as WebGPU has it, depth reversed
    ProjectionKind projection = ProjectionKind::InfinitePerspective;  ///< that of clip_from_view

    /// Multiplied in double precision.
    [[nodiscard]] glm::dmat4 clip_from_world() const { return clip_from_view * view_from_world; }
};

/// Reversed depth, no far plane. fovy in radians, aspect = width / height, near plane in metres >
/// 0.
[[nodiscard]] glm::dmat4 infinite_perspective(double fovy_rad, double aspect, double near_m);
/// The same for an off-axis frustum: its rectangle on the near plane.
[[nodiscard]] glm::dmat4 infinite_frustum(double left, double right, double bottom, double top,
                                          double near_m);
/// Reversed depth, near at 1, far at 0.
[[nodiscard]] glm::dmat4 finite_perspective(double fovy_rad, double aspect, double near_m,
                                            double far_m);
/// Reversed depth, near at 1, far at 0; near may be negative.
[[nodiscard]] glm::dmat4 orthographic(double half_width_m, double half_height_m, double near_m,
                                      double far_m);
/// Rigid view matrix; `up` must not be parallel to the line of sight.
[[nodiscard]] glm::dmat4 look_at(const glm::dvec3& eye, const glm::dvec3& target,
                                 const glm::dvec3& up);

/// True where triangles that are counter-clockwise as seen by the eye are clockwise on the screen:
/// y points down, or the world is mirrored. Front and back of what is drawn exchange.
[[nodiscard]] bool is_mirrored(const View& view);

/// The corners of the near rectangle (depth 1) in world space, in order round it.
[[nodiscard]] std::array<glm::dvec3, 4> near_corners(const View& view);
/// The corners of the far rectangle (depth 0). Not for an infinite perspective.
[[nodiscard]] std::array<glm::dvec3, 4> far_corners(const View& view);

}  // namespace gnomon::shadows
#pragma GCC visibility pop
