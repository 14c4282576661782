// SPDX-License-Identifier: MIT
//
// Tests of many combinations: devices by scenes by options. `make test` deals the scenes out to the
// devices, so that every device, scene and option has its turn but not each with each; where
// GNOMON_THOROUGH is set, as `make soak` sets it, each device takes all of them.
#pragma once

#include <cstddef>
#include <cstdlib>

namespace gnomon::test {

[[nodiscard]] inline bool thorough() { return std::getenv("GNOMON_THOROUGH") != nullptr; }

/// Whether combination `number` falls to `player`, one of any number, when every combination is
/// dealt to every `among`-th of them.
[[nodiscard]] inline bool falls_to(std::size_t player, std::size_t number, std::size_t among) {
    return thorough() || number % among == player % among;
}

}  // namespace gnomon::test
