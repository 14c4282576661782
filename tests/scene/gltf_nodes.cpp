// SPDX-License-Identifier: MIT
//
// What becomes of nodes, scenes, lights, cameras, instances and skins.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "tests/scene/gltf_builder.hpp"

namespace gnomon::scene::test {
namespace {

using testing::HasSubstr;

glm::dvec3 world_point(const Scene& scene, const std::string& name, const glm::dvec3& local) {
    const Entity entity = find_entity(scene, name);
    return glm::dvec3(scene.registry.get<WorldTransform>(entity).world_from_local *
                      glm::dvec4(local, 1.0));
}

void expect_near(const glm::dvec3& actual, const glm::dvec3& expected, double tolerance = 1e-12) {
    EXPECT_LT(glm::length(actual - expected), tolerance)
        << actual.x << ", " << actual.y << ", " << actual.z;
}

TEST(GltfNodes, translation_rotation_scale_and_matrix) {
    GltfBuilder file = triangle_file();
    const double half = std::sqrt(0.5);
    const std::size_t child =
        file.node({{"name", "child"},
                   {"mesh", 0},
                   {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.5, 0.25, 0.125, 1}}});
    file.root({{"name", "parent"},
               {"translation", {10, 20, 30}},
               {"rotation", {0, 0, 2 * half, 2 * half}},  // a quarter turn, not of length 1
               {"scale", {2, 3, -4}},
               {"children", {child}}});
    const auto scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    expect_near(world_point(*scene, "parent", {1, 1, 1}), {10 - 3, 20 + 2, 30 - 4});
    expect_near(world_point(*scene, "child", {0, 0, 0}), {10 - 0.75, 20 + 1, 30 - 0.5});
    EXPECT_EQ(scene->registry.get<Parent>(find_entity(*scene, "child")).value,
              find_entity(*scene, "parent"));
    EXPECT_EQ(scene->registry.get<LocalTransform>(find_entity(*scene, "parent")).scale,
              glm::dvec3(2, 3, -4));
}

TEST(GltfNodes, zero_scale_is_legal) {
    GltfBuilder file = triangle_file();
    file.json["nodes"][0]["scale"] = {1, 0, 1};
    const auto scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    expect_near(world_point(*scene, "triangle", {3, 4, 5}), {3, 0, 5});
}

TEST(GltfNodes, names_come_from_the_node_then_the_mesh_then_the_number) {
    GltfBuilder file = triangle_file();
    file.json["meshes"][0]["name"] = "the mesh";
    file.root({{"mesh", 0}});
    file.root(Json::object());
    const auto scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    for (const char* name : {"triangle", "the mesh", "node 2"}) {
        EXPECT_TRUE(scene->registry.valid(find_entity(*scene, name)));
    }
}

TEST(GltfNodes, scenes_are_chosen_by_option_then_by_the_file) {
    GltfBuilder file = triangle_file();
    const std::size_t other = file.node({{"name", "other"}});
    file.json["scenes"].push_back({{"nodes", {other}}});
    const auto names = [&](int option) {
        std::vector<std::string> found;
        const auto scene = file.load({option});
        EXPECT_TRUE(scene) << scene.error().message;
        if (!scene) return found;
        scene->registry.each<Name>([&](Entity, const Name& name) { found.push_back(name.value); });
        return found;
    };
    EXPECT_THAT(names(-1), testing::ElementsAre("triangle"));
    EXPECT_THAT(names(0), testing::ElementsAre("triangle"));
    EXPECT_THAT(names(1), testing::ElementsAre("other"));
    file.json["scene"] = 1;
    EXPECT_THAT(names(-1), testing::ElementsAre("other"));
    file.json.erase("scene");
    EXPECT_THAT(names(-1), testing::ElementsAre("triangle"));
    const auto missing = file.load({2});
    ASSERT_FALSE(missing);
    EXPECT_THAT(missing.error().message, HasSubstr("scene 2"));
    file.json.erase("scenes");
    EXPECT_THAT(names(-1), testing::ElementsAre("triangle", "other"));
}

TEST(GltfNodes, a_chain_of_ten_thousand_nodes) {
    GltfBuilder file = triangle_file();
    constexpr std::size_t depth = 10'000;
    file.json["nodes"] = Json::array();
    for (std::size_t i = 0; i < depth; ++i) {
        Json node{{"translation", {0, 1, 0}}};
        if (i + 1 < depth) node["children"] = {i + 1};
        if (i + 1 == depth) node["name"] = "leaf";
        file.node(node);
    }
    const auto scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    expect_near(world_point(*scene, "leaf", {0, 0, 0}), {0, 10'000, 0});
}

TEST(GltfNodes, instances_are_children_of_the_node) {
    GltfBuilder file = triangle_file();
    const std::size_t translation = file.positions({{1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
    const std::size_t scale = file.positions({{1, 1, 1}, {2, 2, 2}, {-1, 1, 1}});
    const std::vector<std::int16_t> quarter_turns{0, 0,     0, 32767, 0,     0,
                                                  0, 32767, 0, 0,     23170, 23170};
    const std::size_t rotation = file.accessor_of(quarter_turns, i16, "VEC4", 4);
    file.json["accessors"][rotation]["normalized"] = true;
    file.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    file.json["nodes"][0]["translation"] = {0, 100, 0};
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", translation}, {"ROTATION", rotation}, {"SCALE", scale}, {"_ID", 0}};
    const auto scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->registry.count<MeshInstance>(), 3U);
    EXPECT_FALSE(scene->registry.has<MeshInstance>(find_entity(*scene, "triangle")));
    expect_near(world_point(*scene, "triangle instance 0", {1, 0, 0}), {2, 100, 0});
    expect_near(world_point(*scene, "triangle instance 1", {1, 0, 0}), {4, 100, 0});
    expect_near(world_point(*scene, "triangle instance 2", {1, 0, 0}), {3, 99, 0}, 1e-9);
    EXPECT_EQ(scene->registry.get<Parent>(find_entity(*scene, "triangle instance 2")).value,
              find_entity(*scene, "triangle"));
}

TEST(GltfNodes, lights) {
    GltfBuilder file;
    file.json["extensionsUsed"] = {"KHR_lights_punctual"};
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"color", {1, 0.5, 0.25}}, {"intensity", 40}, {"range", 12}},
        {{"type", "spot"},
         {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}},
         {"intensity", 3}},
        {{"type", "directional"}, {"intensity", 2.5}},
        {{"type", "spot"}, {"spot", Json::object()}}};
    for (int i = 0; i < 4; ++i) {
        file.root({{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}},
                   {"translation", {i, 0, 0}}});
    }
    const auto scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    const auto& point = scene->registry.get<PointLight>(find_entity(*scene, "node 0"));
    EXPECT_EQ(point.color, glm::vec3(1.0F, 0.5F, 0.25F));
    EXPECT_EQ(point.intensity, 40.0F);
    EXPECT_EQ(point.range_m, 12.0);
    const auto& spot = scene->registry.get<SpotLight>(find_entity(*scene, "node 1"));
    EXPECT_EQ(spot.color, glm::vec3(1.0F));
    EXPECT_EQ(spot.intensity, 3.0F);
    EXPECT_EQ(spot.range_m, std::nullopt);
    EXPECT_EQ(spot.inner_cone_rad, 0.25F);
    EXPECT_EQ(spot.outer_cone_rad, 0.5F);
    const auto& sun = scene->registry.get<DirectionalLight>(find_entity(*scene, "node 2"));
    EXPECT_EQ(sun.intensity, 2.5F);
    const auto& plain = scene->registry.get<SpotLight>(find_entity(*scene, "node 3"));
    EXPECT_EQ(plain.inner_cone_rad, 0.0F);
    EXPECT_NEAR(plain.outer_cone_rad, std::numbers::pi / 4, 1e-6);
    EXPECT_EQ(plain.intensity, 1.0F);
}

TEST(GltfNodes, cameras) {
    GltfBuilder file;
    file.json["cameras"] = {
        {{"type", "perspective"},
         {"perspective", {{"yfov", 0.75}, {"znear", 0.125}, {"zfar", 100}, {"aspectRatio", 1.5}}}},
        {{"type", "orthographic"},
         {"orthographic", {{"xmag", 3}, {"ymag", -2}, {"znear", 0.5}, {"zfar", 50}}}}};
    file.root({{"camera", 0}});
    file.root({{"camera", 1}});
    const auto scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    const auto& first = scene->registry.get<Camera>(find_entity(*scene, "node 0"));
    const auto& perspective = std::get<PerspectiveCamera>(first.projection);
    EXPECT_EQ(perspective.fovy_rad, 0.75);
    EXPECT_EQ(perspective.near_m, 0.125);
    const auto& second = scene->registry.get<Camera>(find_entity(*scene, "node 1"));
    const auto& orthographic = std::get<OrthographicCamera>(second.projection);
    EXPECT_EQ(orthographic.half_width_m, 3.0);
    EXPECT_EQ(orthographic.half_height_m, 2.0);
    EXPECT_EQ(orthographic.near_m, 0.5);
    EXPECT_EQ(orthographic.far_m, 50.0);
}

/// A triangle whose first vertex follows joint 0, the second joint 1, the third both alike.
GltfBuilder skinned_file() {
    GltfBuilder file;
    const std::size_t position = file.positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const std::vector<std::uint8_t> joints{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0};
    const std::vector<float> weights{1, 0, 0, 0, 1, 0, 0, 0, 0.5F, 0.5F, 0, 0};
    file.mesh({{"attributes",
                {{"POSITION", position},
                 {"JOINTS_0", file.accessor_of(joints, u8, "VEC4", 4)},
                 {"WEIGHTS_0", file.accessor_of(weights, f32, "VEC4", 4)}}}});
    std::vector<float> bind(32, 0.0F);
    for (const std::size_t matrix : {0U, 16U}) {
        for (const std::size_t k : {0U, 5U, 10U, 15U}) bind[matrix + k] = 1.0F;
    }
    bind[16 + 12] = -1.0F;  // joint 1 was bound at (1, 0, 0)
    const std::size_t matrices = file.accessor_of(bind, f32, "MAT4", 16);
    const std::size_t joint_1 = file.node({{"name", "joint 1"}, {"translation", {0, 0, 4}}});
    const std::size_t joint_0 =
        file.root({{"name", "joint 0"}, {"translation", {10, 0, 0}}, {"children", {joint_1}}});
    file.json["skins"] = {{{"joints", {joint_0, joint_1}}, {"inverseBindMatrices", matrices}}};
    // The node's own transform does not count for a skinned mesh.
    file.root({{"name", "skinned"}, {"mesh", 0}, {"skin", 0}, {"translation", {0, 500, 0}}});
    return file;
}

TEST(GltfNodes, skins_are_in_their_rest_pose) {
    const auto scene = skinned_file().load();
    ASSERT_TRUE(scene) << scene.error().message;
    const auto mesh = only_mesh(*scene);
    ASSERT_EQ(mesh->positions.size(), 3U);
    EXPECT_EQ(mesh->positions[1], glm::vec3(1, 0, 0));  // as it was bound
    std::size_t skinned = 0;
    scene->registry.each<Deformed>([&](Entity entity, const Deformed& deformed) {
        ++skinned;
        ASSERT_EQ(deformed.positions.size(), 3U);
        const auto true_position = [&](std::size_t i) {
            return deformed.origin + glm::dvec3(deformed.positions[i]);
        };
        expect_near(true_position(0), {10, 0, 0});
        expect_near(true_position(1), {10, 0, 4});
        expect_near(true_position(2), {10 - 0.5, 1, 2});
        EXPECT_FALSE(scene->registry.has<Parent>(entity));
    });
    EXPECT_EQ(skinned, 1U);
    EXPECT_TRUE(scene->messages.empty());
    Bounds bounds = world_bounds(*scene);
    EXPECT_LT(bounds.max.y, 2.0);
}

TEST(GltfNodes, a_joint_that_is_not_there_is_refused) {
    GltfBuilder file = skinned_file();
    file.json["skins"][0]["joints"] = {0};
    auto scene = file.load();
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene.error().message, HasSubstr("uses joint 1, but the skin has only 1"));

    file = skinned_file();
    const std::size_t elsewhere = file.node(Json::object());
    file.json["skins"][0]["joints"] = {0, elsewhere};
    scene = file.load();
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene.error().message, HasSubstr("skins[0].joints[1]"));
}

}  // namespace
}  // namespace gnomon::scene::test
