// SPDX-License-Identifier: MIT
//
// gnomon inspect: text and JSON say what is in the file.
#include <gmock/gmock.h>

#include "tests/cli/program.hpp"
#include "tests/scene/gltf_builder.hpp"

namespace gnomon::cli::test {
namespace {

using scene::test::GltfBuilder;
using scene::test::triangle_file;
using testing::HasSubstr;

class Inspect : public ProgramTest {
protected:
    nlohmann::json json_of(const std::string& model) const {
        return nlohmann::json::parse(run_well({"inspect", model, "--json"}).output);
    }
};

GltfBuilder tetrahedron_file() {
    GltfBuilder file;
    const auto position = file.positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    const auto index = file.indices({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
    file.mesh({{"attributes", {{"POSITION", position}}}, {"indices", index}});
    file.json["meshes"][0]["name"] = "pyramid";
    file.root({{"mesh", 0}, {"name", "one"}});
    return file;
}

TEST_F(Inspect, a_closed_model) {
    const std::string model = write("closed.glb", tetrahedron_file().glb());
    const std::string text = run_well({"inspect", model}).output;
    EXPECT_THAT(text, HasSubstr("closed.glb: 1 nodes, 1 meshes, 4 triangles drawn, 0 lights"));
    EXPECT_THAT(text, HasSubstr("size: 1 x 1 x 1 m"));
    EXPECT_THAT(text, HasSubstr("mesh \"pyramid\", used 1 time: closed"));
    const auto json = json_of(model);
    EXPECT_EQ(json["model"], "closed.glb");
    EXPECT_EQ(json["drawn_triangles"], 4);
    ASSERT_EQ(json["meshes"].size(), 1U);
    const auto& mesh = json["meshes"][0];
    EXPECT_EQ(mesh["name"], "pyramid");
    EXPECT_EQ(mesh["closed"], true);
    EXPECT_EQ(mesh["triangles"], 4);
    EXPECT_EQ(mesh["welded_vertices"], 4);
    EXPECT_EQ(mesh["edges"], 6);
    EXPECT_EQ(mesh["components"], 1);
    EXPECT_EQ(mesh["closed_components"], 1);
    for (const char* none : {"boundary_edges", "non_manifold_edges", "inconsistent_edges",
                             "unbalanced_edges", "degenerate_faces"}) {
        EXPECT_EQ(mesh[none], 0) << none;
    }
    EXPECT_EQ(mesh["alpha_tested"], false);
}

TEST_F(Inspect, an_open_model) {
    const std::string model = write("open.glb", triangle_file().glb());
    EXPECT_THAT(run_well({"inspect", model}).output, HasSubstr("casts two-sided"));
    const auto mesh = json_of(model)["meshes"][0];
    EXPECT_EQ(mesh["closed"], false);
    EXPECT_EQ(mesh["boundary_edges"], 3);
    EXPECT_EQ(mesh["unbalanced_edges"], 3);
}

TEST_F(Inspect, a_model_of_several_meshes_and_uses) {
    GltfBuilder file = tetrahedron_file();
    const auto flat =
        file.positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
    file.json["materials"] = {{{"alphaMode", "MASK"}}};
    file.mesh({{"attributes", {{"POSITION", flat}}}, {"material", 0}});
    file.json["meshes"][1]["name"] = "two\nlines";
    file.root({{"mesh", 0}, {"name", "again"}, {"translation", {3, 0, 0}}});
    file.root({{"mesh", 1}, {"name", "leaf"}});
    const std::string model = write("many.glb", file.glb());
    const std::string text = run_well({"inspect", model}).output;
    EXPECT_THAT(text, HasSubstr("3 nodes, 2 meshes, 10 triangles drawn"));
    EXPECT_THAT(text, HasSubstr("used 2 times: closed"));
    EXPECT_THAT(text, HasSubstr("mesh \"two lines\""));
    EXPECT_THAT(text, HasSubstr("alpha-tested"));
    const auto json = json_of(model);
    ASSERT_EQ(json["meshes"].size(), 2U);
    EXPECT_EQ(json["meshes"][0]["instances"], 2);
    EXPECT_EQ(json["meshes"][1]["instances"], 1);
    EXPECT_EQ(json["meshes"][1]["name"], "two\nlines");
    EXPECT_EQ(json["meshes"][1]["degenerate_faces"], 1);
    EXPECT_EQ(json["meshes"][1]["alpha_tested"], true);
}

TEST_F(Inspect, builtin_scenes_and_their_lights) {
    const auto json = json_of("builtin:still-life");
    EXPECT_EQ(json["lights"], 3);
    EXPECT_EQ(json["meshes"].size(), 5U);
    for (const auto& mesh : json["meshes"]) EXPECT_EQ(mesh["closed"], true) << mesh;
}

}  // namespace
}  // namespace gnomon::cli::test
