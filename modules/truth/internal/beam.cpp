// SPDX-License-Identifier: MIT
#include "internal/beam.hpp"

#include <algorithm>

#include <gnomon/core/expects.hpp>

namespace gnomon::truth::internal {

Polygon::Polygon(const std::array<glm::dvec3, 3>& triangle) : count_(3) {
    std::copy(triangle.begin(), triangle.end(), corners_.begin());
}

glm::dvec3 Polygon::centroid() const {
    glm::dvec3 sum(0.0);
    for (int i = 0; i < count_; ++i) sum += (*this)[i];
    return sum / static_cast<double>(count_);
}

double Polygon::thickness() const {
    glm::dvec3 doubled_area(0.0);
    double diameter = 0.0;
    for (int i = 1; i < count_; ++i) {
        const glm::dvec3 spoke = (*this)[i] - (*this)[0];
        diameter = std::max(diameter, glm::length(spoke));
        if (i + 1 < count_) doubled_area += glm::cross(spoke, (*this)[i + 1] - (*this)[0]);
    }
    return diameter > 0.0 ? 0.5 * glm::length(doubled_area) / diameter : 0.0;
}

void Polygon::clip(const Plane& plane, double at_least) {
    std::array<double, capacity> above;
    bool any_out = false;
    bool any_in = false;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
        above[i] = plane.at(corners_[i]) - at_least;
        (above[i] >= 0.0 ? any_in : any_out) = true;
    }
    if (!any_out) return;
    if (!any_in) {
        count_ = 0;
        return;
    }
    std::array<glm::dvec3, capacity> kept;
    std::size_t kept_count = 0;
    const auto n = static_cast<std::size_t>(count_);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t next = i + 1 == n ? 0 : i + 1;
        if (above[i] >= 0.0) kept[kept_count++] = corners_[i];
        if ((above[i] >= 0.0) != (above[next] >= 0.0)) {
            GNOMON_EXPECTS(kept_count < capacity);
            const double t = above[i] / (above[i] - above[next]);
            kept[kept_count++] = corners_[i] + t * (corners_[next] - corners_[i]);
        }
    }
    std::copy_n(kept.begin(), kept_count, corners_.begin());
    count_ = static_cast<int>(kept_count);
}

Range range_along(const Plane& plane, const Polygon& polygon) {
    Range range;
    for (int i = 0; i < polygon.size(); ++i) {
        const double value = plane.at(polygon[i]);
        range.min = std::min(range.min, value);
        range.max = std::max(range.max, value);
    }
    return range;
}

Polygon Beam::cut(const std::array<glm::dvec3, 3>& triangle) const {
    for (int k = 0; k < side_count; ++k) {
        const Plane& side = sides[static_cast<std::size_t>(k)];
        if (side.at(triangle[0]) < 0.0 && side.at(triangle[1]) < 0.0 &&
            side.at(triangle[2]) < 0.0) {
            return {};
        }
    }
    Polygon polygon(triangle);
    for (int k = 0; k < side_count && !polygon.empty(); ++k) {
        polygon.clip(sides[static_cast<std::size_t>(k)]);
    }
    return polygon;
}

std::uint8_t Beam::edges_inside(const std::array<glm::dvec3, 3>& triangle, double slack) const {
    std::uint8_t mask = 0;
    for (std::size_t edge = 0; edge < 3; ++edge) {
        const glm::dvec3& a = triangle[edge];
        const glm::dvec3& b = triangle[(edge + 1) % 3];
        double from = 0.0;
        double to = 1.0;
        for (int k = 0; k < side_count && from <= to; ++k) {
            const Plane& side = sides[static_cast<std::size_t>(k)];
            const double at_a = side.at(a) + slack;
            const double at_b = side.at(b) + slack;
            if (at_a < 0.0 && at_b < 0.0) {
                from = 2.0;
            } else if (at_a < 0.0) {
                from = std::max(from, at_a / (at_a - at_b));
            } else if (at_b < 0.0) {
                to = std::min(to, at_a / (at_a - at_b));
            }
        }
        if (from <= to) mask = static_cast<std::uint8_t>(mask | (1U << edge));
    }
    return mask;
}

bool Beam::misses(const glm::dvec3& center, const glm::dvec3& half, double slack) const {
    const auto radius = [&](const Plane& plane) {
        return glm::dot(glm::abs(plane.normal), half) + slack;
    };
    for (int k = 0; k < side_count; ++k) {
        const Plane& side = sides[static_cast<std::size_t>(k)];
        if (side.at(center) + radius(side) < 0.0) return true;
    }
    const double middle = height.at(center);
    const double reach = radius(height);
    return middle + reach < lowest || middle - reach > highest;
}

Beam light_beam(const Polygon& region, const glm::dvec4& light, const Plane& base, double grow_m) {
    Beam beam;
    beam.apex = light;
    beam.height = base;
    const glm::dvec3 middle = region.centroid();
    double diameter = 0.0;
    for (int i = 0; i < region.size(); ++i) {
        diameter = std::max(diameter, 2.0 * glm::distance(region[i], middle));
    }
    for (int i = 0; i < region.size(); ++i) {
        const glm::dvec3& a = region[i];
        const glm::dvec3& b = region[i + 1 == region.size() ? 0 : i + 1];
        // What clipping leaves of a corner that it just touches has no direction worth using.
        if (glm::distance(a, b) < 1e-9 * diameter) continue;
        glm::dvec3 inward = glm::cross(b - a, beam.to_apex(a));
        if (glm::dot(inward, middle - a) < 0.0) inward = -inward;
        const glm::dvec3 shift = -grow_m * glm::normalize(inward);
        glm::dvec3 tilted = glm::cross(b - a, beam.to_apex(a + shift));
        if (glm::dot(tilted, inward) < 0.0) tilted = -tilted;
        beam.add_side(Plane::through(a + shift, glm::normalize(tilted)));
    }
    return beam;
}

}  // namespace gnomon::truth::internal
