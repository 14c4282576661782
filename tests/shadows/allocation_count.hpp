// SPDX-License-Identifier: MIT
//
// Counts what is allocated with new, for functions that promise not to, or not much.
#pragma once

#include <cstdint>

namespace gnomon::test {

/// By this thread, since it began.
[[nodiscard]] std::uint64_t allocation_count();

/// Bytes that all threads asked for and have not given back, without what the allocator adds.
[[nodiscard]] std::uint64_t allocated_bytes();

}  // namespace gnomon::test
