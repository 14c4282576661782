// SPDX-License-Identifier: MIT
#include "world.hpp"

#include <algorithm>
#include <cmath>

#include "movers.hpp"
#include "state_hash.hpp"

namespace gnomon::game {

namespace {

constexpr double touch_m = 0.62;  // as near to a guard is caught

glm::dvec2 middle_of(const Door& door) {
    return door.hinge + plan_direction(door.turn_rad) * (door.width_m * 0.5);
}

}  // namespace

Result<World> World::create(const Level& level) {
    auto stage = Stage::create(level);
    if (!stage) return forward_error(stage);
    World world(level, std::move(*stage));
    world.restart();
    if (const Status looked = world.look(); !looked) return forward_error(looked);
    return world;
}

World::World(const Level& level, Stage stage) : level_(level), stage_(std::move(stage)) {}

void World::restart() {
    now_ = 0;
    outcome_ = Outcome::Playing;
    player_ = {.at = level_.start, .facing_rad = level_.start_facing_rad};
    doors_.assign(level_.doors.size(), 0.0);
    meter_ = {};
}

void World::move_doors() {
    constexpr double opens_s = 0.55;
    constexpr double near_m = 1.5;
    for (std::size_t i = 0; i < doors_.size(); ++i) {
        const glm::dvec2 middle = middle_of(level_.doors[i]);
        bool is_near = glm::length(player_.at - middle) < near_m;
        for (const Guard& guard : level_.guards) {
            is_near = is_near || glm::length(guard_at(guard, now_).at - middle) < near_m;
        }
        doors_[i] = std::clamp(doors_[i] + (is_near ? tick_s : -tick_s) / opens_s, 0.0, 1.0);
    }
    const auto standing = stage_.obstacles();
    obstacles_.assign(standing.begin(), standing.end());
    for (std::size_t i = 0; i < doors_.size(); ++i) {
        // A leaf that has swung half way lets pass, and then stands along a wall.
        if (doors_[i] > 0.5) continue;
        const Door& door = level_.doors[i];
        obstacles_.push_back({.at = middle_of(door),
                              .half_m = {0.06, door.width_m * 0.5},
                              .turn_rad = door.turn_rad});
    }
}

double World::noise(const Input& input) const {
    if (!input.run || input.sneak || player_.speed_m_s() <= Player::walk_m_s) return 0.0;
    double loudest = 0.0;
    for (const Guard& guard : level_.guards) {
        const double distance = glm::length(guard_at(guard, now_).at - player_.at);
        if (distance < guard.hearing_m) {
            loudest = std::max(loudest, 1.0 - 0.5 * distance / guard.hearing_m);
        }
    }
    return loudest;
}

Status World::look() {
    const Scenery scenery{.tick = now_, .player = &player_, .meter = &meter_, .doors = doors_};
    if (const Status posed = stage_.pose(scenery); !posed) return posed;
    reading_ = read_exposure(stage_.queries(), stage_.lights(), stage_.player_points(),
                             level_.seen_lux, stage_.player_keys());
    return {};
}

Status World::tick(const Input& input) {
    if (input.restart) {
        restart();
        return look();
    }
    if (input.pause || outcome_ != Outcome::Playing) return {};
    ++now_;
    move_doors();
    player_ = moved(player_, input, obstacles_, level_.size_m * 0.5);
    if (const Status looked = look(); !looked) return looked;
    meter_ = advanced(meter_, reading_.level, noise(input), level_.caught_after_s);

    if (meter_.alarm >= 1.0) outcome_ = Outcome::Caught;
    for (const Guard& guard : level_.guards) {
        if (glm::length(guard_at(guard, now_).at - player_.at) < touch_m) {
            outcome_ = Outcome::Caught;
        }
    }
    const glm::dvec2 from_exit = glm::abs(player_.at - level_.exit);
    const bool is_out = from_exit.x < level_.exit_half_m.x && from_exit.y < level_.exit_half_m.y;
    if (outcome_ == Outcome::Playing && is_out) outcome_ = Outcome::Won;
    return {};
}

std::uint64_t World::hash() const {
    StateHash hash;
    hash.add(std::uint64_t{now_});
    hash.add(static_cast<std::uint64_t>(outcome_));
    hash.add(player_.at);
    hash.add(player_.velocity_m_s);
    hash.add_turn(player_.facing_rad);
    hash.add(player_.walked_m);
    hash.add(player_.crouch);
    for (const double open : doors_) hash.add(open);
    for (const Guard& guard : level_.guards) {
        const GuardPose pose = guard_at(guard, now_);
        hash.add(pose.at);
        hash.add_turn(pose.facing_rad);
    }
    for (const Searchlight& light : level_.searchlights) hash.add(searchlight_target(light, now_));
    for (const Crane& crane : level_.cranes) hash.add_turn(crane_turn(crane, now_));
    for (const Wheel& wheel : level_.wheels) hash.add_turn(wheel_turn(wheel, now_));
    if (level_.sun) {
        const glm::dvec3 sun = towards_sun(*level_.sun, now_);
        hash.add(glm::dvec2(sun.x, sun.y));
        hash.add(sun.z);
    }
    for (const std::uint32_t reached : reading_.reached) hash.add(std::uint64_t{reached});
    hash.add(reading_.level);
    hash.add(meter_.light);
    hash.add(meter_.alarm);
    hash.add(std::uint64_t{meter_.is_seen ? 1U : 0U});
    return hash.value();
}

}  // namespace gnomon::game
