// SPDX-License-Identifier: MIT
#include "controls.hpp"

#include <gtest/gtest.h>

#include <limits>

#include <gnomon/shadows/view.hpp>

#include "drawing.hpp"

namespace gnomon::game {
namespace {

TEST(Controls, go_where_the_picture_says) {
    EXPECT_EQ(input_of({.right = 1.0}, 0.0), (Input{.east = 127}));
    EXPECT_EQ(input_of({.up = 1.0}, 0.0), (Input{.south = -127}));
    const Input both = input_of({.right = 1.0, .up = 1.0}, 0.0);
    EXPECT_EQ(both.east, 90);
    EXPECT_EQ(both.south, -90);
}

TEST(Controls, follow_the_camera_round) {
    for (const double yaw : {-2.5, -1.0, 0.0, 0.4, 1.5707963, 3.0}) {
        Level level;
        level.size_m = {200.0, 200.0};
        level.camera.yaw_rad = yaw;
        const shadows::View view = follow(level, {}, 1.5);
        const auto on_screen = [&](const Input& input) {
            return glm::dvec2(view.view_from_world * glm::dvec4(input.east, 0.0, input.south, 0.0));
        };
        const glm::dvec2 right = on_screen(input_of({.right = 1.0}, yaw));
        EXPECT_GT(right.x, 125.0);
        EXPECT_NEAR(right.y, 0.0, 1.5);
        const glm::dvec2 up = on_screen(input_of({.up = 1.0}, yaw));
        EXPECT_NEAR(up.x, 0.0, 1.5);
        EXPECT_GT(up.y, 50.0);
    }
}

TEST(Controls, rest_within_the_dead_zone_and_begin_slowly_beyond) {
    EXPECT_EQ(input_of({.right = 0.1, .up = 0.1}, 0.0), Input{});
    EXPECT_LE(input_of({.right = dead_zone + 0.02}, 0.0).east, 4);
    EXPECT_GT(input_of({.right = dead_zone + 0.02}, 0.0).east, 0);
    EXPECT_NEAR(input_of({.right = 0.575}, 0.0).east, 64, 1);
}

TEST(Controls, of_broken_sticks_are_at_rest) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(input_of({.right = none, .up = 1.0}, 0.0), Input{});
    EXPECT_EQ(input_of({.right = infinite}, 0.0), Input{});
    EXPECT_EQ(input_of({.right = 1e9}, 0.0), (Input{.east = 127}));
}

TEST(Controls, hand_buttons_on) {
    EXPECT_EQ(input_of({.sneak = true, .run = true, .restart = true, .pause = true}, 1.0),
              (Input{.sneak = true, .run = true, .restart = true, .pause = true}));
}

TEST(Camera, turns_by_what_is_asked_for_and_not_below_the_ground) {
    Level level;
    level.size_m = {200.0, 200.0};
    const auto eye_of = [&](const Look& look) {
        return glm::dvec3(glm::inverse(follow(level, {}, 1.5, look).view_from_world)[3]);
    };
    EXPECT_EQ(eye_of({}), glm::dvec3(glm::inverse(follow(level, {}, 1.5).view_from_world)[3]));
    EXPECT_GT(eye_of({.yaw_rad = 1.5707963}).x, 5.0) << "from the east";
    EXPECT_GT(eye_of({.pitch_rad = -10.0}).y, 1.0);
    EXPECT_LT(eye_of({.nearer = 2.0}).y, 0.7 * eye_of({}).y);
}

// A level, its camera and who is in it may be turned together: the picture is the same.
TEST(Camera, stays_over_a_level_that_is_turned_with_it) {
    // A quarter turn in plan, as plan angles turn: south becomes east.
    const auto turned = [](const glm::dvec2& plan) { return glm::dvec2(plan.y, -plan.x); };
    Level level;
    level.size_m = {40.0, 24.0};
    for (const double yaw : {0.0, 0.3, -1.1}) {
        level.camera.yaw_rad = yaw;
        Level other = level;
        other.size_m = {24.0, 40.0};
        other.camera.yaw_rad = yaw + 1.5707963267948966;
        for (const glm::dvec2& at : {glm::dvec2(18.0, 10.0), {-18.0, 3.0}, {2.0, -11.0}}) {
            const auto eye_of = [](const Level& of, const glm::dvec2& who) {
                return glm::dvec3(glm::inverse(follow(of, {.at = who}, 1.78).view_from_world)[3]);
            };
            const glm::dvec3 eye = eye_of(level, at);
            const glm::dvec3 other_eye = eye_of(other, turned(at));
            EXPECT_NEAR(glm::length(turned({eye.x, eye.z}) - glm::dvec2(other_eye.x, other_eye.z)),
                        0.0, 1e-9);
        }
    }
}

}  // namespace
}  // namespace gnomon::game
