// SPDX-License-Identifier: MIT
#include "world.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>
#include <utility>

#include "tests/game/small_level.hpp"

namespace gnomon::game {
namespace {

World must_create(const Level& level) {
    auto world = World::create(level);
    if (!world) throw std::runtime_error(world.error().message);
    return std::move(*world);
}

/// Until it is over, for a minute at most.
Outcome play_out(World& world, const Input& input) {
    for (int i = 0; i < 3600 && world.outcome() == Outcome::Playing; ++i) {
        EXPECT_TRUE(world.tick(input));
    }
    return world.outcome();
}

TEST(World, is_won_at_the_exit) {
    World world = must_create(bare_level());
    EXPECT_EQ(play_out(world, {.east = 127}), Outcome::Won);
    EXPECT_NEAR(world.player().at.x, 5.2, 0.1);
    const std::uint64_t hash = world.hash();
    EXPECT_TRUE(world.tick({.east = 127}));
    EXPECT_EQ(world.hash(), hash) << "nothing moves any more";
}

TEST(World, is_lost_in_the_light) {
    Level level = bare_level();
    level.sun = noon(50.0);
    level.caught_after_s = 1.0;
    World world = must_create(level);
    EXPECT_EQ(play_out(world, {}), Outcome::Caught);
    EXPECT_NEAR(seconds(world.now()), 1.1, 0.15);
}

TEST(World, is_lost_at_a_guards_hands) {
    Level level = bare_level();
    level.exit = {6.0, 5.0};
    level.guards.push_back({.path = {{0.0, 0.0}, {0.0, 0.2}}, .speed_m_s = 0.1, .candela = 0.0});
    World world = must_create(level);
    EXPECT_EQ(play_out(world, {.east = 127}), Outcome::Caught);
    EXPECT_NEAR(world.player().at.x, -0.6, 0.05);
}

TEST(World, a_runner_is_heard_and_a_walker_is_not) {
    Level level = bare_level();
    level.exit = {6.0, 5.0};
    level.caught_after_s = 0.5;
    level.guards.push_back(
        {.path = {{0.0, 3.0}, {0.2, 3.0}}, .speed_m_s = 0.1, .hearing_m = 6.0, .candela = 0.0});
    World walked = must_create(level);
    World run = must_create(level);
    for (int i = 0; i < 150; ++i) {
        EXPECT_TRUE(walked.tick({.east = 100}));
        EXPECT_TRUE(run.tick({.east = 100, .run = true}));
    }
    EXPECT_EQ(walked.outcome(), Outcome::Playing);
    EXPECT_EQ(walked.meter().alarm, 0.0);
    EXPECT_EQ(run.outcome(), Outcome::Caught);
}

TEST(World, a_door_opens_for_who_is_near) {
    Level level = bare_level();
    // A wall with a gap of 1.4 metres, shut by a leaf.
    level.blocks.push_back({.at = {0.0, -3.35}, .size_m = {0.3, 2.4, 5.3}});
    level.blocks.push_back({.at = {0.0, 3.35}, .size_m = {0.3, 2.4, 5.3}});
    World without = must_create(level);
    level.doors.push_back({.hinge = {0.0, -0.7}, .width_m = 1.4, .turn_rad = 0.0});
    World with = must_create(level);
    const std::uint64_t shut = with.hash();
    EXPECT_EQ(play_out(without, {.east = 127}), Outcome::Won);
    EXPECT_EQ(play_out(with, {.east = 127, .run = true}), Outcome::Won);
    EXPECT_TRUE(with.tick({.restart = true}));
    EXPECT_EQ(with.hash(), shut) << "and it is shut again";
}

TEST(World, a_door_holds_back_who_is_there_before_it_is_open) {
    // Near is about the leaf's middle; whoever runs at the edge of a wide one comes near late.
    Level level = bare_level();
    level.start = {-5.0, 1.45};
    level.exit = {6.0, 1.45};
    World without = must_create(level);
    level.doors.push_back({.hinge = {0.0, -2.0}, .width_m = 4.0, .turn_rad = 0.0});
    World with = must_create(level);
    const Input run{.east = 127, .run = true};
    EXPECT_EQ(play_out(without, run), Outcome::Won);
    double farthest = with.player().at.x;
    int held = 0;
    while (with.outcome() == Outcome::Playing && with.now() < 3600) {
        EXPECT_TRUE(with.tick(run));
        held += with.player().at.x - farthest < 1e-9 ? 1 : 0;
        farthest = with.player().at.x;
        // It stands 0.06 metres before the leaf's plane, and the figure's radius away from that.
        if (held > 0 && held < 10) {
            EXPECT_NEAR(farthest, -0.36, 1e-9);
        }
    }
    EXPECT_EQ(with.outcome(), Outcome::Won);
    EXPECT_GE(held, 10);
    EXPECT_GE(with.now(), without.now() + 10);
}

TEST(World, a_pause_holds_everything) {
    World world = must_create(bare_level());
    for (int i = 0; i < 30; ++i) EXPECT_TRUE(world.tick({.east = 127}));
    const std::uint64_t hash = world.hash();
    const Tick now = world.now();
    for (int i = 0; i < 30; ++i) EXPECT_TRUE(world.tick({.east = 127, .pause = true}));
    EXPECT_EQ(world.hash(), hash);
    EXPECT_EQ(world.now(), now);
}

TEST(World, a_restart_is_a_start) {
    World world = must_create(bare_level());
    const std::uint64_t start = world.hash();
    for (int i = 0; i < 60; ++i) EXPECT_TRUE(world.tick({.east = 127, .sneak = true}));
    EXPECT_NE(world.hash(), start);
    EXPECT_TRUE(world.tick({.east = 127, .restart = true}));
    EXPECT_EQ(world.hash(), start);
}

TEST(World, every_tick_has_a_hash_of_its_own) {
    World world = must_create(bare_level());
    std::uint64_t before = world.hash();
    for (int i = 0; i < 60; ++i) {
        EXPECT_TRUE(world.tick({}));
        EXPECT_NE(world.hash(), before);
        before = world.hash();
    }
}

}  // namespace
}  // namespace gnomon::game
