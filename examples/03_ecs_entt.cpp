// SPDX-License-Identifier: MIT
//
// Shadows of an EnTT registry: two loops a frame, and nothing to keep in step. Poses are written as
// they are everywhere in a program, through references: no signal of EnTT's sees that, and none is
// needed, because the shadow system compares values (docs/ecs.md). Built where EnTT is found.
#include <entt/entt.hpp>

#include "03_ecs_ships.hpp"

using namespace ships;

/// All there is to it. An entity's number holds its version as well, so that one that takes the
/// place of another is a caster of its own.
void submit(const entt::registry& registry, shadows::ShadowSystem::Frame& frame) {
    for (auto [entity, pose, shape] : registry.view<const Pose, const Shape>().each())
        frame.caster({.key = entt::to_integral(entity),
                      .mesh = shape.mesh,
                      .world_from_local = pose.world_from_local});
    for (auto [entity, pose, lamp] : registry.view<const Pose, const Lamp>().each())
        frame.light({.key = entt::to_integral(entity),
                     .position_world = pose.world_from_local[3],
                     .range_m = lamp.range_m});
}

int main() {
    entt::registry registry;
    const Shape hull = make_hull();
    std::array<entt::entity, 3> ship{};
    for (std::size_t i = 0; i < ship.size(); ++i) {
        ship[i] = registry.create();
        registry.emplace<Pose>(ship[i], at(4.0 * static_cast<double>(i), 2.0, 0.0));
        registry.emplace<Shape>(ship[i], hull);
    }
    const entt::entity lamp = registry.create();
    registry.emplace<Pose>(lamp, at(4.0, 9.0, 3.0));
    registry.emplace<Lamp>(lamp);

    shadows::ShadowSystem system = make_system();
    const auto frame = [&](const char* what, double eye) {
        auto submission = system.begin_frame();
        submit(registry, submission);
        say(what, std::move(submission).finish(seen_from(eye)));
    };
    frame("first frame", 0.0);
    frame("the camera moves", 5.0);
    glm::dmat4& pose = registry.get<Pose>(ship[1]).world_from_local;
    pose = glm::rotate(pose, 0.9, glm::dvec3(0.0, 0.0, 1.0));
    frame("a ship rolls", 5.0);
    registry.get<Pose>(lamp) = at(-6.0, 9.0, 3.0);
    frame("the lamp is carried away", 5.0);
    registry.destroy(ship[2]);
    frame("a ship is gone", 5.0);
    return 0;
}
