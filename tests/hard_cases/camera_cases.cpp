// SPDX-License-Identifier: MIT
//
// From where a scene may be seen.
#include "tests/hard_cases/hard_case.hpp"

namespace gnomon::test {

std::vector<HardCase> camera_cases() { return {}; }

}  // namespace gnomon::test
