// SPDX-License-Identifier: MIT
//
// StateHash: FNV-1a of 64 bits (G. Fowler, L. C. Noll, K.-P. Vo) over numbers that are rounded to
// a ten-thousandth first.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/glm.hpp>

namespace gnomon::game {

class StateHash {
public:
    void add(std::uint64_t value) {
        for (int byte = 0; byte < 8; ++byte) {
            value_ ^= value & 0xFFU;
            value_ *= 0x100000001B3U;
            value >>= 8U;
        }
    }
    void add(double value) {
        add(static_cast<std::uint64_t>(static_cast<std::int64_t>(std::llround(value * 1e4))));
    }
    void add(const glm::dvec2& value) {
        add(value.x);
        add(value.y);
    }
    /// An angle, whatever full turns it has made.
    void add_turn(double angle_rad) { add(std::remainder(angle_rad, 2.0 * std::numbers::pi)); }

    [[nodiscard]] std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xCBF29CE484222325U;
};

}  // namespace gnomon::game
