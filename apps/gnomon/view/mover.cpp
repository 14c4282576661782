// SPDX-License-Identifier: MIT
#include "view/mover.hpp"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace gnomon::cli {

namespace {

glm::dmat4 about(const glm::dvec3& pivot, const glm::dmat4& rotation) {
    return glm::translate(glm::dmat4(1.0), pivot) * rotation *
           glm::translate(glm::dmat4(1.0), -pivot);
}

bool is_finite(const glm::dmat4& m) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(m[column][row])) return false;
        }
    }
    return true;
}

// Without scale; of a mirror, the rotation that is left after one axis is turned round.
glm::dquat rotation_of(const glm::dmat4& m) {
    glm::dmat3 axes(glm::normalize(glm::dvec3(m[0])), glm::normalize(glm::dvec3(m[1])),
                    glm::normalize(glm::dvec3(m[2])));
    if (glm::determinant(axes) < 0.0) axes[0] = -axes[0];
    return glm::normalize(glm::quat_cast(axes));
}

}  // namespace

void move_node(scene::Registry& registry, scene::Entity entity,
               const scene::LocalTransform& start_local, const glm::dmat4& motion_world) {
    glm::dmat4 world_from_parent(1.0);
    if (const auto* parent = registry.try_get<scene::Parent>(entity)) {
        if (const auto* world = registry.try_get<scene::WorldTransform>(parent->value)) {
            world_from_parent = world->world_from_local;
        }
    }
    const glm::dmat4 motion_parent =
        glm::inverse(world_from_parent) * motion_world * world_from_parent;
    if (!is_finite(motion_parent)) return;
    scene::LocalTransform moved = start_local;
    if (start_local.matrix) {
        moved.matrix = motion_parent * *start_local.matrix;
    } else {
        moved.translation = glm::dvec3(motion_parent * glm::dvec4(start_local.translation, 1.0));
        moved.rotation = glm::normalize(rotation_of(motion_parent) * start_local.rotation);
    }
    registry.get<scene::LocalTransform>(entity) = moved;
}

std::optional<glm::dvec3> dragged_in_plane(const panel::Ray& ray, const glm::dvec3& grabbed,
                                           const glm::dvec3& plane_normal) {
    const double along = glm::dot(ray.direction_world, plane_normal);
    // Nearer to the plane than this a pixel would be a mile.
    if (std::abs(along) < 0.02) return std::nullopt;
    const double t = glm::dot(grabbed - ray.origin_world, plane_normal) / along;
    if (!(t > 0.0)) return std::nullopt;
    return ray.origin_world + ray.direction_world * t - grabbed;
}

glm::dmat4 turned_about(const glm::dvec3& pivot, const glm::dvec3& picture_right, double yaw_rad,
                        double pitch_rad) {
    return about(pivot, glm::rotate(glm::dmat4(1.0), yaw_rad, glm::dvec3(0.0, 1.0, 0.0)) *
                            glm::rotate(glm::dmat4(1.0), pitch_rad, picture_right));
}

glm::dmat4 turned_towards(const glm::dvec3& pivot, const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 a = glm::normalize(from);
    const glm::dvec3 b = glm::normalize(to);
    const glm::dvec3 axis = glm::cross(a, b);
    const double sine = glm::length(axis);
    if (!(sine > 1e-12)) return glm::dmat4(1.0);
    return about(pivot,
                 glm::rotate(glm::dmat4(1.0), std::atan2(sine, glm::dot(a, b)), axis / sine));
}

}  // namespace gnomon::cli
