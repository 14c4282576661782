// SPDX-License-Identifier: MIT
#include <gnomon/render/camera.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::render {

shadows::View make_view(const scene::Camera& camera, const glm::dmat4& world_from_camera,
                        double aspect, double near_m) {
    glm::dmat4 pose(1.0);
    for (int i = 0; i < 3; ++i)
        pose[i] = glm::dvec4(glm::normalize(glm::dvec3(world_from_camera[i])), 0.0);
    pose[3] = world_from_camera[3];
    shadows::View view;
    view.view_from_world = glm::inverse(pose);
    if (const auto* perspective = std::get_if<scene::PerspectiveCamera>(&camera.projection)) {
        view.clip_from_view = shadows::infinite_perspective(
            perspective->fovy_rad, aspect, near_m > 0.0 ? near_m : perspective->near_m);
        view.projection = shadows::ProjectionKind::InfinitePerspective;
    } else {
        const auto& box = std::get<scene::OrthographicCamera>(camera.projection);
        // The file's height counts; the width follows the picture.
        view.clip_from_view = shadows::orthographic(box.half_height_m * aspect, box.half_height_m,
                                                    box.near_m, box.far_m);
        view.projection = shadows::ProjectionKind::Orthographic;
    }
    return view;
}

glm::dmat4 camera_pose(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up) {
    glm::dvec3 true_up = up;
    // Looking straight along `up` leaves the roll open: any horizontal axis will do.
    if (glm::length(glm::cross(up, eye - target)) <=
        1e-9 * glm::length(up) * glm::length(eye - target)) {
        true_up = std::abs(up.z) < std::abs(up.y) ? glm::dvec3(0.0, 0.0, -1.0)
                                                  : glm::dvec3(0.0, 1.0, 0.0);
    }
    return glm::inverse(shadows::look_at(eye, target, true_up));
}

glm::dmat4 frame_bounds(const scene::Bounds& bounds, double fovy_rad, double aspect) {
    const glm::dvec3 center = bounds.empty() ? glm::dvec3(0.0) : bounds.center();
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.62, 0.52, 1.0));
    const glm::dvec3 size = bounds.empty() ? glm::dvec3(1.0) : bounds.max - bounds.min;
    const glm::dmat4 turned = camera_pose(center + direction, center, {0.0, 1.0, 0.0});
    const glm::dmat3 view_from_world = glm::transpose(glm::dmat3(turned));
    // Far enough that every corner of the box is inside the frustum, with a little air.
    const double tan_y = std::tan(fovy_rad * 0.5) * 0.92;
    const double tan_x = tan_y * aspect;
    double distance = 1e-6;
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3 corner = size * 0.5 *
                                  glm::dvec3((i & 1U) != 0 ? 1.0 : -1.0, (i & 2U) != 0 ? 1.0 : -1.0,
                                             (i & 4U) != 0 ? 1.0 : -1.0);
        const glm::dvec3 v = view_from_world * corner;
        distance = std::max({distance, v.z + std::abs(v.x) / tan_x, v.z + std::abs(v.y) / tan_y});
    }
    return camera_pose(center + direction * distance, center, {0.0, 1.0, 0.0});
}

}  // namespace gnomon::render
