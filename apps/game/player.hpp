// SPDX-License-Identifier: MIT
//
// The player's figure, as the rules see it: a circle in plan with a gait. And what a tick's input
// is: plain data, whatever device it came from.
#pragma once

#include <cstdint>
#include <span>

#include <glm/glm.hpp>

#include "collision.hpp"

namespace gnomon::game {

/// Of one tick. Axes are the world's, not the picture's: a front-end turns a stick by its camera.
struct Input {
    std::int8_t east = 0;   ///< -127 .. 127: to +X
    std::int8_t south = 0;  ///< -127 .. 127: to +Z
    bool sneak = false;
    bool run = false;
    bool restart = false;  ///< the level begins anew
    bool pause = false;    ///< held: this tick does not count

    bool operator==(const Input&) const = default;
};

struct Player {
    glm::dvec2 at{0.0};
    glm::dvec2 velocity_m_s{0.0};
    double facing_rad = 0.0;  ///< plan angle
    double walked_m = 0.0;    ///< what the gait goes by
    double crouch = 0.0;      ///< 0: upright, 1: as low as it gets

    static constexpr double radius_m = 0.3;
    static constexpr double sneak_m_s = 1.1;
    static constexpr double walk_m_s = 2.1;
    static constexpr double run_m_s = 3.7;

    [[nodiscard]] double speed_m_s() const { return glm::length(velocity_m_s); }
};

/// One tick. `ground_half_m`: where the ground ends; the figure stays on it, in an obstacle if
/// there is no other place.
[[nodiscard]] Player moved(const Player& player, const Input& input,
                           std::span<const Obstacle> obstacles, const glm::dvec2& ground_half_m);

}  // namespace gnomon::game
