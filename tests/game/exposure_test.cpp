// SPDX-License-Identifier: MIT
#include "exposure.hpp"

#include <gtest/gtest.h>

#include <gnomon/scene/transforms.hpp>

#include <cmath>

#include "stage.hpp"
#include "tests/game/small_level.hpp"
#include "timing.hpp"

namespace gnomon::game {
namespace {

TEST(Illuminance, falls_with_the_square_and_ends_at_the_range) {
    MeterLight lamp{.shadow = {.position_world = {0.0, 2.0, 0.0, 1.0}}, .intensity = 8.0};
    EXPECT_DOUBLE_EQ(illuminance(lamp, {0.0, 0.0, 0.0}), 2.0);
    EXPECT_DOUBLE_EQ(illuminance(lamp, {0.0, -2.0, 0.0}), 0.5);
    lamp.shadow.range_m = 4.0;
    EXPECT_DOUBLE_EQ(illuminance(lamp, {0.0, 0.0, 0.0}), 2.0 * 0.9375);
    EXPECT_EQ(illuminance(lamp, {0.0, -2.0, 0.0}), 0.0);
    const MeterLight sun{.shadow = {.position_world = {0.0, 1.0, 0.0, 0.0}}, .intensity = 3.0};
    EXPECT_EQ(illuminance(sun, {100.0, -50.0, 3.0}), 3.0);
}

TEST(Illuminance, of_a_spot_is_in_its_cone) {
    MeterLight spot{.shadow = {.position_world = {0.0, 4.0, 0.0, 1.0}},
                    .intensity = 16.0,
                    .axis = {0.0, -1.0, 0.0},
                    .cos_inner = std::cos(0.2),
                    .cos_outer = std::cos(0.4)};
    EXPECT_DOUBLE_EQ(illuminance(spot, {0.0, 0.0, 0.0}), 1.0);
    EXPECT_GT(illuminance(spot, {4.0 * std::tan(0.3), 0.0, 0.0}), 0.0);
    EXPECT_LT(illuminance(spot, {4.0 * std::tan(0.3), 0.0, 0.0}), 0.7);
    EXPECT_EQ(illuminance(spot, {4.0 * std::tan(0.41), 0.0, 0.0}), 0.0);
    EXPECT_EQ(illuminance(spot, {0.0, 8.0, 0.0}), 0.0) << "behind it";
}

TEST(Meter, rises_while_seen_and_forgets_while_hidden) {
    Meter meter;
    int ticks = 0;
    while (meter.alarm < 1.0 && ticks < 1000) {
        meter = advanced(meter, 1.0, 0.0, 1.0);
        ++ticks;
    }
    EXPECT_TRUE(meter.is_seen);
    EXPECT_GE(ticks, 60);
    EXPECT_LE(ticks, 80) << "a second, and a moment until the eye sees";
    for (int i = 0; i < 60; ++i) meter = advanced(meter, 0.0, 0.0, 1.0);
    EXPECT_FALSE(meter.is_seen);
    EXPECT_GT(meter.alarm, 0.5) << "it takes longer to forget";
    for (int i = 0; i < 180; ++i) meter = advanced(meter, 0.0, 0.0, 1.0);
    EXPECT_EQ(meter.alarm, 0.0);
}

TEST(Meter, has_hysteresis) {
    const double between = (Meter::seen_from + Meter::hidden_below) / 2.0;
    Meter from_dark;
    for (int i = 0; i < 200; ++i) from_dark = advanced(from_dark, between, 0.0, 1.0);
    EXPECT_FALSE(from_dark.is_seen);
    EXPECT_EQ(from_dark.alarm, 0.0);
    Meter from_light;
    for (int i = 0; i < 20; ++i) from_light = advanced(from_light, 1.0, 0.0, 60.0);
    for (int i = 0; i < 200; ++i) from_light = advanced(from_light, between, 0.0, 60.0);
    EXPECT_TRUE(from_light.is_seen);
}

TEST(Meter, hears_in_the_dark) {
    Meter meter;
    for (int i = 0; i < 30; ++i) meter = advanced(meter, 0.0, 1.0, 1.0);
    EXPECT_FALSE(meter.is_seen);
    EXPECT_NEAR(meter.alarm, 0.5, 1e-9);
}

Reading reading_of(const Level& level, const Player& player) {
    Stage stage = *Stage::create(level);
    EXPECT_TRUE(stage.pose({.player = &player}));
    return read_exposure(stage.queries(), stage.lights(), stage.player_points(), level.seen_lux,
                         stage.player_keys());
}

TEST(Reading, is_one_in_the_sun_and_nothing_under_a_roof) {
    Level level = bare_level();
    level.sun = noon(5.0);
    level.seen_lux = 5.0;
    level.blocks.push_back({.at = {0.0, 0.0}, .size_m = {3.0, 0.2, 3.0}, .base_m = 3.0});
    const Reading open = reading_of(level, {.at = {-4.0, 0.0}});
    EXPECT_DOUBLE_EQ(open.level, 1.0) << "its own shadow hides nobody";
    EXPECT_EQ(open.reached.front() & 0x1FFU, 0U) << "the beacon of the exit is far";
    EXPECT_EQ(open.reached.back(), 0x1FFU) << "nine points";
    EXPECT_EQ(reading_of(level, {.at = {0.0, 0.0}}).level, 0.0);
    level.seen_lux = 10.0;
    EXPECT_DOUBLE_EQ(reading_of(level, {.at = {-4.0, 0.0}}).level, 0.5);
}

TEST(Reading, of_one_who_ducks_behind_what_is_low_is_dark) {
    Level level = bare_level();
    // From the east, at 30 degrees; a wall of a metre and a half.
    level.sun = Sun{.from_rad = {1.5707963, 0.5236}, .to_rad = {1.5707963, 0.5236}, .lux = 5.0};
    level.blocks.push_back({.at = {0.0, 0.0}, .size_m = {0.3, 1.5, 6.0}});
    const glm::dvec2 behind(-0.5, 0.0);
    const double upright = reading_of(level, {.at = behind}).level;
    const double ducked = reading_of(level, {.at = behind, .crouch = 1.0}).level;
    EXPECT_GT(upright, 0.1);
    EXPECT_EQ(ducked, 0.0);
}

TEST(Stage, a_figure_ducks_as_a_whole_and_its_feet_stay_on_the_ground) {
    Stage stage = *Stage::create(bare_level());
    const auto points_of = [&](const Player& player) {
        EXPECT_TRUE(stage.pose({.player = &player}));
        return stage.player_points();
    };
    const auto upright = points_of({});
    EXPECT_NEAR(upright.front().y, 1.67, 0.03) << "of the head";
    const auto ducked = points_of({.crouch = 1.0});
    EXPECT_LT(ducked.front().y, 1.2);
    for (std::size_t foot : {upright.size() - 2, upright.size() - 1}) {
        EXPECT_NEAR(ducked[foot].y, upright[foot].y, 0.06);
    }
}

}  // namespace
}  // namespace gnomon::game
