// SPDX-License-Identifier: MIT
//
// What the frames of a run took.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace gnomon::game {

[[nodiscard]] inline double milliseconds_between(std::chrono::steady_clock::time_point from,
                                                 std::chrono::steady_clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}
[[nodiscard]] inline double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return milliseconds_between(start, std::chrono::steady_clock::now());
}

/// Milliseconds of each frame that was drawn.
struct FrameTimes {
    std::vector<double> tick;     ///< the simulation, shadow queries of the light meter included
    std::vector<double> shadows;  ///< Drawing::shadows_ms()
    std::vector<double> record;   ///< render::FrameTimes::record_ms
    std::vector<double> frame;    ///< drawing, until the device has finished
};

/// Medians and 95th percentiles, a line each; empty where nothing was drawn.
[[nodiscard]] std::string to_text(const FrameTimes& times);

}  // namespace gnomon::game
