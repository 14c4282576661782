// SPDX-License-Identifier: MIT
#include "view/mover.hpp"

#include <gtest/gtest.h>

#include <gnomon/scene/transforms.hpp>

#include <glm/gtc/matrix_transform.hpp>

namespace gnomon::cli {
namespace {

class Moving : public testing::Test {
protected:
    // A node below a parent that is turned, scaled and far away.
    scene::Entity make(const scene::LocalTransform& local) {
        const scene::Entity parent = scene.create_node(
            "parent", {.translation = {5.0, 1.0, -3.0},
                       .rotation = glm::angleAxis(1.1, glm::normalize(glm::dvec3(1, 2, 0.5))),
                       .scale = glm::dvec3(2.5)});
        return scene.create_node("child", local, parent);
    }
    glm::dmat4 world(scene::Entity entity) {
        scene::update_world_transforms(scene.registry);
        return scene.registry.get<scene::WorldTransform>(entity).world_from_local;
    }
    void expect_moved(const scene::LocalTransform& local, const glm::dmat4& motion) {
        const scene::Entity entity = make(local);
        const glm::dmat4 before = world(entity);
        move_node(scene.registry, entity, local, motion);
        const glm::dmat4 after = world(entity);
        const glm::dmat4 expected = motion * before;
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j) EXPECT_NEAR(after[i][j], expected[i][j], 1e-9);
        }
    }
    scene::Scene scene;
};

const scene::LocalTransform parts{.translation = {1.0, 2.0, 3.0},
                                  .rotation = glm::angleAxis(0.7, glm::dvec3(0.0, 0.6, 0.8)),
                                  .scale = {1.0, -2.0, 0.5}};

TEST_F(Moving, makes_the_motion_in_the_world) {
    const glm::dmat4 shift = glm::translate(glm::dmat4(1.0), glm::dvec3(0.5, -2.0, 4.0));
    const glm::dmat4 turn = turned_about({1.0, 1.0, 1.0}, {1.0, 0.0, 0.0}, 0.8, -0.3);
    scene::LocalTransform matrix;
    matrix.matrix = glm::scale(parts.parent_from_local(), glm::dvec3(1.0, 3.0, 1.0));
    for (const scene::LocalTransform& local : {parts, matrix}) {
        expect_moved(local, shift);
        expect_moved(local, turn);
        expect_moved(local, shift * turn);
    }
}

TEST_F(Moving, keeps_parts_apart_for_animations) {
    const scene::Entity entity = make(parts);
    static_cast<void>(world(entity));
    move_node(scene.registry, entity, parts, turned_about({0, 0, 0}, {1, 0, 0}, 1.0, 0.0));
    const auto& local = scene.registry.get<scene::LocalTransform>(entity);
    EXPECT_FALSE(local.matrix);
    EXPECT_EQ(local.scale, parts.scale);
}

TEST_F(Moving, below_a_parent_without_inverse_nothing_moves) {
    const scene::Entity parent = scene.create_node("flat", {.scale = {1.0, 0.0, 1.0}});
    const scene::Entity entity = scene.create_node("child", parts, parent);
    static_cast<void>(world(entity));
    move_node(scene.registry, entity, parts, glm::translate(glm::dmat4(1.0), glm::dvec3(1.0)));
    EXPECT_EQ(scene.registry.get<scene::LocalTransform>(entity).translation, parts.translation);
}

TEST(Dragging, stays_in_its_plane) {
    const panel::Ray ray{{0.0, 5.0, 5.0}, glm::normalize(glm::dvec3(0.3, -1.0, -1.0))};
    const auto way = dragged_in_plane(ray, {1.0, 1.0, 1.0}, {0.0, 1.0, 0.0});
    ASSERT_TRUE(way);
    EXPECT_NEAR(way->y, 0.0, 1e-12);
    EXPECT_NEAR(way->x, 0.2, 1e-12);
    EXPECT_NEAR(way->z, 0.0, 1e-12);
    EXPECT_FALSE(dragged_in_plane({{0, 5, 5}, {0, 0, -1}}, {1, 1, 1}, {0, 1, 0})) << "along it";
    EXPECT_FALSE(dragged_in_plane({{0, 5, 5}, {0, 1, 0}}, {1, 1, 1}, {0, 1, 0})) << "behind";
}

TEST(Dragging, turns_one_direction_into_the_other) {
    const glm::dvec3 pivot(1.0, 2.0, 3.0);
    const glm::dmat4 turn = turned_towards(pivot, {0.0, 3.0, 0.0}, {2.0, 2.0, 0.0});
    const glm::dvec3 moved(turn * glm::dvec4(pivot + glm::dvec3(0.0, 1.0, 0.0), 1.0));
    EXPECT_NEAR(glm::distance(moved, pivot + glm::normalize(glm::dvec3(1.0, 1.0, 0.0))), 0.0,
                1e-12);
    EXPECT_EQ(turned_towards(pivot, {0, 1, 0}, {0, 2, 0}), glm::dmat4(1.0));
}

}  // namespace
}  // namespace gnomon::cli
