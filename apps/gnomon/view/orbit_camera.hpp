// SPDX-License-Identifier: MIT
//
// The viewer's camera: it goes round a point, along the picture and towards what it looks at.
#pragma once

#include <glm/glm.hpp>

#include <gnomon/scene/scene.hpp>
#include <gnomon/shadows/view.hpp>

namespace gnomon::cli {

/// The part of the window that the panel leaves free: the scene's middle is in its middle.
struct Canvas {
    glm::uvec2 size_px{1, 1};
    double covered_left_px = 0.0;

    [[nodiscard]] double free_aspect() const;
};

class OrbitCamera {
public:
    OrbitCamera() = default;
    /// `world_from_camera` is rigid. It goes round the point at the depth of the middle of
    /// `bounds`.
    OrbitCamera(const scene::Camera& camera, const glm::dmat4& world_from_camera, double near_m,
                const scene::Bounds& bounds);

    /// Round the pivot: by yaw about the world's up, by pitch about the picture's right; it does
    /// not go over the poles.
    void orbit(double yaw_rad, double pitch_rad);
    /// What lies at the pivot's depth follows the mouse.
    void pan(const glm::dvec2& motion_px, const Canvas& canvas);
    /// Towards the pivot by a tenth of the distance a notch.
    void zoom(double notches);
    /// All of `bounds` in the free part of the canvas, seen from where it looks now, or from the
    /// standard three-quarter view.
    void frame(const scene::Bounds& bounds, const Canvas& canvas, bool standard_view);

    [[nodiscard]] shadows::View view(const Canvas& canvas) const;
    [[nodiscard]] const glm::dmat4& world_from_camera() const { return pose_; }
    [[nodiscard]] glm::dvec3 eye() const { return glm::dvec3(pose_[3]); }
    [[nodiscard]] glm::dvec3 forward() const { return -glm::dvec3(pose_[2]); }
    [[nodiscard]] glm::dvec3 pivot() const { return eye() + forward() * pivot_m_; }

private:
    // Metres a pixel at the pivot's depth.
    [[nodiscard]] double metres_per_pixel(const Canvas& canvas) const;

    scene::Camera camera_;
    glm::dmat4 pose_{1.0};
    double near_m_ = 0.01;
    double pivot_m_ = 1.0;
    double scene_m_ = 1.0;
};

}  // namespace gnomon::cli
