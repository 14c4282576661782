// SPDX-License-Identifier: MIT
#include <gnomon/shadows/view.hpp>

#include <cmath>

namespace gnomon::shadows {

namespace {

std::array<glm::dvec3, 4> corners_at_depth(const View& view, double depth) {
    const glm::dmat4 world_from_clip = glm::inverse(view.clip_from_world());
    std::array<glm::dvec3, 4> corners;
    const std::array<glm::dvec2, 4> ndc{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec4 p = world_from_clip * glm::dvec4(ndc[i], depth, 1.0);
        corners[i] = glm::dvec3(p) / p.w;
    }
    return corners;
}

}  // namespace

glm::dmat4 infinite_frustum(double left, double right, double bottom, double top, double near_m) {
    glm::dmat4 m(0.0);
    m[0][0] = 2.0 * near_m / (right - left);
    m[1][1] = 2.0 * near_m / (top - bottom);
    m[2][0] = (right + left) / (right - left);
    m[2][1] = (top + bottom) / (top - bottom);
    m[2][3] = -1.0;
    m[3][2] = near_m;
    return m;
}

glm::dmat4 infinite_perspective(double fovy_rad, double aspect, double near_m) {
    const double half_height = near_m * std::tan(fovy_rad * 0.5);
    const double half_width = half_height * aspect;
    return infinite_frustum(-half_width, half_width, -half_height, half_height, near_m);
}

glm::dmat4 finite_perspective(double fovy_rad, double aspect, double near_m, double far_m) {
    glm::dmat4 m = infinite_perspective(fovy_rad, aspect, near_m);
    m[2][2] = near_m / (far_m - near_m);
    m[3][2] = near_m * far_m / (far_m - near_m);
    return m;
}

glm::dmat4 orthographic(double half_width_m, double half_height_m, double near_m, double far_m) {
    glm::dmat4 m(1.0);
    m[0][0] = 1.0 / half_width_m;
    m[1][1] = 1.0 / half_height_m;
    m[2][2] = 1.0 / (far_m - near_m);
    m[3][2] = far_m / (far_m - near_m);
    return m;
}

glm::dmat4 look_at(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up) {
    const glm::dvec3 back = glm::normalize(eye - target);
    const glm::dvec3 right = glm::normalize(glm::cross(up, back));
    const glm::dvec3 true_up = glm::cross(back, right);
    glm::dmat4 m(1.0);
    for (int i = 0; i < 3; ++i) {
        m[i][0] = right[i];
        m[i][1] = true_up[i];
        m[i][2] = back[i];
    }
    m[3] = glm::dvec4(-glm::dot(right, eye), -glm::dot(true_up, eye), -glm::dot(back, eye), 1.0);
    return m;
}

bool is_mirrored(const View& view) {
    const glm::dmat4& clip = view.clip_from_view;
    const double turn = clip[0][0] * clip[1][1] - clip[1][0] * clip[0][1];
    return turn * glm::determinant(glm::dmat3(view.view_from_world)) < 0.0;
}

std::array<glm::dvec3, 4> near_corners(const View& view) { return corners_at_depth(view, 1.0); }
std::array<glm::dvec3, 4> far_corners(const View& view) { return corners_at_depth(view, 0.0); }

}  // namespace gnomon::shadows
