// SPDX-License-Identifier: MIT
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include <gmock/gmock.h>

#include <gnomon/scene/scene_description.hpp>

#include "tests/scene/gltf_builder.hpp"
#include "tests/support/paths.hpp"

namespace gnomon::scene::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class SceneDescription : public testing::Test {
protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = gnomon::test::output_folder() / "scene" / info->name();
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        // A file whose lowest vertex is at -0.25, with a material and a child.
        GltfBuilder model;
        const std::size_t position = model.positions({{0, -0.25F, 0}, {1, 0, 0}, {0, 1, 0}});
        model.mesh({{"attributes", {{"POSITION", position}}}, {"material", 0}});
        model.json["materials"] = {{{"name", "engine paint"}}};
        const std::size_t child = model.node({{"name", "part"}, {"mesh", 0}});
        model.root({{"name", "whole"}, {"children", {child}}});
        const Bytes glb = model.glb();
        std::ofstream(folder_ / "engine.glb", std::ios::binary)
            .write(reinterpret_cast<const char*>(glb.data()),
                   static_cast<std::streamsize>(glb.size()));
    }

    Result<Scene> load(const std::string& text) const {
        std::ofstream(folder_ / "test.scene.json") << text;
        return load_scene((folder_ / "test.scene.json").string());
    }

    fs::path folder_;
};

glm::dvec3 world_point(const Scene& scene, Entity entity, const glm::dvec3& local) {
    return glm::dvec3(scene.registry.get<WorldTransform>(entity).world_from_local *
                      glm::dvec4(local, 1.0));
}

std::string example_of_the_docs() {
    std::ifstream stream(gnomon::test::source_folder() / "docs" / "scene-description.md");
    std::stringstream text;
    text << stream.rdbuf();
    const std::string page = text.str();
    const std::size_t begin = page.find("```json\n") + 8;
    return page.substr(begin, page.find("```", begin) - begin);
}

TEST_F(SceneDescription, the_example_of_the_docs_loads) {
    const auto scene = load(example_of_the_docs());
    ASSERT_TRUE(scene) << scene.error().message;
    // Two models of one mesh each, six primitives.
    EXPECT_EQ(scene->registry.count<MeshInstance>(), 2U + 6U);
    EXPECT_EQ(scene->registry.count<Caster>(), 8U - 2U);
    EXPECT_EQ(scene->registry.count<Receiver>(), 8U - 1U);

    const auto& camera = scene->registry.get<Camera>(find_entity(*scene, "camera"));
    EXPECT_NEAR(std::get<PerspectiveCamera>(camera.projection).fovy_rad,
                40.0 * std::numbers::pi / 180.0, 1e-12);
    const auto& sun = scene->registry.get<DirectionalLight>(find_entity(*scene, "sun"));
    EXPECT_EQ(sun.intensity, 2.5F);
    const auto& lamp = scene->registry.get<PointLight>(find_entity(*scene, "lamp"));
    EXPECT_EQ(lamp.range_m, 50.0);
    const auto& spot = scene->registry.get<SpotLight>(find_entity(*scene, "spot"));
    EXPECT_NEAR(spot.outer_cone_rad, 30.0 * std::numbers::pi / 180.0, 1e-6);

    const auto& ground = scene->registry.get<MeshInstance>(find_entity(*scene, "ground")).mesh;
    EXPECT_EQ(ground->triangle_count(), 32U);
    const Material& sand = scene->materials[ground->sub_meshes[0].material];
    EXPECT_EQ(sand.name, "sand");
    EXPECT_EQ(sand.base_color, glm::vec4(0.6F, 0.54F, 0.45F, 1.0F));

    // Its lowest vertex is on the ground.
    Bounds bounds;
    const Entity box = find_entity(*scene, "box");
    for (const glm::vec3& p : scene->registry.get<MeshInstance>(box).mesh->positions) {
        bounds.include(world_point(*scene, box, p));
    }
    EXPECT_EQ(bounds.min, glm::dvec3(-2.5, 0.0, -0.5));
    EXPECT_EQ(bounds.max, glm::dvec3(-1.5, 2.0, 0.5));
    const glm::dvec3 foot =
        world_point(*scene, find_entity(*scene, "engine"), glm::dvec3(0.0, -0.25, 0.0));
    EXPECT_NEAR(foot.y, 0.0, 1e-12);
}

TEST_F(SceneDescription, models_keep_their_materials_and_share_their_meshes) {
    const auto scene = load(R"({"primitives": [{"shape": "box", "material": {"name": "blue"}}],
        "models": [{"file": "engine.glb", "name": "a"},
                   {"file": "engine.glb", "name": "b", "translation": [5, 0, 0]}]})");
    ASSERT_TRUE(scene) << scene.error().message;
    std::size_t parts = 0;
    scene->registry.each<Name, MeshInstance>(
        [&](Entity entity, const Name& name, const MeshInstance& instance) {
            const auto material = instance.mesh->sub_meshes[0].material;
            if (name.value == "box") {
                EXPECT_EQ(scene->materials[material].name, "blue");
                return;
            }
            ++parts;
            EXPECT_EQ(name.value, "part");
            EXPECT_EQ(scene->materials[material].name, "engine paint");
            const Entity whole = scene->registry.get<Parent>(entity).value;
            EXPECT_EQ(scene->registry.get<Name>(whole).value, "whole");
            const Entity root = scene->registry.get<Parent>(whole).value;
            const double x = scene->registry.get<Name>(root).value == "b" ? 5.0 : 0.0;
            EXPECT_EQ(world_point(*scene, entity, {0, 0, 0}), glm::dvec3(x, 0, 0));
        });
    EXPECT_EQ(parts, 2U);
}

TEST_F(SceneDescription, lights_and_cameras_look_along_minus_z) {
    const auto scene = load(R"({
        "lights": [{"type": "sun", "direction": [0, -2, 0]},
                   {"type": "spot", "position": [1, 2, 3], "direction": [3, 0, 4]}],
        "camera": {"eye": [0, 0, 5], "target": [0, 5, 0], "half_height": 2, "far": 9}})");
    ASSERT_TRUE(scene) << scene.error().message;
    const auto ahead = [&](const char* name) {
        const auto& world =
            scene->registry.get<WorldTransform>(find_entity(*scene, name)).world_from_local;
        return glm::dvec3(world * glm::dvec4(0.0, 0.0, -1.0, 0.0));
    };
    EXPECT_LT(glm::length(ahead("sun") - glm::dvec3(0, -1, 0)), 1e-12);
    EXPECT_LT(glm::length(ahead("spot") - glm::dvec3(0.6, 0, 0.8)), 1e-12);
    const double half = std::sqrt(0.5);
    EXPECT_LT(glm::length(ahead("camera") - glm::dvec3(0, half, -half)), 1e-12);
    const auto& camera = scene->registry.get<Camera>(find_entity(*scene, "camera"));
    const auto& orthographic = std::get<OrthographicCamera>(camera.projection);
    EXPECT_EQ(orthographic.half_height_m, 2.0);
    EXPECT_EQ(orthographic.half_width_m, 2.0);
    EXPECT_EQ(orthographic.far_m, 9.0);
}

TEST_F(SceneDescription, rotations_are_about_x_then_y_then_z) {
    const auto scene = load(R"({"primitives": [{"shape": "box", "rotation_deg": [90, 90, 0]}]})");
    ASSERT_TRUE(scene) << scene.error().message;
    const glm::dvec3 y = world_point(*scene, find_entity(*scene, "box"), {0, 1, 0});
    EXPECT_LT(glm::length(y - glm::dvec3(1, 0, 0)), 1e-12);  // x takes +Y to +Z, y that to +X
}

TEST_F(SceneDescription, mistakes_are_named_with_their_place) {
    const std::vector<std::pair<const char*, std::vector<std::string>>> cases{
        {R"({"model": []})", {"unknown member \"model\"", "models, primitives, lights, camera"}},
        {R"({"models": {}})", {"models is an object", "array"}},
        {R"({"models": [{}]})", {"models[0] has no member \"file\""}},
        {R"({"models": [{"file": "missing.glb"}]})", {"missing.glb", "does not exist"}},
        {R"({"models": [{"file": "engine.glb", "scale": "2"}]})", {"models[0].scale is \"2\""}},
        {R"({"models": [{"file": "engine.glb", "size": 2}]})", {"models[0]", "\"size\""}},
        {R"({"primitives": [{"shape": "cone"}]})", {"primitives[0].shape is \"cone\"", "cylinder"}},
        {R"({"primitives": [{"shape": "box", "radius": 1}]})",
         {"primitives[0]", "\"radius\"", "size"}},
        {R"({"primitives": [{"shape": "sphere", "radius": 0}]})", {"primitives[0].radius is 0"}},
        {R"({"primitives": [{"shape": "torus", "ring_radius": 3e38}]})",
         {"primitives[0].ring_radius is 3e+38", "to 1e+38"}},
        {R"({"primitives": [{"shape": "sphere", "slices": 2}]})",
         {"primitives[0].slices is 2", "from 3 to 2048"}},
        {R"({"primitives": [{"shape": "box", "translation": [1, 2]}]})",
         {"primitives[0].translation", "3 numbers"}},
        {R"({"primitives": [{"shape": "box", "translation": [1, 2, 1e300]}]})",
         {"primitives[0].translation[2] is 1e+300"}},
        {R"({"primitives": [{"shape": "box", "casts": 1}]})", {"primitives[0].casts is 1"}},
        {R"({"primitives": [{"shape": "box", "material": {"color": [1, 1, 1]}}]})",
         {"primitives[0].material", "\"color\"", "base_color"}},
        {R"({"lights": [{"type": "sun"}]})", {"lights[0] has no member \"direction\""}},
        {R"({"lights": [{"type": "sun", "direction": [0, 0, 0]}]})", {"lights[0].direction"}},
        {R"({"lights": [{"type": "point", "position": [0, 0, 0], "direction": [1, 0, 0]}]})",
         {"lights[0]", "\"direction\""}},
        {R"({"lights": [{"type": "spot", "position": [0, 0, 0], "direction": [1, 0, 0],
             "inner_cone_deg": 50}]})",
         {"lights[0].inner_cone_deg is 50", "to 45"}},
        {R"({"camera": {"eye": [1, 1, 1], "target": [1, 1, 1]}})", {"camera.target"}},
        {R"({"camera": {"eye": [1, 1, 1], "target": [1, 1, 2], "fovy_deg": 180}})",
         {"camera.fovy_deg is 180"}},
        {R"({"camera": {"eye": [1, 1, 1], "target": [1, 1, 2], "far": 10}})",
         {"camera.far", "orthographic"}},
        {R"({"camera": )", {"the JSON is broken"}},
    };
    for (const auto& [text, parts] : cases) {
        SCOPED_TRACE(text);
        const auto scene = load(text);
        ASSERT_FALSE(scene);
        EXPECT_THAT(scene.error().message, testing::EndsWith("."));
        EXPECT_EQ(scene.error().message.find('\n'), std::string::npos);
        for (const std::string& part : parts) EXPECT_THAT(scene.error().message, HasSubstr(part));
    }
}

TEST_F(SceneDescription, a_missing_description_is_an_io_error) {
    const auto scene = load_scene((folder_ / "missing.scene.json").string());
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().code, ErrorCode::Io);
    EXPECT_THAT(scene.error().message, HasSubstr("does not exist"));
}

TEST_F(SceneDescription, an_empty_description_is_an_empty_scene) {
    const auto scene = load("{}");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->registry.size(), 0U);
}

}  // namespace
}  // namespace gnomon::scene::test
