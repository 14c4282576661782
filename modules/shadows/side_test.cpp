// SPDX-License-Identifier: MIT
#include "internal/side_test.hpp"

#include <cmath>

#include <gnomon/shadows/orientation.hpp>

#include "internal/casting.hpp"

namespace gnomon::shadows::internal {

Side test_side(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, LightLocal light) {
    const glm::dvec3 origin(a);
    const glm::dvec3 e1 = glm::dvec3(b) - origin;
    const glm::dvec3 e2 = glm::dvec3(c) - origin;
    const glm::dvec3 l(light.position);
    const glm::dvec3 t = light.is_directional() ? l : l - origin;
    const glm::dvec3 n = glm::cross(e1, e2);
    const double s = glm::dot(n, t);
    glm::dvec3 minors;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        minors[i] = std::abs(e1[j] * e2[k]) + std::abs(e1[k] * e2[j]);
    }
    const double bound = 10.0 * 0x1p-53 * glm::dot(minors, glm::abs(t));
    if (std::abs(s) > bound) {
        // A sliver's exact normal may be longer than the computed one, by 5 e minors at most.
        const double longest = glm::length(n) + 5.0 * 0x1p-53 * glm::length(minors);
        return {s > 0.0 ? 1 : -1, (std::abs(s) - bound) / longest * (1.0 - margin_slack)};
    }
    if (bound == 0.0) return {};  // nothing underflows here: every product has a factor of zero
    return {exact_facing(a, b, c, light), 0.0, true};
}

}  // namespace gnomon::shadows::internal
