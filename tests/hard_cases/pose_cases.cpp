// SPDX-License-Identifier: MIT
//
// Where things may stand, and how askew.
#include "tests/hard_cases/hard_case.hpp"

namespace gnomon::test {

std::vector<HardCase> pose_cases() { return {}; }

}  // namespace gnomon::test
