// SPDX-License-Identifier: MIT
#include <gnomon/shadows/technique.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "internal/finite.hpp"
#include "internal/near_clip.hpp"

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

namespace internal {

NearClip::NearClip(const glm::dvec4& light_world, const View& view)
    : eye_(glm::inverse(view.view_from_world)[3]),
      forward_(-glm::dvec3(glm::transpose(view.view_from_world)[2])),
      directional_(light_world.w == 0.0) {
    // Everything relative to the eye, so that a scene far from the origin loses nothing.
    light_ = directional_ ? glm::dvec3(light_world) : glm::dvec3(light_world) - eye_;

    // The near rectangle, widened sideways and made a slab: a rasteriser's idea of it is only so
    // exact.
    std::array<glm::dvec3, 4> rectangle = near_corners(view);
    glm::dvec3 center(0.0);
    for (glm::dvec3& corner : rectangle) center += (corner -= eye_) * 0.25;
    const double half_size = glm::length(rectangle[0] - center);
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 wide = center + (rectangle[i] - center) * 1.05;
        const glm::dvec3 step = view.projection == ProjectionKind::Orthographic
                                    ? forward_ * (0.02 * half_size)
                                    : wide * 0.02;
        hull_[i] = wide - step;
        hull_[4 + i] = wide + step;
    }
    hull_count_ = directional_ ? 8 : 9;
    if (!directional_) hull_[8] = light_;

    // Comparisons with not-a-number would find anything separate.
    const auto is_number = [](const glm::dvec3& p) { return is_finite(p); };
    finite_ =
        std::all_of(hull_.begin(), hull_.begin() + hull_count_, is_number) && is_finite(light_);

    // The hull's edges: round the slab, across it, and from its corners to the light.
    std::size_t count = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        edges_[count++] = hull_[(i + 1) % 4] - hull_[i];
        edges_[count++] = hull_[4 + i] - hull_[i];
    }
    for (std::size_t i = 0; i < 8; ++i) edges_[count++] = directional_ ? light_ : light_ - hull_[i];
    const auto add_side = [&](const glm::dvec3& axis) {
        const double length = glm::length(axis);
        if (length > 0.0)
            sides_[static_cast<std::size_t>(side_count_++)] = extent_along(axis / length);
    };
    add_side(forward_);
    for (std::size_t i = 0; i < 8; ++i) {
        const std::size_t next = (i & 4U) + ((i + 1) & 3U);
        add_side(glm::cross(hull_[next] - hull_[i], edges_[8 + i]));
    }
}

NearClip::Side NearClip::extent_along(const glm::dvec3& unit) const {
    const Extent hull = project(std::span(hull_).first(static_cast<std::size_t>(hull_count_)), unit);
    const double along = directional_ ? glm::dot(light_, unit) : 0.0;
    const double tiny = directional_ ? 1e-12 * glm::length(light_) : 0.0;
    return {unit, along < -tiny ? -std::numeric_limits<double>::infinity() : hull.low,
            along > tiny ? std::numeric_limits<double>::infinity() : hull.high};
}

bool NearClip::is_clear_of_sphere(const glm::dvec3& center, double radius) const {
    const glm::dvec3 c = center - eye_;
    const double rounding = 1e-14 * (glm::length(center) + glm::length(eye_));
    const double reach = radius * (1.0 + 1e-9) + rounding + 1e-6 * (glm::length(c) + radius);
    if (!finite_ || !std::isfinite(reach)) return false;
    return std::any_of(sides_.begin(), sides_.begin() + side_count_, [&](const Side& side) {
        const double along = glm::dot(c, side.normal);
        return side.low > along + reach || along - reach > side.high;
    });
}

bool NearClip::is_clear_of(const OrientedBounds& bounds) const {
    std::array<glm::dvec3, 8> box = corners_of(bounds);
    double reach = 0.0;
    for (glm::dvec3& corner : box) reach = std::max(reach, glm::length(corner -= eye_));
    const double slack = 1e-6 * reach;  // single-precision clip coordinates round this much
    const auto is_number = [](const glm::dvec3& p) { return is_finite(p); };
    if (!finite_ || !std::all_of(box.begin(), box.end(), is_number)) return false;

    const auto is_beyond = [&](const Side& side) {
        const Extent b = project(box, side.normal);
        return side.low > b.high + slack || b.low > side.high + slack;
    };
    const auto separates = [&](const glm::dvec3& axis) {
        const double length = glm::length(axis);
        return length > 0.0 && is_beyond(extent_along(axis / length));
    };
    // The hull's own sides first: they cost least and decide most.
    if (std::any_of(sides_.begin(), sides_.begin() + side_count_, is_beyond)) return true;
    const std::array<glm::dvec3, 3> box_edges{box[1] - box[0], box[2] - box[0], box[4] - box[0]};
    for (std::size_t i = 0; i < 3; ++i) {
        if (separates(glm::cross(box_edges[i], box_edges[(i + 1) % 3]))) return true;
    }
    for (const glm::dvec3& edge : edges_) {
        for (const glm::dvec3& box_edge : box_edges) {
            if (separates(glm::cross(edge, box_edge))) return true;
        }
    }
    return false;
}

bool NearClip::is_clear_of(const ShadowMesh& mesh, const glm::dmat4& world_from_local) const {
    if (!finite_) return false;
    const auto positions = mesh.positions();
    const auto place = [&](std::uint32_t v) {
        return glm::dvec3(world_from_local * glm::dvec4(glm::dvec3(positions[v]), 1.0)) - eye_;
    };
    return std::ranges::all_of(mesh.faces(), [&](const auto& face) {
        const std::array<glm::dvec3, 3> corners{place(face[0]), place(face[1]), place(face[2])};
        double reach = 0.0;
        for (const glm::dvec3& corner : corners) reach = std::max(reach, glm::length(corner));
        const double slack = 1e-6 * reach;
        if (!std::isfinite(slack)) return false;
        const auto is_beyond = [&](const Side& side) {
            const Extent e = project(corners, side.normal);
            return side.low > e.high + slack || e.low > side.high + slack;
        };
        if (std::any_of(sides_.begin(), sides_.begin() + side_count_, is_beyond)) return true;
        const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double length = glm::length(normal);
        return length > 0.0 && is_beyond(extent_along(normal / length));
    });
}

}  // namespace internal

bool depth_pass_is_valid(const OrientedBounds& bounds, const glm::dvec4& light_world,
                         const View& view) {
    return internal::NearClip(light_world, view).is_clear_of(bounds);
}

}  // namespace gnomon::shadows
