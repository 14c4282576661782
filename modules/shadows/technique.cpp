// SPDX-License-Identifier: MIT
#include <gnomon/shadows/technique.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "internal/finite.hpp"

namespace gnomon::shadows {

namespace {

struct Extent {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    void include(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
};

Extent project(std::span<const glm::dvec3> points, const glm::dvec3& axis) {
    Extent interval;
    for (const glm::dvec3& p : points) interval.include(glm::dot(p, axis));
    return interval;
}

}  // namespace

std::array<glm::dvec3, 8> corners_of(const OrientedBounds& bounds) {
    std::array<glm::dvec3, 8> corners;
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec4 local((i & 1U) != 0 ? bounds.max.x : bounds.min.x,
                               (i & 2U) != 0 ? bounds.max.y : bounds.min.y,
                               (i & 4U) != 0 ? bounds.max.z : bounds.min.z, 1.0);
        corners[i] = glm::dvec3(bounds.world_from_local * local);
    }
    return corners;
}

bool depth_pass_is_valid(const OrientedBounds& bounds, const glm::dvec4& light_world,
                         const View& view) {
    // Everything relative to the eye, so that a scene far from the origin loses nothing.
    const glm::dvec3 eye(glm::inverse(view.view_from_world)[3]);
    const bool directional = light_world.w == 0.0;
    const glm::dvec3 light = directional ? glm::dvec3(light_world) : glm::dvec3(light_world) - eye;

    // The near rectangle, widened sideways and made a slab: a rasteriser's idea of it is only so
    // exact.
    std::array<glm::dvec3, 4> rectangle = near_corners(view);
    glm::dvec3 center(0.0);
    for (glm::dvec3& corner : rectangle) center += (corner -= eye) * 0.25;
    std::array<glm::dvec3, 9> hull{};
    const double half_size = glm::length(rectangle[0] - center);
    const glm::dvec3 forward = -glm::dvec3(glm::transpose(view.view_from_world)[2]);
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 wide = center + (rectangle[i] - center) * 1.05;
        const glm::dvec3 step = view.projection == ProjectionKind::Orthographic
                                    ? forward * (0.02 * half_size)
                                    : wide * 0.02;
        hull[i] = wide - step;
        hull[4 + i] = wide + step;
    }
    const std::ptrdiff_t hull_count = directional ? 8 : 9;
    if (!directional) hull[8] = light;

    std::array<glm::dvec3, 8> box = corners_of(bounds);
    double reach = 0.0;
    for (glm::dvec3& corner : box) reach = std::max(reach, glm::length(corner -= eye));
    const double slack = 1e-6 * reach;  // single-precision clip coordinates round this much

    // Comparisons with not-a-number would find anything separate.
    const auto finite = [](const glm::dvec3& p) { return internal::is_finite(p); };
    if (!std::all_of(hull.begin(), hull.begin() + hull_count, finite) ||
        !std::all_of(box.begin(), box.end(), finite) || !finite(light)) {
        return false;
    }

    const auto separates = [&](const glm::dvec3& axis) {
        const double length = glm::length(axis);
        if (!(length > 0.0)) return false;
        const glm::dvec3 n = axis / length;
        const Extent a = project(std::span(hull.begin(), hull.begin() + hull_count), n);
        const Extent b = project(box, n);
        const double along = directional ? glm::dot(light, n) : 0.0;
        const double tiny = directional ? 1e-12 * glm::length(light) : 0.0;
        const double a_low = along < -tiny ? -std::numeric_limits<double>::infinity() : a.low;
        const double a_high = along > tiny ? std::numeric_limits<double>::infinity() : a.high;
        return a_low > b.high + slack || b.low > a_high + slack;
    };

    const std::array<glm::dvec3, 3> box_edges{box[1] - box[0], box[2] - box[0], box[4] - box[0]};
    for (std::size_t i = 0; i < 3; ++i) {
        if (separates(glm::cross(box_edges[i], box_edges[(i + 1) % 3]))) return true;
    }
    if (separates(forward)) return true;

    // The hull's edges: round the slab, across it, and from its corners to the light.
    std::array<glm::dvec3, 16> hull_edges;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        hull_edges[count++] = hull[(i + 1) % 4] - hull[i];
        hull_edges[count++] = hull[4 + i] - hull[i];
    }
    for (std::size_t i = 0; i < 8; ++i) hull_edges[count++] = directional ? light : light - hull[i];
    for (std::size_t i = 0; i < 8; ++i) {
        const std::size_t next = (i & 4U) + ((i + 1) & 3U);
        if (separates(glm::cross(hull[next] - hull[i], hull_edges[8 + i]))) return true;
    }
    for (const glm::dvec3& edge : hull_edges) {
        for (const glm::dvec3& box_edge : box_edges) {
            if (separates(glm::cross(edge, box_edge))) return true;
        }
    }
    return false;
}

}  // namespace gnomon::shadows
