// SPDX-License-Identifier: MIT
#include "internal/shadow_hull.hpp"

#include <algorithm>
#include <cmath>

#include "internal/finite.hpp"

namespace gnomon::shadows::internal {

Aabb Aabb::nothing() { return {glm::dvec3(infinity), glm::dvec3(-infinity)}; }

Aabb aabb_of(const OrientedBounds& bounds) {
    Aabb box = Aabb::nothing();
    for (const glm::dvec3& corner : corners_of(bounds)) box.include({corner, corner});
    // Whoever draws it rounds to single precision, relative to the eye.
    const glm::dvec3 room(1e-6 * glm::length(box.high - box.low));
    return {box.low - room, box.high + room};
}

double support(const Aabb& box, const glm::dvec3& normal) {
    const auto along = [&](int axis) {
        // Of an infinite side that the normal does not look along, nothing counts.
        if (normal[axis] == 0.0) return 0.0;
        return normal[axis] * (normal[axis] > 0.0 ? box.high[axis] : box.low[axis]);
    };
    return along(0) + along(1) + along(2);
}

ShadowHull::ShadowHull(const OrientedBounds& caster, const Light& of)
    : corners_(corners_of(caster)),
      light_(of.position_world),
      bounds_(Aabb::nothing()),
      range2_(infinity) {
    for (const glm::dvec3& corner : corners_) {
        bounds_.include({corner, corner});
        center_ += corner * 0.125;
    }
    for (const glm::dvec3& corner : corners_) {
        radius_ = std::max(radius_, glm::length(corner - center_));
    }
    const double room = 1e-6 * radius_ + 1e-14 * glm::length(center_);
    radius_ += room;
    bounds_.low -= room;
    bounds_.high += room;

    const glm::dvec3 light(light_);
    const bool directional = light_.w == 0.0;
    const glm::dvec3 way = directional ? -light : center_ - light;
    const double distance = glm::length(way);
    everything_ = !is_finite(way) || !std::isfinite(radius_) || !(distance > 0.0);
    if (!everything_) {
        axis_ = way / distance;
        if (directional) {
            first_ = glm::dot(center_, axis_) - radius_;
        } else if (distance > radius_) {
            sine_ = radius_ / distance;
            cosine_ = std::sqrt(1.0 - sine_ * sine_);
            first_ = distance - radius_;
        } else {
            sine_ = 2.0;  // the light is within the sphere: the cone says nothing
        }
    }
    caster_ = bounds_;
    ways_ = directional ? Aabb{axis_, axis_} : Aabb{caster_.low - light, caster_.high - light};
    for (int axis = 0; axis < 3; ++axis) {
        if (everything_ || ways_.low[axis] < 0.0) bounds_.low[axis] = -infinity;
        if (everything_ || ways_.high[axis] > 0.0) bounds_.high[axis] = infinity;
    }
    if (directional || !of.range_m) return;
    const double range = *of.range_m * (1.0 + 1e-6) + 1e-14 * glm::length(light);
    range2_ = range * range;
    bounds_.low = glm::max(bounds_.low, light - range);
    bounds_.high = glm::min(bounds_.high, light + range);
}

Aabb ShadowHull::bounds_in(const Aabb& box) const {
    const Aabb within{glm::max(box.low, bounds_.low), glm::min(box.high, bounds_.high)};
    if (everything_ || within.empty()) return within;
    // Whatever has come so far along its way has left the box.
    double last = infinity;
    for (int axis = 0; axis < 3; ++axis) {
        if (ways_.low[axis] > 0.0) {
            last = std::min(last, (within.high[axis] - caster_.low[axis]) / ways_.low[axis]);
        } else if (ways_.high[axis] < 0.0) {
            last = std::min(last, (within.low[axis] - caster_.high[axis]) / ways_.high[axis]);
        }
    }
    if (!(last < infinity)) return within;
    if (last < 0.0) return Aabb::nothing();
    last *= 1.0 + 1e-9;
    const glm::dvec3 back = last * glm::min(ways_.low, glm::dvec3(0.0));
    const glm::dvec3 on = last * glm::max(ways_.high, glm::dvec3(0.0));
    return {glm::max(within.low, caster_.low + back - 1e-9 * glm::abs(back)),
            glm::min(within.high, caster_.high + on + 1e-9 * glm::abs(on))};
}

bool ShadowHull::may_meet(const Aabb& box) const {
    if (glm::any(glm::greaterThan(box.low, bounds_.high)) ||
        glm::any(glm::lessThan(box.high, bounds_.low))) {
        return false;
    }
    const glm::dvec3 nearest = glm::clamp(glm::dvec3(light_), box.low, box.high);
    const glm::dvec3 to_nearest = nearest - glm::dvec3(light_);
    if (light_.w != 0.0 && glm::dot(to_nearest, to_nearest) > range2_) return false;
    if (everything_ || sine_ > 1.0) return true;
    const glm::dvec3 middle = 0.5 * (box.low + box.high);
    const glm::dvec3 half = 0.5 * (box.high - box.low);
    const bool directional = light_.w == 0.0;
    const glm::dvec3 from = directional ? middle - center_ : middle - glm::dvec3(light_);
    const double along = glm::dot(from, axis_);
    // How far the box reaches along the axis, and away from it.
    const double reach = glm::dot(half, glm::abs(axis_));
    const double last = along + reach + (directional ? glm::dot(center_, axis_) : 0.0);
    if (last < first_) return false;
    const double aside = glm::length(from - along * axis_);
    const double outside = directional ? aside - radius_ : aside * cosine_ - along * sine_;
    return !(outside > glm::length(half) * (1.0 + 1e-9) + 1e-12 * glm::length(middle));
}

}  // namespace gnomon::shadows::internal
