// SPDX-License-Identifier: MIT
//
// Stepper: from the lengths of frames to whole ticks of the simulation. What is left of a frame
// counts in the next one, so that no time is lost; frames that last a tick but for what a clock
// trembles count as one, so that a screen of sixty frames a second has a tick in each.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "timing.hpp"

namespace gnomon::game {

class Stepper {
public:
    /// As long is a frame at most; after a pause the game goes on where it was.
    static constexpr double longest_s = 0.1;
    /// By as much may a frame miss a whole number of ticks.
    static constexpr double tremble_s = 0.002;

    explicit Stepper(double speed = 1.0) : speed_(speed) {}

    /// Ticks that are due after a frame that lasted as long; not a number, or negative: none.
    [[nodiscard]] std::uint32_t advance(double dt_s) {
        if (!(dt_s > 0.0)) return 0;
        double counted_s = std::min(dt_s, longest_s);
        const double whole_s = std::round(counted_s / tick_s) * tick_s;
        if (whole_s > 0.0 && std::abs(counted_s - whole_s) < tremble_s) {
            owed_s_ += counted_s - whole_s;
            counted_s = whole_s;
            // A clock that does not tremble but is another.
            if (std::abs(owed_s_) > 0.5 * tick_s) {
                counted_s += owed_s_;
                owed_s_ = 0.0;
            }
        }
        left_s_ += counted_s * speed_;
        const double ticks = std::floor(left_s_ / tick_s + 1e-6);
        left_s_ = std::max(0.0, left_s_ - ticks * tick_s);
        return static_cast<std::uint32_t>(ticks);
    }

    /// How long a frame is to last for the next ticks to be due: one, or of a quick game as many as
    /// it is quicker. A slow game's ticks have even frames between them, none longer than `tick_s`:
    /// the camera turns as smoothly. What is owed counts, so that who keeps to it owes nothing in
    /// the end.
    [[nodiscard]] double until_next_s() const {
        const double ticks = std::max(1.0, std::floor(speed_));
        const double rest_s = (ticks * tick_s - left_s_) / speed_;
        return rest_s / std::max(1.0, std::ceil(rest_s / tick_s - 1e-6)) - owed_s_;
    }
    /// Forgets what is left.
    void reset() { left_s_ = owed_s_ = 0.0; }

private:
    double speed_;
    double left_s_ = 0.0;  // of the game's time
    double owed_s_ = 0.0;  // of the clock's
};

}  // namespace gnomon::game
