// SPDX-License-Identifier: MIT
#include "frame_times.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace gnomon::game {

namespace {

std::string line(const char* what, std::vector<double> ms) {
    std::ranges::sort(ms);
    const auto at = [&](std::size_t hundredths) { return ms[(ms.size() - 1) * hundredths / 100]; };
    return fmt::format("  {:<44} {:9.3f} {:9.3f}\n", what, at(50), at(95));
}

}  // namespace

std::string to_text(const FrameTimes& times) {
    if (times.frame.empty()) return {};
    return fmt::format("  {:<44} {:>9} {:>9}\n",
                       fmt::format("milliseconds, {} frames", times.frame.size()), "median",
                       "95 %") +
           line("simulation and light meter", times.tick) +
           line("shadows on the processor", times.shadows) +
           line("recording and uploads", times.record) +
           line("frame, until the device has finished", times.frame);
}

}  // namespace gnomon::game
