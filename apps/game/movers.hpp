// SPDX-License-Identifier: MIT
//
// What moves whatever the player does: guards, searchlights, the sun, cranes, wheels. Each is a
// pure function of the tick, so that a plan can be made ahead and nothing has to be stored.
#pragma once

#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "level.hpp"
#include "timing.hpp"

namespace gnomon::game {

struct GuardPose {
    glm::dvec2 at{0.0};
    double facing_rad = 0.0;
    double walked_m = 0.0;  ///< since the start: what the gait goes by
    double stride = 0.0;    ///< 0: stands, 1: walks
};

/// A guard turns while it waits; without a pause it turns at once.
[[nodiscard]] GuardPose guard_at(const Guard& guard, Tick tick);

/// The point on the ground that a searchlight looks at.
[[nodiscard]] glm::dvec2 searchlight_target(const Searchlight& light, Tick tick);

/// Unit, towards the sun.
[[nodiscard]] glm::dvec3 towards_sun(const Sun& sun, Tick tick);

/// Plan angle of a crane's arm.
[[nodiscard]] double crane_turn(const Crane& crane, Tick tick);
/// How far its load swings out of the vertical, along the way the arm moves.
[[nodiscard]] double crane_sway(const Crane& crane, Tick tick);

[[nodiscard]] double wheel_turn(const Wheel& wheel, Tick tick);

/// Unit, in plan: (x, z) of a plan angle.
[[nodiscard]] glm::dvec2 plan_direction(double angle_rad);
[[nodiscard]] double plan_angle(const glm::dvec2& direction);
/// About the vertical, by a plan angle.
[[nodiscard]] glm::dquat turned_in_plan(double angle_rad);
/// From one plan angle to another the shorter way, by a share of 0 to 1.
[[nodiscard]] double turned_between(double from_rad, double to_rad, double share);

}  // namespace gnomon::game
