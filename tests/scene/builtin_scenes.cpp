// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <cmath>

#include <gnomon/scene/deform.hpp>
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
                                                     "open-shapes", "walk"));
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

std::vector<glm::dvec3> world_positions(const Scene& scene, Entity entity) {
    const auto& instance = scene.registry.get<MeshInstance>(entity);
    const auto& world = scene.registry.get<WorldTransform>(entity);
    const Geometry geometry = geometry_of(scene.registry, entity, instance, world);
    std::vector<glm::dvec3> positions;
    for (const glm::vec3& p : geometry.positions) {
        positions.emplace_back(geometry.world_from_positions * glm::dvec4(p, 1.0));
    }
    return positions;
}

TEST(BuiltinScenes, walkers_stand_on_the_ground_and_do_not_slide) {
    auto scene = make_builtin_scene("walk");
    ASSERT_TRUE(scene);
    std::vector<Entity> walkers;
    scene->registry.each<Skin>([&](Entity entity, const Skin&) { walkers.push_back(entity); });
    ASSERT_EQ(walkers.size(), 5U);
    ASSERT_EQ(scene->animations.size(), 1U);

    const auto pose_at = [&](double time_s) {
        ASSERT_TRUE(animate(*scene, 0, time_s));
        update_world_transforms(scene->registry);
        ASSERT_TRUE(deform(*scene));
    };
    // As it is made it stands as at time 0.
    const Bounds made = world_bounds(*scene);
    pose_at(0.0);
    const Bounds posed = world_bounds(*scene);
    EXPECT_LT(glm::distance(made.min, posed.min) + glm::distance(made.max, posed.max), 1e-5);

    const double duration_s = scene->animations[0].duration_s;
    for (int step = 0; step < 60; ++step) {
        SCOPED_TRACE(step);
        pose_at(duration_s * step / 60);
        std::vector<std::vector<glm::dvec3>> before;
        for (const Entity walker : walkers) before.push_back(world_positions(*scene, walker));
        // A hundredth of a second later the hips are a centimetre further.
        pose_at(duration_s * step / 60 + 0.01);
        for (std::size_t i = 0; i < walkers.size(); ++i) {
            const auto after = world_positions(*scene, walkers[i]);
            double lowest = 1.0;
            double least_moved = 1.0;
            for (std::size_t v = 0; v < after.size(); ++v) {
                lowest = std::min(lowest, before[i][v].y);
                if (std::max(before[i][v].y, after[v].y) > 0.008) continue;
                least_moved = std::min(least_moved, glm::distance(before[i][v], after[v]));
            }
            EXPECT_GT(lowest, -0.006) << "walker " << i << " is in the ground";
            EXPECT_LT(least_moved, 0.002) << "walker " << i << " slides, or is in the air";
        }
    }
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
