// SPDX-License-Identifier: MIT
#include "tests/shadows/big_integer.hpp"
#include "tests/shadows/exact_oracle.hpp"

namespace gnomon::test {

const char* oracle_name() { return "integers without limit"; }

int oracle_facing(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                  shadows::LightLocal light) {
    return integer_facing(a, b, c, light);
}

}  // namespace gnomon::test
