// SPDX-License-Identifier: MIT
#include "movers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gnomon::game {
namespace {

constexpr double pi = std::numbers::pi;

Guard square() {
    return {
        .path = {{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {0.0, 4.0}}, .speed_m_s = 2.0, .pause_s = 1.0};
}

TEST(Guards, walk_from_point_to_point_and_wait_there) {
    const Guard guard = square();
    const GuardPose start = guard_at(guard, 0);
    EXPECT_EQ(start.at, glm::dvec2(0.0, 0.0));
    EXPECT_DOUBLE_EQ(start.facing_rad, pi / 2.0) << "east";
    const GuardPose walking = guard_at(guard, 60);
    EXPECT_NEAR(walking.at.x, 2.0, 1e-12);
    EXPECT_DOUBLE_EQ(walking.stride, 1.0);
    const GuardPose waiting = guard_at(guard, 60 * 2 + 30);
    EXPECT_EQ(waiting.at, glm::dvec2(4.0, 0.0));
    EXPECT_EQ(waiting.stride, 0.0);
    EXPECT_NEAR(guard_at(guard, 60 * 3 + 60).at.y, 2.0, 1e-12) << "south";
}

TEST(Guards, never_jump_nor_turn_at_once) {
    const Guard guard = square();
    GuardPose before = guard_at(guard, 0);
    for (Tick tick = 1; tick < 3000; ++tick) {
        const GuardPose now = guard_at(guard, tick);
        EXPECT_LE(glm::length(now.at - before.at), guard.speed_m_s * tick_s + 1e-9);
        EXPECT_LE(std::abs(std::remainder(now.facing_rad - before.facing_rad, 2.0 * pi)), 0.1);
        EXPECT_GE(now.walked_m, before.walked_m - 1e-9);
        before = now;
    }
    EXPECT_NEAR(before.walked_m, 2.0 * 2999 * tick_s * 2.0 / 3.0, 3.0) << "two of three seconds";
}

TEST(Searchlights, follow_their_path_and_are_back_after_a_period) {
    const Searchlight light{.path = {{0.0, 0.0}, {6.0, 0.0}, {6.0, 6.0}}, .period_s = 10.0};
    EXPECT_EQ(searchlight_target(light, 0), glm::dvec2(0.0, 0.0));
    EXPECT_LT(glm::length(searchlight_target(light, 600)), 1e-9);
    glm::dvec2 before = searchlight_target(light, 0);
    for (Tick tick = 1; tick <= 600; ++tick) {
        const glm::dvec2 now = searchlight_target(light, tick);
        EXPECT_LT(glm::length(now - before), 0.08);
        before = now;
    }
}

TEST(Suns, swing_between_two_places_of_the_sky) {
    const Sun sun{.from_rad = {0.0, 0.5}, .to_rad = {pi / 2.0, 0.5}, .period_s = 60.0};
    const glm::dvec3 begin = towards_sun(sun, 0);
    EXPECT_NEAR(begin.z, std::cos(0.5), 1e-12) << "in the south";
    EXPECT_NEAR(begin.y, std::sin(0.5), 1e-12);
    const glm::dvec3 middle = towards_sun(sun, 60 * 30);
    EXPECT_NEAR(middle.x, std::cos(0.5), 1e-12) << "in the east";
    EXPECT_NEAR(glm::length(towards_sun(sun, 777)), 1.0, 1e-12);
    EXPECT_NEAR(glm::length(towards_sun(sun, 60 * 60) - begin), 0.0, 1e-12);
}

TEST(Turns, go_the_shorter_way) {
    EXPECT_NEAR(turned_between(3.0, -3.0, 0.5), pi, 1e-12);
    EXPECT_NEAR(turned_between(0.1, -0.1, 1.0), -0.1, 1e-12);
    for (const double angle : {-2.0, 0.0, 0.7, 3.0}) {
        EXPECT_NEAR(plan_angle(plan_direction(angle)), angle, 1e-12);
    }
}

}  // namespace
}  // namespace gnomon::game
