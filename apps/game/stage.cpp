// SPDX-License-Identifier: MIT
//
// Where everything stands at a tick; stage_builder.cpp makes it.
#include "stage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <glm/gtc/quaternion.hpp>

#include <gnomon/scene/deform.hpp>
#include <gnomon/scene/transforms.hpp>

#include "movers.hpp"

namespace gnomon::game {

namespace {

const glm::dvec3 up(0.0, 1.0, 0.0);

/// With -Z along `direction`.
glm::dquat looking_along(const glm::dvec3& direction) {
    const glm::dvec3 hint =
        std::abs(glm::normalize(direction).y) > 0.999 ? glm::dvec3(0.0, 0.0, -1.0) : up;
    return glm::quatLookAt(glm::normalize(direction), hint);
}

double stride_of(const Player& player) {
    const double speed = player.speed_m_s();
    if (speed <= Player::walk_m_s) return std::min(speed / 1.3, 1.0);
    return 1.0 + 0.5 * (speed - Player::walk_m_s) / (Player::run_m_s - Player::walk_m_s);
}

}  // namespace

void Stage::pose_figures(const Scenery& scenery) {
    scene::Registry& registry = scene_.registry;
    if (scenery.player != nullptr) {
        const Player& player = *scenery.player;
        pose_figure(registry, skeleton_, player_,
                    {.at = player.at,
                     .facing_rad = player.facing_rad,
                     .walked_m = player.walked_m,
                     .stride = stride_of(player),
                     .crouch = player.crouch});
    }
    for (std::size_t i = 0; i < guards_.size(); ++i) {
        const GuardPose pose = guard_at(level_.guards[i], scenery.tick);
        pose_figure(registry, skeleton_, guards_[i],
                    {.at = pose.at,
                     .facing_rad = pose.facing_rad,
                     .walked_m = pose.walked_m,
                     .stride = pose.stride,
                     .carries_lamp = true});
        // The hand is still; the lamp sways a little from side to side, and so does its light.
        auto& lamp = registry.get<scene::LocalTransform>(guard_lamps_[i]);
        const double sway = 0.05 * pose.stride * std::sin(pose.walked_m * 5.4) +
                            0.12 * std::sin(seconds(scenery.tick) * 0.7);
        lamp.rotation = turned_in_plan(sway) * looking_along({0.0, -0.24, 1.0});
    }
}

void Stage::pose_movers(const Scenery& scenery) {
    scene::Registry& registry = scene_.registry;
    const auto local = [&](scene::Entity entity) -> scene::LocalTransform& {
        return registry.get<scene::LocalTransform>(entity);
    };
    for (std::size_t i = 0; i < searchlights_.size(); ++i) {
        const Searchlight& light = level_.searchlights[i];
        const glm::dvec2 target = searchlight_target(light, scenery.tick);
        local(searchlights_[i]).rotation =
            looking_along(glm::dvec3(target.x, 0.0, target.y) - light.at);
    }
    for (std::size_t i = 0; i < doors_.size(); ++i) {
        const Door& door = level_.doors[i];
        const double open = i < scenery.doors.size() ? scenery.doors[i] : 0.0;
        const double eased = open * open * (3.0 - 2.0 * open);
        local(doors_[i]).rotation = turned_in_plan(door.turn_rad + door.open_rad * eased);
    }
    for (std::size_t i = 0; i < crane_arms_.size(); ++i) {
        const Crane& crane = level_.cranes[i];
        local(crane_arms_[i]).rotation = turned_in_plan(crane_turn(crane, scenery.tick));
        local(crane_loads_[i]).rotation =
            glm::angleAxis(crane_sway(crane, scenery.tick), glm::dvec3(0.0, 0.0, 1.0));
    }
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
        local(wheels_[i]).rotation =
            turned_in_plan(level_.wheels[i].turn_rad) *
            glm::angleAxis(wheel_turn(level_.wheels[i], scenery.tick), glm::dvec3(0.0, 0.0, 1.0));
    }
    if (sun_) local(*sun_).rotation = looking_along(-towards_sun(*level_.sun, scenery.tick));
}

void Stage::pose_ring(const Scenery& scenery) {
    scene::Registry& registry = scene_.registry;
    if (scenery.player != nullptr) {
        registry.get<scene::LocalTransform>(ring_).translation = {scenery.player->at.x, 0.0,
                                                                  scenery.player->at.y};
    }
    const bool is_shown = scenery.player != nullptr && scenery.meter != nullptr;
    const double count = static_cast<double>(segments_.size());
    for (std::size_t i = 0; i < segments_.size(); ++i) {
        std::size_t look = 0;
        if (is_shown) {
            const double place = static_cast<double>(i) + 0.5;
            if (place < scenery.meter->light * count) look = 1;
            if (place < scenery.meter->alarm * count) look = 2;
        }
        for (std::size_t k = 0; k < segments_[i].size(); ++k) {
            const scene::Entity entity = segments_[i][k];
            const bool drawn = is_shown && k == look;
            if (drawn == registry.has<scene::Receiver>(entity)) continue;
            if (drawn) {
                registry.emplace<scene::Receiver>(entity);
            } else {
                registry.remove<scene::Receiver>(entity);
            }
        }
    }
}

Status Stage::pose(const Scenery& scenery) {
    pose_figures(scenery);
    pose_movers(scenery);
    pose_ring(scenery);
    scene::update_world_transforms(scene_.registry);
    if (const Status deformed = scene::deform(scene_); !deformed) return deformed;
    auto casters = adapter_.casters(scene_);
    if (!casters) return forward_error(casters);
    if (scenery.player == nullptr) {
        std::erase_if(*casters, [&](const shadows::Caster& caster) {
            return std::ranges::find(player_keys_, caster.key) != player_keys_.end();
        });
    }
    queries_.update(*casters);
    lights_ = meter_lights(scene_);
    return {};
}

std::vector<glm::dvec3> Stage::player_points() const {
    struct Point {
        std::string_view joint;
        glm::dvec3 offset;
    };
    static constexpr std::array<Point, 9> points{{{"head", {0.0, 0.17, 0.0}},
                                                  {"chest", {0.0, 0.20, 0.0}},
                                                  {"pelvis", {0.0, 0.0, 0.0}},
                                                  {"left elbow", {0.0, 0.0, 0.0}},
                                                  {"right elbow", {0.0, 0.0, 0.0}},
                                                  {"left knee", {0.0, 0.0, 0.0}},
                                                  {"right knee", {0.0, 0.0, 0.0}},
                                                  {"left ankle", {0.0, 0.06, 0.0}},
                                                  {"right ankle", {0.0, 0.06, 0.0}}}};
    std::vector<glm::dvec3> places;
    for (const Point& point : points) {
        const scene::Entity joint = player_.joints[skeleton_.joint(point.joint)];
        const glm::dmat4& pose = scene_.registry.get<scene::WorldTransform>(joint).world_from_local;
        places.emplace_back(pose * glm::dvec4(point.offset, 1.0));
    }
    return places;
}

}  // namespace gnomon::game
