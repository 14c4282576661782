// SPDX-License-Identifier: MIT
#include "play/readout.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "drawing.hpp"
#include "play/words.hpp"
#include "player.hpp"

namespace gnomon::game {
namespace {

constexpr glm::vec2 size{1280.0F, 720.0F};

Level wide_level() {
    Level level;
    level.size_m = {80.0, 80.0};
    return level;
}

shadows::View seen_from_above(const Level& level, double yaw_rad = 0.0) {
    return follow(level, Player{}, static_cast<double>(size.x / size.y), {.yaw_rad = yaw_rad});
}

TEST(ExitMark, is_at_the_exit_where_that_is_in_the_picture) {
    Level level = wide_level();
    level.exit = {2.0, -1.0};  // to the right of the middle, of a camera that looks north
    const auto mark = exit_mark(level, seen_from_above(level), size);
    ASSERT_TRUE(mark);
    EXPECT_FALSE(mark->way);
    EXPECT_GT(mark->at.x, size.x * 0.5F);
    EXPECT_LT(mark->at.x, size.x - 64.0F);
}

TEST(ExitMark, is_an_arrow_at_the_border_towards_an_exit_out_of_the_picture) {
    Level level = wide_level();
    struct Row {
        glm::dvec2 exit;
        glm::vec2 way;
    };
    for (const Row& row : {Row{{38.0, -1.0}, {1.0F, 0.0F}}, Row{{-38.0, -1.0}, {-1.0F, 0.0F}},
                           Row{{0.0, -38.0}, {0.0F, -1.0F}}, Row{{0.0, 38.0}, {0.0F, 1.0F}}}) {
        level.exit = row.exit;
        const auto mark = exit_mark(level, seen_from_above(level), size);
        ASSERT_TRUE(mark) << row.exit.x << ", " << row.exit.y;
        ASSERT_TRUE(mark->way);
        EXPECT_GT(glm::dot(*mark->way, row.way), 0.8F) << row.exit.x << ", " << row.exit.y;
        EXPECT_GE(mark->at.x, 63.0F);
        EXPECT_LE(mark->at.x, size.x - 63.0F);
        EXPECT_GE(mark->at.y, 63.0F);
        EXPECT_LE(mark->at.y, size.y - 95.0F) << "below is the meter";
    }
}

TEST(ExitMark, turns_with_the_camera) {
    Level level = wide_level();
    level.exit = {38.0, 0.0};
    // Looks west: the east is behind it.
    const auto mark = exit_mark(level, seen_from_above(level, std::numbers::pi * 0.5), size);
    ASSERT_TRUE(mark && mark->way);
    EXPECT_GT(mark->way->y, 0.8F);
}

TEST(ExitMark, has_a_place_in_the_smallest_picture) {
    Level level = wide_level();
    level.exit = {38.0, -1.0};
    const auto mark = exit_mark(level, seen_from_above(level), {40.0F, 30.0F});
    ASSERT_TRUE(mark);
    EXPECT_NEAR(mark->at.x, 20.0F, 2.0F);
}

TEST(Captions, stand_until_somebody_moves_and_then_go) {
    EXPECT_EQ(captions_at(0.0, true).name, 0.0);
    EXPECT_EQ(captions_at(60.0, true).name, 1.0);
    EXPECT_EQ(captions_at(60.0, true).hint, 1.0);
    EXPECT_GE(captions_at(60.0, true).first_step, 0.5);
    EXPECT_EQ(captions_at(60.0, true, true).first_step, 1.0) << "which keeps still";
    EXPECT_EQ(captions_at(3.0, false).name, 0.0);
    EXPECT_EQ(captions_at(3.0, false).hint, 1.0) << "there is time to read it";
    EXPECT_EQ(captions_at(3.0, false).first_step, 0.0);
    EXPECT_EQ(captions_at(15.0, false).hint, 0.0);
}

TEST(AlarmTint, begins_where_the_alarm_is_to_be_noticed) {
    EXPECT_EQ(alarm_tint({.alarm = 0.0}), 0.0);
    EXPECT_EQ(alarm_tint({.alarm = 0.02}), 0.0);
    EXPECT_GT(alarm_tint({.alarm = 0.03}), 0.35);
    EXPECT_EQ(alarm_tint({.alarm = 1.0}), 1.0);
}

TEST(Words, tell_the_time) {
    EXPECT_EQ(clock_text(0), "0:00.0");
    EXPECT_EQ(clock_text(6), "0:00.1");
    EXPECT_EQ(clock_text(64 * 60 + 30), "1:04.5");
}

TEST(Words, name_every_line_of_a_menu) {
    for (int kind = 0; kind <= static_cast<int>(MenuItem::Kind::Back); ++kind) {
        for (const Setting setting : all_settings) {
            const MenuItem item{.kind = static_cast<MenuItem::Kind>(kind), .setting = setting};
            EXPECT_NE(label_of(item, "The Yard"), "") << kind;
            EXPECT_NE(value_of(setting, Settings{}, "gl"), "");
        }
    }
    EXPECT_EQ(label_of({.kind = MenuItem::Kind::Level}, "The Yard"), "The Yard");
}

}  // namespace
}  // namespace gnomon::game
