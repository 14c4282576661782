// SPDX-License-Identifier: MIT
//
// ShadowHull: all that the shadow of a box can cover, and the box: what lies on rays from the light
// that have met it. Without end, unless cut off by a plane.
#pragma once

#include <array>

#include <glm/glm.hpp>

#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/technique.hpp>

namespace gnomon::shadows::internal {

struct Aabb {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};

    [[nodiscard]] bool empty() const {
        return !(low.x <= high.x && low.y <= high.y && low.z <= high.z);
    }
    [[nodiscard]] bool holds(const Aabb& b) const {
        return glm::all(glm::lessThanEqual(low, b.low)) &&
               glm::all(glm::greaterThanEqual(high, b.high));
    }
    void include(const Aabb& b) {
        low = glm::min(low, b.low);
        high = glm::max(high, b.high);
    }
    [[nodiscard]] static Aabb nothing();
};

[[nodiscard]] Aabb aabb_of(const OrientedBounds& bounds);
/// The largest of dot(normal, p) for p within.
[[nodiscard]] double support(const Aabb& box, const glm::dvec3& normal);

class ShadowHull {
public:
    /// What lies beyond the light's range does not count. Cost: some hundred flops.
    ShadowHull(const OrientedBounds& caster, const Light& light);

    /// False where the box lies outside for certain. Cost: some dozen flops.
    [[nodiscard]] bool may_meet(const Aabb& box) const;
    /// May be infinite.
    [[nodiscard]] const Aabb& bounds() const { return bounds_; }
    /// Of the caster.
    [[nodiscard]] const Aabb& caster() const { return caster_; }
    /// Of what of it lies within `box`, where the light's way through that ends. Cost: some dozen
    /// flops.
    [[nodiscard]] Aabb bounds_in(const Aabb& box) const;
    [[nodiscard]] const std::array<glm::dvec3, 8>& corners() const { return corners_; }
    [[nodiscard]] const glm::dvec4& light() const { return light_; }
    /// The way from the light to the middle of the box; unit length.
    [[nodiscard]] const glm::dvec3& axis() const { return axis_; }
    /// Everything is within: a point light in or about the box, or what is not finite.
    [[nodiscard]] bool everything() const { return everything_; }

private:
    std::array<glm::dvec3, 8> corners_{};
    glm::dvec4 light_{0.0};
    Aabb bounds_;
    Aabb caster_;
    // The least and the greatest way that anything takes, per unit of it: along the axis, or from
    // the light to a corner.
    Aabb ways_;
    bool everything_ = false;
    // The cone (or cylinder) round the sphere round the box.
    glm::dvec3 axis_{0.0, 0.0, -1.0};
    glm::dvec3 center_{0.0};
    double radius_ = 0.0;
    double first_ = 0.0;  // nothing before, along the axis from the light (or the origin)
    double sine_ = 0.0;
    double cosine_ = 1.0;
    double range2_;  // squared; infinite where there is none
};

}  // namespace gnomon::shadows::internal
