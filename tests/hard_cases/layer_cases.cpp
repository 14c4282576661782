// SPDX-License-Identifier: MIT
//
// How many volumes may lie over one pixel.
#include "tests/hard_cases/hard_case.hpp"

namespace gnomon::test {

std::vector<HardCase> layer_cases() { return {}; }

}  // namespace gnomon::test
