// SPDX-License-Identifier: MIT
#include "movers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace gnomon::game {

namespace {

constexpr double full_circle = 2.0 * std::numbers::pi;

/// 0 at the ends of a period, 1 at its middle, slow at both.
double to_and_fro(Tick tick, double period_s) {
    return 0.5 - 0.5 * std::cos(full_circle * seconds(tick) / period_s);
}

/// 0 to 1, slow at both ends.
double eased(double share) {
    const double t = std::clamp(share, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

}  // namespace

glm::dvec2 plan_direction(double angle_rad) { return {std::sin(angle_rad), std::cos(angle_rad)}; }

double plan_angle(const glm::dvec2& direction) { return std::atan2(direction.x, direction.y); }

glm::dquat turned_in_plan(double angle_rad) {
    return glm::angleAxis(angle_rad, glm::dvec3(0.0, 1.0, 0.0));
}

double turned_between(double from_rad, double to_rad, double share) {
    return from_rad + std::remainder(to_rad - from_rad, full_circle) * share;
}

GuardPose guard_at(const Guard& guard, Tick tick) {
    const std::size_t count = guard.path.size();
    double lap_s = 0.0;
    double lap_m = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double length = glm::length(guard.path[(i + 1) % count] - guard.path[i]);
        lap_m += length;
        lap_s += length / guard.speed_m_s + guard.pause_s;
    }
    const double now_s = seconds(tick);
    const double laps = std::floor(now_s / lap_s);
    double left_s = now_s - laps * lap_s;
    GuardPose pose;
    pose.walked_m = laps * lap_m;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2 from = guard.path[i];
        const glm::dvec2 to = guard.path[(i + 1) % count];
        const double length = glm::length(to - from);
        const double walk_s = length / guard.speed_m_s;
        pose.facing_rad = plan_angle(to - from);
        if (left_s < walk_s) {
            const double walked = left_s * guard.speed_m_s;
            pose.at = from + (to - from) * (walked / length);
            pose.walked_m += walked;
            constexpr double settle_s = 0.3;
            pose.stride =
                guard.pause_s > 0.0 ? eased(std::min(left_s, walk_s - left_s) / settle_s) : 1.0;
            return pose;
        }
        left_s -= walk_s;
        pose.at = to;
        pose.walked_m += length;
        if (left_s < guard.pause_s) {
            // Looks where it came to, then turns to where it goes on.
            const double next = plan_angle(guard.path[(i + 2) % count] - to);
            pose.facing_rad = turned_between(pose.facing_rad, next,
                                             eased((left_s / guard.pause_s - 0.25) / 0.75));
            return pose;
        }
        left_s -= guard.pause_s;
    }
    return pose;  // by rounding alone: the lap's very end
}

glm::dvec2 searchlight_target(const Searchlight& light, Tick tick) {
    const std::size_t count = light.path.size();
    double around_m = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        around_m += glm::length(light.path[(i + 1) % count] - light.path[i]);
    }
    const double laps = seconds(tick) / light.period_s;
    double left_m = (laps - std::floor(laps)) * around_m;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2 step = light.path[(i + 1) % count] - light.path[i];
        const double length = glm::length(step);
        if (left_m < length) {
            // Slows down where it turns.
            const double share = left_m / length;
            return light.path[i] + step * (0.5 * share + 0.5 * eased(share));
        }
        left_m -= length;
    }
    return light.path.front();
}

glm::dvec3 towards_sun(const Sun& sun, Tick tick) {
    const glm::dvec2 place = glm::mix(sun.from_rad, sun.to_rad, to_and_fro(tick, sun.period_s));
    const glm::dvec2 plan = plan_direction(place.x);
    const double c = std::cos(place.y);
    return {plan.x * c, std::sin(place.y), plan.y * c};
}

double crane_turn(const Crane& crane, Tick tick) {
    return glm::mix(crane.swing_rad.x, crane.swing_rad.y, to_and_fro(tick, crane.period_s));
}

double crane_sway(const Crane& crane, Tick tick) {
    // As the arm accelerates, a little late; a real load would swing on, but not for ever the same.
    const double phase = full_circle * (seconds(tick) - 0.4) / crane.period_s;
    const double reach_rad = std::abs(crane.swing_rad.y - crane.swing_rad.x);
    return -0.05 * std::min(reach_rad, 1.5) * std::cos(phase) +
           0.012 * std::sin(full_circle * seconds(tick) / 3.7);
}

double wheel_turn(const Wheel& wheel, Tick tick) {
    const double turns = seconds(tick) / wheel.period_s;
    return full_circle * (turns - std::floor(turns));
}

}  // namespace gnomon::game
