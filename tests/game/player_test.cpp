// SPDX-License-Identifier: MIT
#include "player.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "timing.hpp"

namespace gnomon::game {
namespace {

constexpr glm::dvec2 ground(10.0, 10.0);

Player after(Player player, const Input& input, int ticks,
             const std::vector<Obstacle>& obstacles = {}) {
    for (int i = 0; i < ticks; ++i) player = moved(player, input, obstacles, ground);
    return player;
}

TEST(Collision, clearance_is_the_distance_to_the_nearest_side) {
    const std::vector<Obstacle> box{{.at = {2.0, 0.0}, .half_m = {1.0, 0.5}}};
    EXPECT_DOUBLE_EQ(clearance({0.0, 0.0}, box), 1.0);
    EXPECT_DOUBLE_EQ(clearance({2.0, 2.5}, box), 2.0);
    EXPECT_DOUBLE_EQ(clearance({6.0, 4.5}, box), 5.0) << "from its corner";
    EXPECT_DOUBLE_EQ(clearance({2.0, 0.1}, box), -0.4) << "within";
    const std::vector<Obstacle> post{{.at = {0.0, 3.0}, .radius_m = 0.5}};
    EXPECT_DOUBLE_EQ(clearance({0.0, 0.0}, post), 2.5);
    EXPECT_EQ(clearance({0.0, 0.0}, {}), std::numeric_limits<double>::infinity());
}

TEST(Collision, a_box_turns_as_its_mesh_does) {
    // A quarter turn brings what lay along x to lie along z.
    const std::vector<Obstacle> box{
        {.at = {0.0, 0.0}, .half_m = {3.0, 0.5}, .turn_rad = 1.5707963267948966}};
    EXPECT_NEAR(clearance({2.0, 0.0}, box), 1.5, 1e-12);
    EXPECT_NEAR(clearance({0.0, 4.0}, box), 1.0, 1e-12);
    // An eighth brings +x to +x and -z.
    const std::vector<Obstacle> slanted{
        {.at = {0.0, 0.0}, .half_m = {3.0, 0.1}, .turn_rad = 0.7853981633974483}};
    EXPECT_LT(clearance({1.0, -1.0}, slanted), 0.0);
    EXPECT_GT(clearance({1.0, 1.0}, slanted), 1.0);
}

TEST(Collision, pushing_out_leaves_the_radius_and_slides_along) {
    const std::vector<Obstacle> box{{.at = {0.0, 0.0}, .half_m = {5.0, 0.5}}};
    const glm::dvec2 out = pushed_out({1.0, 0.7}, 0.3, box);
    EXPECT_DOUBLE_EQ(out.x, 1.0);
    EXPECT_DOUBLE_EQ(out.y, 0.8);
    EXPECT_EQ(pushed_out({1.0, 2.0}, 0.3, box), glm::dvec2(1.0, 2.0));
}

TEST(Player, sneaks_walks_and_runs) {
    EXPECT_NEAR(after({}, {.east = 127}, 60).speed_m_s(), Player::walk_m_s, 0.01);
    EXPECT_NEAR(after({}, {.east = 127, .sneak = true}, 60).speed_m_s(), Player::sneak_m_s, 0.01);
    EXPECT_NEAR(after({}, {.east = 127, .run = true}, 60).speed_m_s(), Player::run_m_s, 0.01);
    EXPECT_NEAR(after({}, {.east = 127, .sneak = true, .run = true}, 60).speed_m_s(),
                Player::sneak_m_s, 0.01)
        << "who sneaks does not run";
    EXPECT_NEAR(after({}, {.east = 90, .south = 90}, 60).speed_m_s(), Player::walk_m_s, 0.02)
        << "no faster along the diagonal";
    EXPECT_NEAR(after({}, {.east = 64}, 60).speed_m_s(), Player::walk_m_s / 2.0, 0.02);
}

TEST(Player, looks_where_it_goes_and_ducks_when_it_sneaks) {
    const Player east = after({}, {.east = 127}, 60);
    EXPECT_NEAR(east.facing_rad, 1.5707963, 1e-3);
    EXPECT_GT(east.at.x, 1.8);
    EXPECT_NEAR(east.walked_m, east.at.x, 1e-9);
    const Player ducked = after({}, {.sneak = true}, 60);
    EXPECT_GT(ducked.crouch, 0.95);
    EXPECT_EQ(ducked.speed_m_s(), 0.0);
    EXPECT_LT(after(ducked, {}, 60).crouch, 0.05);
}

TEST(Player, stops_at_walls_and_at_the_end_of_the_ground) {
    const std::vector<Obstacle> wall{{.at = {3.0, 0.0}, .half_m = {0.5, 8.0}}};
    const Player stopped = after({}, {.east = 127, .run = true}, 300, wall);
    EXPECT_NEAR(stopped.at.x, 2.5 - Player::radius_m, 1e-9);
    EXPECT_LT(stopped.speed_m_s(), 0.01);
    const Player sliding = after({}, {.east = 127, .south = 127}, 120, wall);
    EXPECT_GT(sliding.at.y, 2.0);
    EXPECT_NEAR(sliding.at.x, 2.5 - Player::radius_m, 1e-9);
    EXPECT_NEAR(after({}, {.south = 127, .run = true}, 600).at.y, 10.0 - Player::radius_m, 1e-9);
}

TEST(Player, is_not_pushed_over_the_end_of_the_ground) {
    // Reaches from within to beyond the border: the nearest way out is over it.
    const std::vector<Obstacle> crate{{.at = {9.5, 0.0}, .half_m = {0.7, 3.0}}};
    const Player pushed = after({.at = {9.65, 0.0}}, {}, 30, crate);
    EXPECT_LE(pushed.at.x, 10.0 - Player::radius_m);
    EXPECT_NEAR(after({.at = {5.0, 0.0}}, {.east = 127}, 300, crate).at.x, 8.5, 1e-9)
        << "from within it is as any other";
}

}  // namespace
}  // namespace gnomon::game
