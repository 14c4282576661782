// SPDX-License-Identifier: MIT
//
// Where a light may be.
#include "tests/hard_cases/hard_case.hpp"

namespace gnomon::test {

std::vector<HardCase> light_cases() { return {}; }

}  // namespace gnomon::test
