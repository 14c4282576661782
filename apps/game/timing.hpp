// SPDX-License-Identifier: MIT
//
// The clock of the simulation: ticks, sixty a second, counted from the start of a level. Nothing in
// the game reads any other.
#pragma once

#include <cstdint>

namespace gnomon::game {

using Tick = std::uint32_t;

inline constexpr Tick ticks_a_second = 60;
inline constexpr double tick_s = 1.0 / ticks_a_second;

[[nodiscard]] inline double seconds(Tick tick) {
    return static_cast<double>(tick) / ticks_a_second;
}

}  // namespace gnomon::game
