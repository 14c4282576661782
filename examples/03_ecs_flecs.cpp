// SPDX-License-Identifier: MIT
//
// Shadows of a flecs world: two queries, made once, and run each frame. Hooks and observers of
// flecs's see a set(), not a system that writes through a reference; so nothing here listens, and
// the shadow system compares values (docs/ecs.md). Built where flecs is found.
#include <flecs.h>

#include "03_ecs_ships.hpp"

using namespace ships;

/// All there is to it. An id of flecs's holds the generation as well, so that one that is used
/// again is a caster of its own.
struct ShadowQueriesOfWorld {
    flecs::query<const Pose, const Shape> casters;
    flecs::query<const Pose, const Lamp> lamps;

    void submit(shadows::ShadowSystem::Frame& frame) {
        casters.each([&](flecs::entity entity, const Pose& pose, const Shape& shape) {
            frame.caster({.key = entity.id(),
                          .mesh = shape.mesh,
                          .world_from_local = pose.world_from_local});
        });
        lamps.each([&](flecs::entity entity, const Pose& pose, const Lamp& lamp) {
            frame.light({.key = entity.id(),
                         .position_world = pose.world_from_local[3],
                         .range_m = lamp.range_m});
        });
    }
};

int main() {
    flecs::world world;
    const Shape hull = make_hull();
    std::array<flecs::entity, 3> ship;
    for (std::size_t i = 0; i < ship.size(); ++i)
        ship[i] =
            world.entity().set<Pose>(at(4.0 * static_cast<double>(i), 2.0, 0.0)).set<Shape>(hull);
    flecs::entity lamp = world.entity().set<Pose>(at(4.0, 9.0, 3.0)).set<Lamp>({});

    ShadowQueriesOfWorld queries{world.query<const Pose, const Shape>(),
                                 world.query<const Pose, const Lamp>()};
    auto poses = world.query<Pose, const Shape>();
    shadows::ShadowSystem system = make_system();
    const auto frame = [&](const char* what, double eye) {
        auto submission = system.begin_frame();
        queries.submit(submission);
        say(what, std::move(submission).finish(seen_from(eye)));
    };
    frame("first frame", 0.0);
    frame("the camera moves", 5.0);
    poses.each([&](flecs::entity entity, Pose& pose, const Shape&) {
        if (entity.id() != ship[1].id()) return;
        pose.world_from_local = glm::rotate(pose.world_from_local, 0.9, glm::dvec3(0.0, 0.0, 1.0));
    });
    frame("a ship rolls", 5.0);
    lamp.set<Pose>(at(-6.0, 9.0, 3.0));
    frame("the lamp is carried away", 5.0);
    ship[2].destruct();
    frame("a ship is gone", 5.0);
    return 0;
}
