// SPDX-License-Identifier: MIT
//
// What memory this process has: for those who look for leaks. Not what GPU objects take on a card.
#pragma once

#include <cstdint>

namespace gnomon::game {

struct ProcessMemory {
    /// Asked for by the main thread and not given back; of the game all, of drivers that work in
    /// threads of their own a part. 0 where the C library or a sanitizer does not say.
    std::uint64_t held_bytes = 0;
    std::uint64_t resident_bytes = 0;  ///< 0 where the system does not say
};
[[nodiscard]] ProcessMemory process_memory();

}  // namespace gnomon::game
