// SPDX-License-Identifier: MIT
//
// Infinity; and whether a vector's components are all numbers and none infinite. Comparisons alone
// would let not-a-number through.
#pragma once

#include <cmath>
#include <limits>

#include <glm/glm.hpp>

namespace gnomon::shadows::internal {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

template <glm::length_t size, class T>
[[nodiscard]] bool is_finite(const glm::vec<size, T>& v) {
    for (glm::length_t i = 0; i < size; ++i) {
        if (!std::isfinite(v[i])) return false;
    }
    return true;
}

}  // namespace gnomon::shadows::internal
