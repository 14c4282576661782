// SPDX-License-Identifier: MIT
#include "tests/shadows/exact_oracle.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

namespace gnomon::test {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;

Kernel::Point_3 point(const glm::vec3& p) { return {p.x, p.y, p.z}; }

}  // namespace

const char* oracle_name() { return "CGAL's exact kernel"; }

int oracle_facing(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                  shadows::LightLocal light) {
    const glm::vec3 l(light.position);
    const Kernel::Point_3 p = point(a);
    if (!light.is_directional()) return CGAL::orientation(p, point(b), point(c), point(l));
    return CGAL::orientation(point(b) - p, point(c) - p, Kernel::Vector_3(l.x, l.y, l.z));
}

}  // namespace gnomon::test
