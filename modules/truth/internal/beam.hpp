// SPDX-License-Identifier: MIT
//
// Beams: what the oracle asks with instead of rays. A beam is all that can be seen from its apex
// (the eye, the light) through a small window, so that its answer holds for every point of a
// pixel's neighbourhood and nothing thin slips between samples. All in double precision.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include <glm/glm.hpp>

namespace gnomon::truth::internal {

/// dot(normal, x) + offset; the normal is unit, so values are metres.
struct Plane {
    glm::dvec3 normal{0.0};
    double offset = 0.0;

    [[nodiscard]] static Plane through(const glm::dvec3& point, const glm::dvec3& unit_normal) {
        return {unit_normal, -glm::dot(unit_normal, point)};
    }
    [[nodiscard]] double at(const glm::dvec3& x) const { return glm::dot(normal, x) + offset; }
};

/// A convex polygon of few corners, without a heap.
class Polygon {
public:
    static constexpr int capacity = 20;

    Polygon() = default;
    explicit Polygon(const std::array<glm::dvec3, 3>& triangle);

    [[nodiscard]] int size() const { return count_; }
    [[nodiscard]] bool empty() const { return count_ == 0; }
    [[nodiscard]] const glm::dvec3& operator[](int i) const {
        return corners_[static_cast<std::size_t>(i)];
    }
    [[nodiscard]] glm::dvec3 centroid() const;
    /// Area over diameter: how thick it is, but for a factor of two.
    [[nodiscard]] double thickness() const;

    /// Keeps the part where plane.at(x) >= at_least. Adds one corner at most; clipping a triangle
    /// by more than capacity - 3 planes is a caller's bug.
    void clip(const Plane& plane, double at_least = 0.0);

private:
    std::array<glm::dvec3, capacity> corners_;
    int count_ = 0;
};

struct Range {
    double min = std::numeric_limits<double>::infinity();
    double max = -std::numeric_limits<double>::infinity();
};
[[nodiscard]] Range range_along(const Plane& plane, const Polygon& polygon);

struct Beam {
    static constexpr int max_sides = 12;

    glm::dvec4 apex{0.0};  ///< a point (w = 1), or the direction towards one at infinity (w = 0)
    std::array<Plane, max_sides> sides;  ///< >= 0 inside; all pass through the apex
    int side_count = 0;
    Plane height;  ///< what `lowest` and `highest` are measured with
    double lowest = 0.0;
    double highest = std::numeric_limits<double>::infinity();

    void add_side(const Plane& plane) { sides[static_cast<std::size_t>(side_count++)] = plane; }
    [[nodiscard]] glm::dvec3 to_apex(const glm::dvec3& x) const {
        return glm::dvec3(apex) - apex.w * x;
    }
    /// The part of a triangle between the sides; `lowest` and `highest` are not looked at.
    [[nodiscard]] Polygon cut(const std::array<glm::dvec3, 3>& triangle) const;
    /// Bit k: the edge from corner k to the next one comes within `slack` of the beam.
    [[nodiscard]] std::uint8_t edges_inside(const std::array<glm::dvec3, 3>& triangle,
                                            double slack) const;
    /// True when a box surely lies outside.
    [[nodiscard]] bool misses(const glm::dvec3& center, const glm::dvec3& half, double slack) const;
};

/// The beam from a light through a convex region of a surface, which it leaves on `base`'s positive
/// side. The region is grown by `grow_m` across the beam (shrunk if negative); at the light the
/// beam is a point all the same. `side_count` is < 3 when the region is too thin to have an inside.
[[nodiscard]] Beam light_beam(const Polygon& region, const glm::dvec4& light, const Plane& base,
                              double grow_m);

}  // namespace gnomon::truth::internal
