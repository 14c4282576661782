// SPDX-License-Identifier: MIT
//
// What a drag does to a light or a caster: a motion in the world, from where it was when the drag
// began.
#pragma once

#include <optional>

#include <glm/glm.hpp>

#include <gnomon/panel/picker.hpp>
#include <gnomon/scene/scene.hpp>

namespace gnomon::cli {

enum class MoveMode { Translate, Rotate };

/// Moves the node so that its world pose becomes motion_world * start. Translation and rotation
/// stay apart where the node has them so, so that animations may go on with the others; the
/// parent's scale is then taken for even. Where the parent has no inverse nothing happens. World
/// transforms are not updated.
void move_node(scene::Registry& registry, scene::Entity entity,
               const scene::LocalTransform& start_local, const glm::dmat4& motion_world);

/// From the point where the drag began to the point under the mouse, in the plane through it with
/// this normal. Nothing where the ray does not meet the plane in front of the eye.
[[nodiscard]] std::optional<glm::dvec3> dragged_in_plane(const panel::Ray& ray,
                                                         const glm::dvec3& grabbed,
                                                         const glm::dvec3& plane_normal);

/// By yaw about the world's up and pitch about the picture's right, about `pivot`.
[[nodiscard]] glm::dmat4 turned_about(const glm::dvec3& pivot, const glm::dvec3& picture_right,
                                      double yaw_rad, double pitch_rad);

/// The shortest rotation about `pivot` that takes one direction from there into the other.
[[nodiscard]] glm::dmat4 turned_towards(const glm::dvec3& pivot, const glm::dvec3& from,
                                        const glm::dvec3& to);

}  // namespace gnomon::cli
