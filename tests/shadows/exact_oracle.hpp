// SPDX-License-Identifier: MIT
//
// An oracle for exact_facing that shares nothing with it: CGAL's exact kernel where the build found
// CGAL, else integers without limit (big_integer.hpp).
#pragma once

#include <glm/glm.hpp>

#include <gnomon/shadows/light.hpp>

namespace gnomon::test {

/// Which of the two this build has.
[[nodiscard]] const char* oracle_name();
/// The sign of normal(a, b, c) . (light - a), or of normal . direction.
[[nodiscard]] int oracle_facing(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                                shadows::LightLocal light);

}  // namespace gnomon::test
