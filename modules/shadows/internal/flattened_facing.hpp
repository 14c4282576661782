// SPDX-License-Identifier: MIT
//
// Which way a face of a caster with a singular pose looks: the one answer for its volume and for
// shadow queries.
#pragma once

#include <cmath>

#include <glm/glm.hpp>

namespace gnomon::shadows::internal {

/// A corner, where the pose leads to.
inline glm::dvec3 flattened_place(const glm::dmat4& parent_from_local, const glm::vec3& corner) {
    return glm::dvec3(parent_from_local * glm::dvec4(glm::dvec3(corner), 1.0));
}

/// The sign of the face's weight. The corners carry rounding of their own, so nearly edge-on counts
/// as edge-on. Whatever is decided here, the volume is closed.
inline int flattened_facing(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                            const glm::dvec4& light_parent) {
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const glm::dvec3 t = glm::dvec3(light_parent) - light_parent.w * a;
    const double s = glm::dot(n, t);
    if (!(std::abs(s) > 1e-12 * glm::length(n) * glm::length(t))) return 0;
    return s > 0.0 ? 1 : -1;
}

}  // namespace gnomon::shadows::internal
