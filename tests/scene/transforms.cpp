// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <gnomon/scene/transforms.hpp>

namespace gnomon::scene {
namespace {

LocalTransform moved(double x, double y, double z) {
    LocalTransform local;
    local.translation = {x, y, z};
    return local;
}

glm::dvec3 world_point(const Scene& scene, Entity entity, const glm::dvec3& local) {
    return glm::dvec3(scene.registry.get<WorldTransform>(entity).world_from_local *
                      glm::dvec4(local, 1.0));
}

TEST(Transforms, local_is_translation_rotation_scale_or_a_matrix) {
    LocalTransform local;
    local.translation = {1.0, 2.0, 3.0};
    local.rotation = glm::angleAxis(glm::radians(90.0), glm::dvec3(0.0, 0.0, 1.0));
    local.scale = {2.0, 3.0, -4.0};
    const glm::dvec3 p(local.parent_from_local() * glm::dvec4(1.0, 1.0, 1.0, 1.0));
    EXPECT_NEAR(p.x, 1.0 - 3.0, 1e-12);
    EXPECT_NEAR(p.y, 2.0 + 2.0, 1e-12);
    EXPECT_NEAR(p.z, 3.0 - 4.0, 1e-12);
    local.matrix = glm::dmat4(5.0);
    EXPECT_EQ(local.parent_from_local(), glm::dmat4(5.0));
}

TEST(Transforms, children_made_before_their_parents_come_out_right) {
    Scene scene;
    const Entity child = scene.create_node("child", moved(1.0, 0.0, 0.0));
    const Entity parent = scene.create_node("parent", moved(0.0, 10.0, 0.0));
    const Entity grandparent = scene.create_node("grandparent", moved(0.0, 0.0, 100.0));
    scene.registry.emplace<Parent>(child, parent);
    scene.registry.emplace<Parent>(parent, grandparent);
    update_world_transforms(scene.registry);
    EXPECT_EQ(world_point(scene, child, {0.0, 0.0, 0.0}), glm::dvec3(1.0, 10.0, 100.0));

    scene.registry.get<LocalTransform>(grandparent).translation.z = 200.0;
    update_world_transforms(scene.registry);
    EXPECT_EQ(world_point(scene, child, {0.0, 0.0, 0.0}), glm::dvec3(1.0, 10.0, 200.0));
}

TEST(Transforms, create_node_knows_its_world_transform_at_once) {
    Scene scene;
    const Entity parent = scene.create_node("parent", moved(1.0, 2.0, 3.0));
    const Entity child = scene.create_node("child", moved(10.0, 0.0, 0.0), parent);
    EXPECT_EQ(world_point(scene, child, {0.0, 0.0, 0.0}), glm::dvec3(11.0, 2.0, 3.0));
    EXPECT_EQ(scene.registry.get<Name>(child).value, "child");
    EXPECT_EQ(scene.registry.get<Parent>(child).value, parent);
}

TEST(Transforms, a_chain_of_a_hundred_thousand_nodes_needs_no_stack) {
    constexpr int depth = 100'000;
    for (const bool leaf_first : {false, true}) {
        Registry registry;
        std::vector<Entity> nodes;
        for (int i = 0; i < depth; ++i) {
            nodes.push_back(registry.create());
            registry.emplace<LocalTransform>(nodes.back(), glm::dvec3(1.0, 0.0, 0.0));
        }
        for (int i = 1; i < depth; ++i) {
            const auto a = static_cast<std::size_t>(leaf_first ? i - 1 : i);
            const auto b = static_cast<std::size_t>(leaf_first ? i : i - 1);
            registry.emplace<Parent>(nodes[a], nodes[b]);
        }
        update_world_transforms(registry);
        const Entity leaf = leaf_first ? nodes.front() : nodes.back();
        EXPECT_EQ(registry.get<WorldTransform>(leaf).world_from_local[3].x, depth);
    }
}

TEST(Transforms, mirrors_and_zero_scales_pass_through) {
    Scene scene;
    LocalTransform mirror;
    mirror.scale = {-1.0, 1.0, 1.0};
    LocalTransform flat;
    flat.scale = {1.0, 0.0, 1.0};
    const Entity parent = scene.create_node("mirror", mirror);
    const Entity child = scene.create_node("child", moved(2.0, 3.0, 4.0), parent);
    const Entity squashed = scene.create_node("squashed", flat, child);
    update_world_transforms(scene.registry);
    EXPECT_EQ(world_point(scene, child, {1.0, 0.0, 0.0}), glm::dvec3(-3.0, 3.0, 4.0));
    EXPECT_EQ(world_point(scene, squashed, {1.0, 5.0, 1.0}), glm::dvec3(-3.0, 3.0, 5.0));
    const auto& world = scene.registry.get<WorldTransform>(child).world_from_local;
    EXPECT_LT(glm::determinant(glm::dmat3(world)), 0.0);
}

TEST(Transforms, a_parent_that_is_gone_counts_as_the_world) {
    Scene scene;
    const Entity parent = scene.create_node("parent", moved(5.0, 0.0, 0.0));
    const Entity child = scene.create_node("child", moved(1.0, 0.0, 0.0), parent);
    scene.registry.destroy(parent);
    update_world_transforms(scene.registry);
    EXPECT_EQ(world_point(scene, child, {0.0, 0.0, 0.0}), glm::dvec3(1.0, 0.0, 0.0));
}

TEST(Scene, world_bounds_are_exact_and_use_the_meshes_origin) {
    Scene scene;
    auto mesh = std::make_shared<Mesh>();
    mesh->origin = {1'000'000.0, 0.0, 0.0};
    mesh->positions = {{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
    LocalTransform local = moved(-1'000'000.0, 0.0, 0.0);
    local.scale = {1.0, 2.0, 1.0};
    const Entity entity = scene.create_node("far", local);
    scene.registry.emplace<MeshInstance>(entity, mesh);
    const Bounds bounds = world_bounds(scene);
    EXPECT_EQ(bounds.min, glm::dvec3(0.0));
    EXPECT_EQ(bounds.max, glm::dvec3(1.0, 2.0, 0.0));
    const Geometry geometry =
        geometry_of(scene.registry, entity, scene.registry.get<MeshInstance>(entity),
                    scene.registry.get<WorldTransform>(entity));
    EXPECT_EQ(geometry.positions.data(), mesh->positions.data());
    EXPECT_EQ(geometry.revision, 0U);
    EXPECT_EQ(geometry.world_from_positions[3], glm::dvec4(0.0, 0.0, 0.0, 1.0));
    EXPECT_TRUE(world_bounds(Scene{}).empty());
    EXPECT_EQ(world_bounds(Scene{}).diagonal(), 0.0);
}

}  // namespace
}  // namespace gnomon::scene
