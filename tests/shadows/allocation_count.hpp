// SPDX-License-Identifier: MIT
//
// Counts what a thread allocates with new, for functions that promise not to.
#pragma once

#include <cstdint>

namespace gnomon::test {

/// By this thread, since it began.
[[nodiscard]] std::uint64_t allocation_count();

}  // namespace gnomon::test
