// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <gnomon/scene/scene_description.hpp>
#include <gnomon/scene/transforms.hpp>

namespace gnomon::scene {
namespace {

using testing::HasSubstr;

std::size_t light_count(const Scene& scene) {
    return scene.registry.count<PointLight>() + scene.registry.count<SpotLight>() +
           scene.registry.count<DirectionalLight>();
}

TEST(BuiltinScenes, each_is_complete) {
    const std::vector<std::string> names = builtin_scene_names();
    EXPECT_THAT(names, testing::UnorderedElementsAre("pillars", "knot", "room", "still-life",
                                                     "open-shapes"));
    for (const std::string& name : names) {
        SCOPED_TRACE(name);
        auto scene = load_scene("builtin:" + name);
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_EQ(scene->registry.count<Camera>(), 1U);
        EXPECT_GE(light_count(*scene), 1U);
        EXPECT_GE(scene->registry.count<Caster>(), 1U);
        EXPECT_GE(scene->registry.count<Receiver>(), 2U);
        EXPECT_TRUE(scene->messages.empty());
        scene->registry.each<MeshInstance>([&](Entity, const MeshInstance& instance) {
            EXPECT_GT(instance.mesh->triangle_count(), 0U);
            for (const SubMesh& sub_mesh : instance.mesh->sub_meshes) {
                EXPECT_GT(sub_mesh.material, 0U);
                EXPECT_LT(sub_mesh.material, scene->materials.size());
            }
        });
        // World transforms are up to date.
        std::vector<glm::dmat4> before;
        scene->registry.each<WorldTransform>(
            [&](Entity, WorldTransform& world) { before.push_back(world.world_from_local); });
        update_world_transforms(scene->registry);
        std::size_t next = 0;
        scene->registry.each<WorldTransform>([&](Entity, WorldTransform& world) {
            EXPECT_EQ(world.world_from_local, before[next++]);
        });
    }
}

TEST(BuiltinScenes, they_hold_what_their_names_say) {
    EXPECT_EQ(light_count(*make_builtin_scene("pillars")), 2U);
    EXPECT_EQ(make_builtin_scene("still-life")->registry.count<PointLight>(), 3U);

    // The room's light is within its walls, and these face inwards.
    const auto room = make_builtin_scene("room");
    ASSERT_TRUE(room);
    room->registry.each<MeshInstance, Name>(
        [](Entity, const MeshInstance& instance, const Name& name) {
            if (name.value != "walls") return;
            for (std::size_t i = 0; i < instance.mesh->positions.size(); ++i) {
                EXPECT_LT(glm::dot(instance.mesh->positions[i], instance.mesh->normals[i]), 0.0F);
            }
        });
    const Bounds bounds = world_bounds(*room);
    room->registry.each<PointLight, WorldTransform>(
        [&](Entity, const PointLight&, const WorldTransform& world) {
            const glm::dvec3 at(world.world_from_local[3]);
            EXPECT_TRUE(glm::all(glm::greaterThan(at, bounds.min)));
            EXPECT_TRUE(glm::all(glm::lessThan(at, bounds.max)));
        });

    bool any_mirrored = false;
    const auto open = make_builtin_scene("open-shapes");
    ASSERT_TRUE(open);
    open->registry.each<MeshInstance, WorldTransform>(
        [&](Entity, const MeshInstance&, const WorldTransform& world) {
            if (glm::determinant(glm::dmat3(world.world_from_local)) < 0.0) any_mirrored = true;
        });
    EXPECT_TRUE(any_mirrored);
}

TEST(BuiltinScenes, an_unknown_name_lists_the_known_ones) {
    const auto scene = load_scene("builtin:teapot");
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().code, ErrorCode::InvalidInput);
    EXPECT_THAT(scene.error().message, HasSubstr("\"teapot\""));
    EXPECT_THAT(scene.error().message, HasSubstr("still-life"));
}

TEST(LoadScene, other_endings_are_refused) {
    const auto scene = load_scene("model.obj");
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().code, ErrorCode::InvalidInput);
    EXPECT_THAT(scene.error().message, HasSubstr(".scene.json"));
}

}  // namespace
}  // namespace gnomon::scene
