// SPDX-License-Identifier: MIT
//
// Controls: from what a person holds to the input of a tick. Keyboard, gamepad and mouse all come
// down to a Pad; only here does the camera have a say.
#pragma once

#include "player.hpp"

namespace gnomon::game {

struct Pad {
    double right = 0.0;  ///< of the picture; -1 .. 1
    double up = 0.0;     ///< of the picture: away from the eye
    bool sneak = false;
    bool run = false;
    bool restart = false;
    bool pause = false;
    bool operator==(const Pad&) const = default;
};

/// A stick within this of its middle is at rest.
inline constexpr double dead_zone = 0.15;

/// `camera_yaw_rad` as CameraRig has it. Pads beyond -1 .. 1 are cut to a tilt of 1, as keys are
/// that are held together; what is not a number counts as at rest.
[[nodiscard]] Input input_of(const Pad& pad, double camera_yaw_rad);

}  // namespace gnomon::game
