// SPDX-License-Identifier: MIT
//
// gnomon inspect: text, JSON and OBJ say what is in the file.
#include <map>
#include <set>
#include <sstream>

#include <gmock/gmock.h>

#include "tests/cli/program.hpp"
#include "tests/scene/gltf_builder.hpp"
#include "tests/support/models.hpp"

namespace gnomon::cli::test {
namespace {

using scene::test::GltfBuilder;
using scene::test::triangle_file;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

/// An OBJ file's objects: how many points, lines and faces each has, by its name's end.
struct ObjObject {
    std::size_t points = 0;
    std::size_t lines = 0;
    std::size_t faces = 0;
};

/// Reads it as a modelling program does: every element's vertices must have come before it, and no
/// two of an element may be equal.
std::map<std::string, ObjObject> read_obj(const std::string& text) {
    std::map<std::string, ObjObject> objects;
    ObjObject* object = nullptr;
    std::size_t vertices = 0;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "o") {
            std::string name;
            words >> name;
            EXPECT_EQ(objects.count(name), 0U) << name;
            object = &objects[name];
        } else if (kind == "v") {
            double x = 0.0;
            double y = 0.0;
            double z = 0.0;
            EXPECT_TRUE(words >> x >> y >> z) << line;
            ++vertices;
        } else if (kind == "p" || kind == "l" || kind == "f") {
            std::set<std::size_t> corners;
            std::size_t count = 0;
            for (std::size_t number = 0; words >> number; ++count) {
                EXPECT_TRUE(number >= 1 && number <= vertices) << line;
                corners.insert(number);
            }
            EXPECT_EQ(corners.size(), count) << line;
            EXPECT_EQ(count, kind == "p" ? 1U : (kind == "l" ? 2U : 3U)) << line;
            if (object == nullptr) {
                ADD_FAILURE() << "an element before any object: " << line;
                break;
            }
            ++(kind == "p" ? object->points : (kind == "l" ? object->lines : object->faces));
        } else {
            EXPECT_EQ(kind, "#") << line;
        }
    }
    return objects;
}

std::vector<std::string> kinds_of(const nlohmann::json& report) {
    std::vector<std::string> kinds;
    for (const auto& finding : report["findings"]) kinds.push_back(finding["kind"]);
    return kinds;
}

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

/// A closed box, the same wound inwards, a sheet of two triangles, three pages on one edge, a
/// tetrahedron with one face flipped, and two faces without area: one on a line, one in a point.
GltfBuilder everything_file() {
    std::vector<glm::vec3> positions;
    std::vector<std::uint16_t> indices;
    const auto add = [&](const std::vector<glm::vec3>& points,
                         const std::vector<std::uint16_t>& corners, float x) {
        const auto first = static_cast<std::uint16_t>(positions.size());
        for (const glm::vec3& p : points) positions.push_back(p + glm::vec3(x, 0.0F, 0.0F));
        for (const std::uint16_t c : corners) {
            indices.push_back(static_cast<std::uint16_t>(first + c));
        }
    };
    const std::vector<glm::vec3> solid{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    add(solid, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}, 0.0F);
    add(solid, {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2}, 10.0F);
    add({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, {0, 1, 2, 0, 2, 3}, 20.0F);
    add({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 1}, {-1, 0, -1}}, {0, 1, 2, 0, 1, 3, 0, 1, 4},
        30.0F);
    add(solid, {0, 1, 2, 0, 1, 3, 0, 3, 2, 1, 2, 3}, 40.0F);
    add({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}}, {0, 1, 2, 3, 3, 3}, 50.0F);
    GltfBuilder file;
    const auto position = file.positions(positions);
    const auto index = file.indices(indices);
    file.mesh({{"attributes", {{"POSITION", position}}}, {"indices", index}});
    file.json["meshes"][0]["name"] = "all sorts";
    file.root({{"mesh", 0}});
    return file;
}

TEST_F(Inspect, every_component_says_how_it_casts_and_why) {
    const std::string model = write("all.glb", everything_file().glb());
    const auto report = json_of(model);
    const auto mesh = report["meshes"][0];
    const auto& list = mesh["component_list"];
    ASSERT_EQ(list.size(), 7U);
    std::vector<std::string> casts;
    for (const auto& component : list) casts.push_back(component["casts"]);
    EXPECT_THAT(casts, ElementsAre("one_sided", "inside_out", "two_sided", "two_sided", "two_sided",
                                   "nothing", "nothing"));
    EXPECT_EQ(list[2]["boundary_edges"], 4);
    EXPECT_EQ(list[3]["non_manifold_edges"], 1);
    EXPECT_EQ(list[3]["boundary_edges"], 6);
    EXPECT_EQ(list[4]["inconsistent_edges"], 3);
    EXPECT_EQ(list[5]["degenerate_faces"], 1);
    EXPECT_EQ(list[1]["bounds_min"], nlohmann::json({10, 0, 0}));
    EXPECT_EQ(list[1]["bounds_max"], nlohmann::json({11, 1, 1}));
    EXPECT_EQ(
        mesh["components_by_kind"],
        nlohmann::json({{"nothing", 2}, {"one_sided", 1}, {"inside_out", 1}, {"two_sided", 3}}));
    EXPECT_THAT(kinds_of(report), ElementsAre("boundary", "non_manifold", "inconsistent",
                                              "degenerate", "inside_out", "two_sided"));
    for (const auto& finding : report["findings"]) {
        for (const char* sentence : {"what", "shadows", "advice"}) {
            EXPECT_THAT(finding[sentence].get<std::string>(), testing::EndsWith("."));
        }
    }
    const std::string text = run_well({"inspect", model}).output;
    EXPECT_THAT(text, HasSubstr("2 without area, 1 closed, 1 inside out, 3 two-sided"));
    EXPECT_THAT(text, HasSubstr("#3: two-sided, 3 faces, boundary edges 6, non-manifold 1"));
    EXPECT_THAT(text, HasSubstr("boundary edges: 13\n  They have one face only"));
    EXPECT_THAT(text, HasSubstr("Nothing leaks"));
}

TEST_F(Inspect, a_clean_model_has_no_findings) {
    const std::string model = write("closed.glb", tetrahedron_file().glb());
    EXPECT_THAT(kinds_of(json_of(model)), IsEmpty());
    const std::string text = run_well({"inspect", model, "--obj", "none.obj"}).output;
    EXPECT_THAT(text, Not(HasSubstr("leak")));
    EXPECT_THAT(read_obj(read("none.obj")), IsEmpty());
}

TEST_F(Inspect, costs_are_those_of_the_silhouettes) {
    const auto mesh = json_of(write("closed.glb", tetrahedron_file().glb()))["meshes"][0];
    const auto& cost = mesh["cost"];
    // A tetrahedron's outline has three edges or four.
    const double mean = cost["as_it_casts"]["mean"]["silhouette_edges"];
    EXPECT_GT(mean, 3.0);
    EXPECT_LT(mean, 4.0);
    EXPECT_EQ(mesh["most_layers"], 1);
    EXPECT_EQ(cost["two_sided"]["mean"]["cap_triangles"], 4);
    EXPECT_EQ(cost["two_sided"]["mean"]["side_quads"], 2.0 * mean);
    EXPECT_EQ(mesh["component_list"][0]["cost"], cost);
    const auto open = json_of(write("open.glb", triangle_file().glb()))["meshes"][0]["cost"];
    EXPECT_EQ(open["as_it_casts"], open["two_sided"]);
    EXPECT_EQ(open["as_it_casts"]["largest"]["index_bytes"], 4 * (3 * 6 + 2 * 3));
}

TEST_F(Inspect, obj_has_the_offending_edges_by_kind) {
    const std::string model = write("all.glb", everything_file().glb());
    // A face whose corners lie on a line has edges, and no neighbours.
    run_well({"inspect", model, "--obj", "edges.obj"});
    EXPECT_THAT(files(), UnorderedElementsAre("all.glb", "edges.obj"));
    const std::string text = read("edges.obj");
    EXPECT_THAT(text, HasSubstr("# mesh 0 \"all sorts\": 13 boundary, 1 non_manifold, 3 "
                                "inconsistent edges, 2 degenerate faces\n"));
    const auto objects = read_obj(text);
    ASSERT_EQ(objects.size(), 4U);
    EXPECT_EQ(objects.at("0_all_sorts_boundary").lines, 13U);
    EXPECT_EQ(objects.at("0_all_sorts_non_manifold").lines, 1U);
    EXPECT_EQ(objects.at("0_all_sorts_inconsistent").lines, 3U);
    EXPECT_EQ(objects.at("0_all_sorts_degenerate").faces, 1U);
    EXPECT_EQ(objects.at("0_all_sorts_degenerate").points, 1U);
    // The spine of the three pages, where it is.
    EXPECT_THAT(text, HasSubstr("o 0_all_sorts_non_manifold\nv 30 0 0\nv 30 1 0\nl 13 14\n"));
}

TEST_F(Inspect, a_bad_obj_name_is_refused_before_anything_is_read) {
    expect_refused({"inspect", "no-such-model.glb", "--obj", "missing/edges.obj"},
                   {"missing/edges.obj"});
    expect_refused({"inspect", "builtin:knot", "--obj", ""}, {"--obj", "empty"});
    write("old.obj", "old");
    expect_refused({"inspect", "no-such-model.glb", "--obj", "old.obj"}, {"no-such-model.glb"});
    EXPECT_EQ(read("old.obj"), "old");
}

TEST_F(Inspect, of_thousands_of_components_text_shows_a_few) {
    std::vector<glm::vec3> positions;
    for (int i = 0; i < 2000; ++i) {
        const auto x = static_cast<float>(3 * i);
        positions.insert(positions.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}});
        if (i == 1234) {  // the worst: two triangles
            positions.insert(positions.end(), {{x + 1, 0, 0}, {x, 1, 0}, {x + 1, 1, 1}});
        }
    }
    GltfBuilder file;
    file.mesh({{"attributes", {{"POSITION", file.positions(positions)}}}});
    file.root({{"mesh", 0}});
    const std::string model = write("many.glb", file.glb());
    const std::string text = run_well({"inspect", model}).output;
    EXPECT_LT(text.size(), 3000U);
    EXPECT_THAT(text, HasSubstr("components by kind: 2000 two-sided\n    #1234: "));
    EXPECT_THAT(text, HasSubstr("from (3702, 0, 0) to (3703, 1, 1)"));
    EXPECT_THAT(text, HasSubstr("and 1995 more like these; --json has all"));
    EXPECT_EQ(json_of(model)["meshes"][0]["component_list"].size(), 2000U);
}

// Models whose topology is known from elsewhere.
TEST_F(Inspect, hard_models_are_what_their_list_says) {
    const auto manifest = gnomon::test::read_manifest();
    std::size_t looked_at = 0;
    for (const auto& [name, file] : gnomon::test::model_files()) {
        if (file.parent_path().filename() != "hard") continue;
        SCOPED_TRACE(name);
        ASSERT_EQ(manifest.count(name), 1U);
        auto row = manifest.at(name);
        const auto report = nlohmann::json::parse(
            run_well({"inspect", file.string(), "--json", "--obj", "edges.obj"}).output);
        const auto objects = read_obj(read("edges.obj"));
        std::map<std::string, std::size_t> sums;
        std::map<std::string, std::size_t> elements;
        for (const auto& mesh : report["meshes"]) {
            for (const char* figure :
                 {"edges", "boundary_edges", "non_manifold_edges", "inconsistent_edges",
                  "unbalanced_edges", "degenerate_faces"}) {
                sums[figure] += mesh[figure].get<std::size_t>();
            }
            EXPECT_EQ(mesh["components_by_kind"]["two_sided"] == 0, mesh["unbalanced_edges"] == 0);
        }
        for (const auto& [object, counts] : objects) {
            const std::string kind = object.substr(object.rfind('_') + 1);
            elements[kind] += counts.points + counts.lines + counts.faces;
        }
        EXPECT_EQ(sums["edges"], std::stoul(row["edges"]));
        EXPECT_EQ(sums["boundary_edges"], std::stoul(row["boundary"]));
        EXPECT_EQ(sums["non_manifold_edges"], std::stoul(row["non-manifold"]));
        EXPECT_EQ(sums["inconsistent_edges"], std::stoul(row["flipped"]));
        EXPECT_EQ(sums["unbalanced_edges"], std::stoul(row["unbalanced"]));
        EXPECT_EQ(sums["degenerate_faces"], std::stoul(row["degenerate"]));
        EXPECT_EQ(elements["boundary"], sums["boundary_edges"]);
        EXPECT_EQ(elements["manifold"], sums["non_manifold_edges"]);
        EXPECT_EQ(elements["inconsistent"], sums["inconsistent_edges"]);
        EXPECT_EQ(elements["degenerate"], sums["degenerate_faces"]);
        ++looked_at;
    }
    if (looked_at == 0) GTEST_SKIP() << "no models in " << gnomon::test::models_folder() / "hard";
}

TEST_F(Inspect, builtin_scenes_and_their_lights) {
    const auto json = json_of("builtin:still-life");
    EXPECT_EQ(json["lights"], 3);
    EXPECT_EQ(json["meshes"].size(), 5U);
    for (const auto& mesh : json["meshes"]) EXPECT_EQ(mesh["closed"], true) << mesh;
}

}  // namespace
}  // namespace gnomon::cli::test
