// SPDX-License-Identifier: MIT
//
// Shadows of a world that somebody wrote by hand: a struct of arrays, one row a thing, rows closed
// up when one goes. Two ways to submit it. All of it, every frame: that is the one to begin with,
// and for most worlds the one to stay with. Or what was marked alone, for a world so large that
// comparing it shows; then a mark that is forgotten is a shadow that stays behind (docs/ecs.md).
#include <utility>
#include <vector>

#include "03_ecs_ships.hpp"

using namespace ships;

/// Rows move when others go; so a row's number is no key, and each row keeps its own.
struct World {
    std::vector<std::uint64_t> key;
    std::vector<Pose> pose;
    std::vector<Shape> shape;
    std::vector<char> marked;  // since the last frame
    std::vector<std::uint64_t> gone;
    Pose lamp;

    void add(std::uint64_t its_key, const Pose& its_pose, const Shape& its_shape) {
        key.push_back(its_key);
        pose.push_back(its_pose);
        shape.push_back(its_shape);
        marked.push_back(1);
    }
    void remove(std::size_t row) {
        gone.push_back(key[row]);
        const auto close_up = [row](auto& column) {
            std::swap(column[row], column.back());
            column.pop_back();
        };
        close_up(key);
        close_up(pose);
        close_up(shape);
        close_up(marked);
    }
};

/// Everything: what is not submitted is gone, what is equal costs a comparison.
void submit_all(const World& world, shadows::ShadowSystem::Frame& frame) {
    for (std::size_t row = 0; row < world.key.size(); ++row)
        frame.caster({.key = world.key[row],
                      .mesh = world.shape[row].mesh,
                      .world_from_local = world.pose[row].world_from_local});
    frame.light(
        {.key = 1, .position_world = world.lamp.world_from_local[3], .range_m = Lamp{}.range_m});
}

/// What was marked. A mark is a hint: one too many costs a comparison; the system still decides by
/// the values.
void submit_marked(World& world, shadows::ShadowSystem::Frame& frame) {
    // Before the casters: said after them, it would take away what came back under its key.
    for (const std::uint64_t key : world.gone) frame.remove_caster(key);
    world.gone.clear();
    for (std::size_t row = 0; row < world.key.size(); ++row) {
        if (world.marked[row] == 0) continue;
        world.marked[row] = 0;
        frame.caster({.key = world.key[row],
                      .mesh = world.shape[row].mesh,
                      .world_from_local = world.pose[row].world_from_local});
    }
    frame.light(
        {.key = 1, .position_world = world.lamp.world_from_local[3], .range_m = Lamp{}.range_m});
}

int main() {
    const Shape hull = make_hull();
    for (const bool everything : {true, false}) {
        World world;
        for (std::uint64_t i = 0; i < 3; ++i)
            world.add(100 + i, at(4.0 * static_cast<double>(i), 2.0, 0.0), hull);
        world.lamp = at(4.0, 9.0, 3.0);

        shadows::ShadowSystem system = make_system();
        const auto frame = [&](const char* what, double eye) {
            auto submission = system.begin_frame(everything ? shadows::Submission::Full
                                                            : shadows::Submission::Delta);
            everything ? submit_all(world, submission) : submit_marked(world, submission);
            say(what, std::move(submission).finish(seen_from(eye)));
        };
        std::printf(everything ? "all of it, every frame\n" : "what was marked\n");
        frame("first frame", 0.0);
        frame("the camera moves", 5.0);
        glm::dmat4& pose = world.pose[1].world_from_local;
        pose = glm::rotate(pose, 0.9, glm::dvec3(0.0, 0.0, 1.0));
        world.marked[1] = 1;
        world.marked[0] = 1;  // for nothing: it is where it was
        frame("a ship rolls", 5.0);
        world.lamp = at(-6.0, 9.0, 3.0);
        frame("the lamp is carried away", 5.0);
        world.remove(2);
        frame("a ship is gone", 5.0);
        const Pose place = world.pose[0];
        world.remove(0);
        world.add(100, place, hull);
        frame("a ship goes and comes back under its key", 5.0);
    }
    return 0;
}
