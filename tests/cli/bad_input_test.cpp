// SPDX-License-Identifier: MIT
//
// Bad models through the whole program: exit code 2 and one sentence that names the file. Without a
// driver, so that a leak is ours.
#include <gmock/gmock.h>

#include <array>
#include <limits>

#include "tests/cli/program.hpp"
#include "tests/scene/gltf_builder.hpp"
#include "tests/support/paths.hpp"

namespace gnomon::cli::test {
namespace {

using scene::test::Bytes;
using scene::test::GltfBuilder;
using scene::test::Json;
using scene::test::triangle_file;
using testing::ElementsAre;

class BadInput : public ProgramTest {
protected:
    void expect_both_refuse(const std::string& file, const std::vector<std::string>& parts) const {
        expect_refused({"inspect", file}, joined({file}, parts));
        expect_refused(render(file, {"--backend", "null", "--out", "x.png"}),
                       joined({file}, parts));
        EXPECT_FALSE(std::filesystem::exists(path("x.png")));
    }
    void expect_both_refuse(const GltfBuilder& builder,
                            const std::vector<std::string>& parts) const {
        expect_both_refuse(write("bad.glb", builder.glb()), parts);
    }
};

TEST_F(BadInput, truncated_files) {
    const Bytes whole = triangle_file().glb();
    run_well(render(write("whole.glb", whole), {"--backend", "null"}));
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{3}, std::size_t{11}, std::size_t{12}, std::size_t{19},
          std::size_t{21}, whole.size() / 2, whole.size() - 40, whole.size() - 1}) {
        SCOPED_TRACE(size);
        expect_both_refuse(write("part.glb", std::span(whole).first(size)), {});
    }
}

TEST_F(BadInput, text_that_is_not_json) {
    expect_both_refuse(write("bad.gltf", "{\"asset\": "), {});
    expect_both_refuse(write("bad.scene.json", "[1, 2"), {});
    expect_both_refuse(write("odd.scene.json", R"({"primitive": []})"), {"primitive"});
}

TEST_F(BadInput, an_index_out_of_range) {
    GltfBuilder file;
    const auto position = file.positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const auto index = file.indices({0, 1, 3});
    file.mesh({{"attributes", {{"POSITION", position}}}, {"indices", index}});
    file.root({{"mesh", 0}});
    expect_both_refuse(file, {"3"});
}

TEST_F(BadInput, a_position_that_is_not_finite) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        GltfBuilder file;
        const auto position = file.positions({{0, 0, 0}, {1, bad, 0}, {0, 1, 0}});
        file.mesh({{"attributes", {{"POSITION", position}}}});
        file.root({{"mesh", 0}});
        expect_both_refuse(file, {});
    }
}

TEST_F(BadInput, nodes_in_a_circle) {
    GltfBuilder file = triangle_file();
    file.node({{"children", {2}}});
    file.node({{"children", {1}}});
    file.json["nodes"][0]["children"] = {1};
    expect_both_refuse(file, {});
}

TEST_F(BadInput, a_buffer_that_is_missing) {
    expect_both_refuse(write("bad.gltf", triangle_file().gltf("missing.bin")), {"missing.bin"});
    expect_both_refuse(write("out.gltf", triangle_file().gltf("../../secret.bin")), {});
}

TEST_F(BadInput, a_model_of_a_description_that_is_missing) {
    const std::string name = write("bad.scene.json", R"({"models": [{"file": "missing.glb"}]})");
    expect_refused({"inspect", name}, {"missing.glb"});
    expect_refused(render(name, {"--backend", "null"}), {"missing.glb"});
}

TEST_F(BadInput, a_name_with_line_breaks_does_not_break_the_sentence) {
    GltfBuilder file = triangle_file();
    file.json["nodes"][0]["name"] = "two\nlines\x1b[31m";
    file.json["nodes"][0]["mesh"] = 7;
    expect_both_refuse(file, {});
}

TEST_F(BadInput, a_camera_without_a_direction) {
    GltfBuilder file = triangle_file();
    file.json["cameras"] =
        Json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}}});
    file.root({{"camera", 0}, {"name", "flat"}, {"scale", {0, 0, 0}}});
    const std::string name = write("flat.glb", file.glb());
    expect_refused(render(name, {"--backend", "null"}), {name, "flat", "--eye"});
    run_well(render(name, {"--backend", "null", "--eye", "0,0,5"}));
    run_well({"inspect", name});
}

TEST_F(BadInput, nothing_to_draw_is_legal) {
    GltfBuilder empty;
    write("empty.glb", empty.glb());
    GltfBuilder no_triangles;
    const auto position = no_triangles.positions({{0, 0, 0}, {1, 0, 0}});
    no_triangles.mesh({{"attributes", {{"POSITION", position}}}});
    no_triangles.root({{"mesh", 0}});
    write("lines.glb", no_triangles.glb());
    write("empty.scene.json", "{}");
    for (const char* name : {"empty.glb", "lines.glb", "empty.scene.json"}) {
        for (const char* samples : {"1", "4"}) {
            SCOPED_TRACE(name);
            const Outcome outcome =
                run(render(name, {"--backend", "null", "--out", "x.png", "--samples", samples,
                                  "--show", "volumes,silhouettes,caps,wireframe,count", "--frames",
                                  "2", "--animate", "light:3", "--stencil", "mask", "--quiet"}));
            EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
            EXPECT_EQ(outcome.errors, "");
            EXPECT_EQ(read("x.png").substr(1, 3), "PNG");
            EXPECT_EQ(read_mask("mask.light0.pgm").covered(), 0U);
            std::filesystem::remove(path("x.png"));
        }
        EXPECT_EQ(run({"inspect", name}).exit_code, 0);
    }
}

TEST_F(BadInput, notes_on_a_file_do_not_come_with_a_refusal) {
    const std::string name = write("empty.glb", GltfBuilder().glb());
    EXPECT_NE(run(render(name, {"--backend", "null"})).errors, "");
    EXPECT_EQ(run(render(name, {"--backend", "null", "--quiet"})).errors, "");
    expect_refused({"render", name, "--backend", "null", "--size", "9000x9"}, {"9000x9"});
}

TEST_F(BadInput, flat_huge_and_tiny_models_are_drawn_or_refused) {
    for (const double size : {1e-30, 1e-12, 1.0, 1e12, 1e37}) {
        for (const double scale : {0.0, 1.0, 1e-20, 1e20}) {
            SCOPED_TRACE(size);
            SCOPED_TRACE(scale);
            const auto s = static_cast<float>(size);
            GltfBuilder file;
            const auto position =
                file.positions({{0, 0, 0}, {s, 0, 0}, {0, s, 0}, {0, 0, 0}, {0, 0, 0}, {s, 0, 0}});
            file.mesh({{"attributes", {{"POSITION", position}}}});
            file.root({{"mesh", 0}, {"scale", {scale, scale, scale}}});
            const Outcome outcome = run(
                render(write("model.glb", file.glb()),
                       {"--backend", "null", "--stats", "stats.json", "--light", "point:1,2,3"}));
            EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 2) << outcome.errors;
        }
    }
}

// What others have found to break readers: only where the machine has it.
TEST_F(BadInput, hard_models_end_in_0_or_2) {
    const std::filesystem::path models = gnomon::test::models_folder() / "hard";
    if (!std::filesystem::exists(models)) GTEST_SKIP() << models << " is not here";
    std::size_t seen = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(models)) {
        const auto extension = entry.path().extension();
        if ((extension != ".glb" && extension != ".gltf") || entry.file_size() > 200'000) continue;
        ++seen;
        const Outcome outcome = run(render(entry.path().string(), {"--backend", "null"}));
        EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 2)
            << entry.path() << ": " << outcome.errors;
    }
    EXPECT_GT(seen, 0U);
}

}  // namespace
}  // namespace gnomon::cli::test
