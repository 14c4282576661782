// SPDX-License-Identifier: MIT
//
// The recordings that come with the game: each wins its level, and wins it alike every time.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "assets.hpp"
#include "autopilot.hpp"
#include "headless.hpp"
#include "recording.hpp"
#include "world.hpp"

namespace gnomon::game {
namespace {

Recording recording_of(const std::string& name) {
    auto recording = load_recording(std::filesystem::path(GNOMON_GAME_ASSETS) / "recordings" /
                                    (name + ".replay"));
    if (!recording) throw std::runtime_error(recording.error().message);
    return std::move(*recording);
}

Level level_of(const std::string& name) {
    auto level = load_named_level(GNOMON_GAME_ASSETS, name);
    if (!level) throw std::runtime_error(level.error().message);
    return std::move(*level);
}

/// None where the folder cannot be read, which the test below tells.
std::vector<std::string> names_of_all() {
    return level_names(GNOMON_GAME_ASSETS).value_or(std::vector<std::string>{});
}

TEST(Replays, are_of_three_levels_at_least) { EXPECT_GE(names_of_all().size(), 3U); }

class Replay : public testing::TestWithParam<std::string> {};

TEST_P(Replay, wins_its_level) {
    const Recording recording = recording_of(GetParam());
    EXPECT_EQ(recording.level, GetParam());
    const auto ended = play(level_of(GetParam()), recording);
    ASSERT_TRUE(ended) << ended.error().message;
    EXPECT_EQ(ended->outcome, Outcome::Won);
    EXPECT_EQ(ended->ticks, recording.inputs.size()) << "with its last input";
}

TEST_P(Replay, has_the_same_hash_in_every_tick_of_every_run) {
    const Recording recording = recording_of(GetParam());
    auto first = World::create(level_of(GetParam()));
    auto second = World::create(level_of(GetParam()));
    ASSERT_TRUE(first && second);
    // The second one has a life behind it: what its queries and caches hold is from then.
    for (std::size_t i = 0; i < 40; ++i) ASSERT_TRUE(second->tick({.east = -127, .run = true}));
    ASSERT_TRUE(second->tick({.restart = true}));
    for (std::size_t i = 0; i < recording.inputs.size(); ++i) {
        ASSERT_EQ(first->hash(), second->hash()) << "before input " << i;
        ASSERT_TRUE(first->tick(recording.inputs[i]));
        ASSERT_TRUE(second->tick(recording.inputs[i]));
    }
    EXPECT_EQ(first->hash(), second->hash());
    EXPECT_EQ(first->outcome(), Outcome::Won);
}

INSTANTIATE_TEST_SUITE_P(Levels, Replay, testing::ValuesIn(names_of_all()),
                         [](const auto& level) { return level.param; });

TEST(Autopilot, finds_the_courtyards_way_and_is_not_seen) {
    const Level level = level_of("courtyard");
    const auto recording = play_by_itself(level, "courtyard");
    ASSERT_TRUE(recording) << recording.error().message;
    auto world = World::create(level);
    ASSERT_TRUE(world);
    double worst = 0.0;
    for (const Input& input : recording->inputs) {
        ASSERT_TRUE(world->tick(input));
        worst = std::max(worst, world->meter().alarm);
    }
    EXPECT_EQ(world->outcome(), Outcome::Won);
    EXPECT_LT(worst, 0.5);
}

TEST(Autopilot, says_where_there_is_no_way) {
    Level level;
    level.name = "walled in";
    level.size_m = {8.0, 8.0};
    level.start = {-3.0, 0.0};
    level.exit = {3.0, 0.0};
    level.blocks.push_back({.at = {0.0, 0.0}, .size_m = {0.5, 2.0, 8.0}});
    const auto plan = plan_way(level, {.longest_s = 20.0});
    ASSERT_FALSE(plan);
    EXPECT_EQ(plan.error().message,
              "There is no way through \"walled in\" within 20 s on which no more than 0.5 of a "
              "figure is lit.");
}

}  // namespace
}  // namespace gnomon::game
