// SPDX-License-Identifier: MIT
//
// The later stages of the facing test, one face at a time: double precision, then exact.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include <gnomon/shadows/light.hpp>

namespace gnomon::shadows::internal {

struct Side {
    int sign = 0;            ///< +1: the face is towards the light
    double distance = 0.0;   ///< a lower bound on how far the light is from the face's plane
    bool was_exact = false;  ///< double precision could not decide
};

/// docs/numerics.md, "Facing", derives the bound.
[[nodiscard]] Side test_side(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                             LightLocal light);

}  // namespace gnomon::shadows::internal
