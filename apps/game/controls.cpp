// SPDX-License-Identifier: MIT
#include "controls.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::game {

Input input_of(const Pad& pad, double camera_yaw_rad) {
    Input input{.sneak = pad.sneak, .run = pad.run, .restart = pad.restart, .pause = pad.pause};
    const double tilt = std::hypot(pad.right, pad.up);
    if (!(tilt > dead_zone) || !std::isfinite(tilt)) return input;
    // Slow begins where the dead zone ends.
    const double wanted = (std::min(tilt, 1.0) - dead_zone) / (1.0 - dead_zone);
    const double right = pad.right / tilt * wanted;
    const double up = pad.up / tilt * wanted;
    // The camera looks north where its yaw is 0; its right is then the east.
    const double c = std::cos(camera_yaw_rad);
    const double s = std::sin(camera_yaw_rad);
    const auto axis = [](double value) {
        return static_cast<std::int8_t>(std::lround(std::clamp(value, -1.0, 1.0) * 127.0));
    };
    input.east = axis(right * c - up * s);
    input.south = axis(-right * s - up * c);
    return input;
}

}  // namespace gnomon::game
