// SPDX-License-Identifier: MIT
//
// How far a light went, in the measure of Facing::margin.
#pragma once

#include <limits>

#include <glm/glm.hpp>

#include <gnomon/shadows/light.hpp>

namespace gnomon::shadows::internal {

/// Metres for a point, on the unit sphere for a direction; never less than the exact distance.
/// Infinite where either direction has no length. Both lights are of the same kind.
inline double displacement(const LightLocal& from, const LightLocal& to) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    const glm::dvec3 a(from.position);
    const glm::dvec3 b(to.position);
    if (a == b) return 0.0;
    if (!from.is_directional()) return glm::length(b - a) * (1.0 + 4.0 * epsilon);
    const double length_a = glm::length(a);
    const double length_b = glm::length(b);
    if (!(length_a > 0.0) || !(length_b > 0.0)) return std::numeric_limits<double>::infinity();
    return glm::length(b / length_b - a / length_a) * (1.0 + 4.0 * epsilon) + 8.0 * epsilon;
}

}  // namespace gnomon::shadows::internal
