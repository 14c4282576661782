// SPDX-License-Identifier: MIT
#include "player.hpp"

#include <algorithm>
#include <cmath>

#include "movers.hpp"
#include "timing.hpp"

namespace gnomon::game {

Player moved(const Player& player, const Input& input, std::span<const Obstacle> obstacles,
             const glm::dvec2& ground_half_m) {
    constexpr double settle_s = 0.09;  // how quickly speed follows the stick
    constexpr double turn_s = 0.10;
    constexpr double crouch_s = 0.16;
    glm::dvec2 stick = glm::dvec2(input.east, input.south) / 127.0;
    const double tilt = glm::length(stick);
    if (tilt > 1.0) stick /= tilt;
    double top_m_s = Player::walk_m_s;
    if (input.run) top_m_s = Player::run_m_s;
    if (input.sneak) top_m_s = Player::sneak_m_s;

    Player next = player;
    next.crouch += ((input.sneak ? 1.0 : 0.0) - player.crouch) * std::min(tick_s / crouch_s, 1.0);
    glm::dvec2 velocity =
        player.velocity_m_s + (stick * top_m_s - player.velocity_m_s) * (tick_s / settle_s);
    if (tilt == 0.0 && glm::length(velocity) < 0.02) velocity = glm::dvec2(0.0);
    const auto on_ground = [&](const glm::dvec2& at) {
        return glm::clamp(at, -ground_half_m + Player::radius_m, ground_half_m - Player::radius_m);
    };
    // What stands at the border must not push the figure over it.
    next.at = on_ground(
        pushed_out(on_ground(player.at + velocity * tick_s), Player::radius_m, obstacles));
    // Against a wall the figure does not run on the spot.
    next.velocity_m_s = (next.at - player.at) / tick_s;
    if (next.speed_m_s() > Player::run_m_s) next.velocity_m_s = velocity;
    next.walked_m += glm::length(next.at - player.at);
    if (glm::length(velocity) > 0.15) {
        next.facing_rad =
            turned_between(player.facing_rad, plan_angle(velocity), std::min(tick_s / turn_s, 1.0));
    }
    return next;
}

}  // namespace gnomon::game
