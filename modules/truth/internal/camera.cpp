// SPDX-License-Identifier: MIT
#include "internal/camera.hpp"

#include <algorithm>

#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace gnomon::truth::internal {

namespace {

Plane normalized(const glm::dvec4& equation) {
    const double length = glm::length(glm::dvec3(equation));
    return {glm::dvec3(equation) / length, equation.w / length};
}

}  // namespace

Camera Camera::of(const shadows::View& view, const glm::dvec3& origin) {
    const glm::dmat4 clip_from_relative =
        view.clip_from_view * (view.view_from_world * glm::translate(glm::dmat4(1.0), origin));
    Camera camera;
    camera.row_x = glm::row(clip_from_relative, 0);
    camera.row_y = glm::row(clip_from_relative, 1);
    camera.row_w = glm::row(clip_from_relative, 3);
    const glm::dvec4 row_z = glm::row(clip_from_relative, 2);
    camera.depth = normalized(camera.row_w - row_z);

    const glm::dvec3 x(camera.row_x);
    const glm::dvec3 y(camera.row_y);
    const glm::dvec3 w(camera.row_w);
    if (view.projection == shadows::ProjectionKind::Orthographic) {
        const glm::dvec3 along = glm::normalize(glm::cross(x, y));
        const bool into_view = glm::dot(along, camera.depth.normal) > 0.0;
        camera.eye = glm::dvec4(into_view ? -along : along, 0.0);
    } else {
        const glm::dmat3 equations = glm::transpose(glm::dmat3(x, y, w));
        const glm::dvec3 right(camera.row_x.w, camera.row_y.w, camera.row_w.w);
        camera.eye = glm::dvec4(-(glm::inverse(equations) * right), 1.0);
    }
    camera.far_depth = std::numeric_limits<double>::infinity();
    if (view.projection != shadows::ProjectionKind::InfinitePerspective) {
        const Plane before_far = normalized(row_z);
        camera.far_depth = camera.depth.at(-before_far.offset * before_far.normal);
    }
    return camera;
}

Beam Camera::beam(const glm::dvec2& ndc_min, const glm::dvec2& ndc_max) const {
    Beam beam;
    beam.apex = eye;
    beam.add_side(normalized(row_x - ndc_min.x * row_w));
    beam.add_side(normalized(ndc_max.x * row_w - row_x));
    beam.add_side(normalized(row_y - ndc_min.y * row_w));
    beam.add_side(normalized(ndc_max.y * row_w - row_y));
    beam.height = depth;
    beam.highest = far_depth;
    return beam;
}

double Camera::width_at(const Beam& beam, const glm::dvec3& x) {
    return std::min(beam.sides[0].at(x) + beam.sides[1].at(x),
                    beam.sides[2].at(x) + beam.sides[3].at(x));
}

double Camera::contact_m(const glm::dvec3& x, double reach_m) const {
    constexpr double four_ulps = 0x1p-22;  // of a float
    // A perspective depth is divided by its distance: as good as the distance is small. An
    // orthographic one is a fraction of the whole range.
    const double of_depth = eye.w != 0.0 ? 4.0 * glm::distance(x, glm::dvec3(eye)) : far_depth;
    return four_ulps * (of_depth + reach_m);
}

}  // namespace gnomon::truth::internal
