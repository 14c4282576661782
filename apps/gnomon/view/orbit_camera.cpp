// SPDX-License-Identifier: MIT
#include "view/orbit_camera.hpp"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/render/camera.hpp>

namespace gnomon::cli {

namespace {

constexpr glm::dvec3 world_up{0.0, 1.0, 0.0};
/// Nearest to straight up or down that one may look, in radians.
constexpr double pole_rad = 0.01;

}  // namespace

double Canvas::free_aspect() const {
    const double width = std::max(1.0, size_px.x - covered_left_px);
    return width / std::max(1U, size_px.y);
}

OrbitCamera::OrbitCamera(const scene::Camera& camera, const glm::dmat4& world_from_camera,
                         double near_m, const scene::Bounds& bounds)
    : camera_(camera), pose_(world_from_camera), near_m_(near_m) {
    scene_m_ = std::max(bounds.diagonal(), 1e-6);
    const glm::dvec3 middle = bounds.empty() ? pivot() : bounds.center();
    pivot_m_ = std::max(glm::dot(middle - eye(), forward()), 0.05 * scene_m_);
}

void OrbitCamera::orbit(double yaw_rad, double pitch_rad) {
    const glm::dvec3 center = pivot();
    // From the horizon; a camera that rolls has none of the usual meaning, and turns all the same.
    const double pitch = std::asin(std::clamp(forward().y, -1.0, 1.0));
    const double limit = glm::half_pi<double>() - pole_rad;
    const double turned =
        std::clamp(pitch + pitch_rad, std::min(-limit, pitch), std::max(limit, pitch)) - pitch;
    const glm::dvec3 right(pose_[0]);
    const glm::dmat4 rotation = glm::rotate(glm::dmat4(1.0), yaw_rad, world_up) *
                                glm::rotate(glm::dmat4(1.0), turned, right);
    pose_ = rotation * pose_;
    // Rotations add up; their roundings had better not.
    const glm::dvec3 back = glm::normalize(glm::dvec3(pose_[2]));
    const glm::dvec3 across = glm::normalize(glm::cross(glm::dvec3(pose_[1]), back));
    pose_[0] = glm::dvec4(across, 0.0);
    pose_[1] = glm::dvec4(glm::cross(back, across), 0.0);
    pose_[2] = glm::dvec4(back, 0.0);
    pose_[3] = glm::dvec4(center + back * pivot_m_, 1.0);
}

double OrbitCamera::metres_per_pixel(const Canvas& canvas) const {
    const double height = std::max(1U, canvas.size_px.y);
    if (const auto* lens = std::get_if<scene::PerspectiveCamera>(&camera_.projection)) {
        return 2.0 * pivot_m_ * std::tan(lens->fovy_rad / 2.0) / height;
    }
    return 2.0 * std::get<scene::OrthographicCamera>(camera_.projection).half_height_m / height;
}

void OrbitCamera::pan(const glm::dvec2& motion_px, const Canvas& canvas) {
    const double scale = metres_per_pixel(canvas);
    const glm::dvec3 moved =
        glm::dvec3(pose_[1]) * (motion_px.y * scale) - glm::dvec3(pose_[0]) * (motion_px.x * scale);
    pose_[3] += glm::dvec4(moved, 0.0);
}

void OrbitCamera::zoom(double notches) {
    const double factor = std::pow(0.9, notches);
    if (auto* box = std::get_if<scene::OrthographicCamera>(&camera_.projection)) {
        // What a file's camera shows may lie beyond the limits; it comes back from there.
        const double before = box->half_height_m;
        const double after = std::clamp(before * factor, std::min(before, 1e-3 * scene_m_),
                                        std::max(before, 1e3 * scene_m_));
        box->half_width_m *= after / before;
        box->half_height_m = after;
        return;
    }
    const glm::dvec3 center = pivot();
    pivot_m_ = std::clamp(pivot_m_ * factor, 1e-3 * scene_m_, 1e3 * scene_m_);
    pose_[3] = glm::dvec4(center - forward() * pivot_m_, 1.0);
}

void OrbitCamera::frame(const scene::Bounds& bounds, const Canvas& canvas, bool standard_view) {
    if (bounds.empty()) return;
    const auto* lens = std::get_if<scene::PerspectiveCamera>(&camera_.projection);
    const double fovy_rad = lens != nullptr ? lens->fovy_rad : glm::radians(45.0);
    const double aspect = canvas.free_aspect();
    if (standard_view) pose_ = render::frame_bounds(bounds, fovy_rad, aspect);
    const glm::dmat3 camera_from_world = glm::transpose(glm::dmat3(pose_));
    const glm::dvec3 size = bounds.max - bounds.min;
    const double tan_y = std::tan(fovy_rad / 2.0) * 0.95;
    double distance = 1e-6;
    glm::dvec2 half(0.0);
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3 corner = size * 0.5 *
                                  glm::dvec3((i & 1U) != 0 ? 1.0 : -1.0, (i & 2U) != 0 ? 1.0 : -1.0,
                                             (i & 4U) != 0 ? 1.0 : -1.0);
        const glm::dvec3 v = camera_from_world * corner;
        distance = std::max(
            {distance, v.z + std::abs(v.x) / (tan_y * aspect), v.z + std::abs(v.y) / tan_y});
        half = glm::max(half, glm::abs(glm::dvec2(v)));
    }
    if (auto* box = std::get_if<scene::OrthographicCamera>(&camera_.projection)) {
        box->half_height_m = std::max({half.y, half.x / aspect, 1e-6}) * 1.05;
    }
    pivot_m_ = distance;
    pose_[3] = glm::dvec4(bounds.center() - forward() * distance, 1.0);
}

shadows::View OrbitCamera::view(const Canvas& canvas) const {
    const glm::dvec2 size(glm::max(canvas.size_px, glm::uvec2(1)));
    shadows::View view = render::make_view(camera_, pose_, size.x / size.y, near_m_);
    // An off-axis frustum: what was in the middle of the picture goes to the middle of what is
    // free.
    const double shift = canvas.covered_left_px / size.x;
    view.clip_from_view =
        glm::translate(glm::dmat4(1.0), glm::dvec3(shift, 0.0, 0.0)) * view.clip_from_view;
    return view;
}

}  // namespace gnomon::cli
