// SPDX-License-Identifier: MIT
//
// From a camera of the scene, or from none at all, to the View that a picture is taken with.
#pragma once

#include <gnomon/scene/scene.hpp>
#include <gnomon/shadows/view.hpp>

#pragma GCC visibility push(default)
namespace gnomon::render {

/// The view of a camera component at a pose (its scale is taken out). `near_m` > 0 overrides a
/// perspective's own.
[[nodiscard]] shadows::View make_view(const scene::Camera& camera,
                                      const glm::dmat4& world_from_camera, double aspect,
                                      double near_m = 0.0);

/// A three-quarter view from above that holds the whole of `bounds`.
[[nodiscard]] glm::dmat4 frame_bounds(const scene::Bounds& bounds, double fovy_rad, double aspect);

/// World pose of a camera at `eye` that looks at `target`.
[[nodiscard]] glm::dmat4 camera_pose(const glm::dvec3& eye, const glm::dvec3& target,
                                     const glm::dvec3& up);

}  // namespace gnomon::render
#pragma GCC visibility pop
