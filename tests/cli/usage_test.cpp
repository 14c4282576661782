// SPDX-License-Identifier: MIT
//
// Bad usage: exit code 2 and one sentence, before anything is written.
#include <gmock/gmock.h>

#include "tests/cli/program.hpp"

namespace gnomon::cli::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Usage : public ProgramTest {
protected:
    static Arguments knot(const Arguments& more) {
        return joined({"render", "builtin:knot", "--backend", "null", "--out", "x.png"}, more);
    }
};

TEST_F(Usage, help_and_version_end_well) {
    EXPECT_THAT(run_well({"--help"}).output, HasSubstr("render"));
    const std::string inspect_help = run_well({"inspect", "--help"}).output;
    for (const char* word : {"--json", "--obj", "two-sided", "64 light directions"}) {
        EXPECT_THAT(inspect_help, HasSubstr(word));
    }
    EXPECT_THAT(run_well({"--version"}).output, testing::ContainsRegex("^[0-9]+\\.[0-9]+"));
    const std::string help = run_well({"render", "--help"}).output;
    for (const char* option : {"--out",        "--stencil",
                               "--stats",      "--backend",
                               "--gl-stencil", "--size",
                               "--samples",    "--eye",
                               "--target",     "--up",
                               "--fovy",       "--light",
                               "--casters",    "--receivers",
                               "--cull",       "--technique",
                               "--silhouette", "--show",
                               "--frames",     "--animate",
                               "--near",       "--list-silhouettes",
                               "--caps",       "--time",
                               "--animation",  "--layers"}) {
        EXPECT_THAT(help, HasSubstr(option));
    }
}

TEST_F(Usage, strategies_are_listed_and_taken) {
    const std::string list = run_well({"render", "--list-silhouettes"}).output;
    EXPECT_THAT(list, HasSubstr("auto: "));
    EXPECT_THAT(list, HasSubstr("brute_force: "));
    EXPECT_THAT(list, HasSubstr("gpu_quads: "));
    EXPECT_THAT(list, HasSubstr("gpu_quads_float: "));
    run_well(knot({"--silhouette", "brute_force"}));
    run_well(knot({"--silhouette", "gpu_quads", "--layers", "promised"}));
    run_well(knot({"--silhouette", "gpu_quads_float", "--layers", "proved"}));
    expect_refused(knot({"--layers", "few"}), {"few", "promised"});
    expect_refused(knot({"--silhouette", "guess"}), {"guess", "auto, brute_force"});
}

TEST_F(Usage, unknown_words_are_refused_by_name) {
    expect_refused({}, {"subcommand"});
    expect_refused({"frobnicate"}, {"frobnicate", "render", "inspect"});
    expect_refused({"frobnicate", "--help"}, {"frobnicate"});
    expect_refused({"--frobnicate"}, {});
    expect_refused({"render"}, {"SCENE"});
    expect_refused({"render", ""}, {"SCENE"});
    expect_refused({"render", "--frobnicate"}, {"--frobnicate"});
    expect_refused(knot({"--out-of-range", "1"}), {"--out-of-range"});
    expect_refused(knot({"builtin:room"}), {"builtin:room"});
    expect_refused({"inspect"}, {"model"});
    expect_refused({"inspect", "builtin:knot", "--size", "8x8"}, {"--size"});
    expect_refused({"inspect", "builtin:knot", "builtin:room"}, {"builtin:room"});
    EXPECT_THAT(files(), IsEmpty());
}

TEST_F(Usage, commands_of_later_work_are_refused_like_any_other) {
    for (const char* command : {"profile", "serve"})
        expect_refused({command, "builtin:knot"}, {command});
}

TEST_F(Usage, values_out_of_range_are_refused_by_option) {
    const std::vector<Arguments> bad{{"--backend", "metal"},
                                     {"--backend", ""},
                                     {"--gl-stencil", "one-side"},
                                     {"--size", "0x5"},
                                     {"--size", "20000x5"},
                                     {"--size", "big"},
                                     {"--samples", "2"},
                                     {"--samples", "0"},
                                     {"--samples", "-4"},
                                     {"--samples", "nan"},
                                     {"--eye", "1,2"},
                                     {"--eye", "1,2,nan"},
                                     {"--target", "1,2,3,4"},
                                     {"--target", "1e300,0,0"},
                                     {"--up", "0,0,0"},
                                     {"--up", "x"},
                                     {"--fovy", "180"},
                                     {"--fovy", "0"},
                                     {"--fovy", "-45"},
                                     {"--fovy", "nan"},
                                     {"--fovy", "inf"},
                                     {"--fovy", "45deg"},
                                     {"--light", "sun"},
                                     {"--light", ""},
                                     {"--light", "dir:0,0,0"},
                                     {"--cull", "front"},
                                     {"--caps", "back"},
                                     {"--technique", "zpas"},
                                     {"--show", "everything"},
                                     {"--show", ""},
                                     {"--frames", "0"},
                                     {"--frames", "-1"},
                                     {"--frames", "1.5"},
                                     {"--frames", "1000001"},
                                     {"--frames", "99999999999999999999"},
                                     {"--animate", "spin"},
                                     {"--animate", "light:"},
                                     {"--animate", "casters:x"},
                                     {"--animate", "time:x"},
                                     {"--time", "nan"},
                                     {"--time", "soon"},
                                     {"--animation", ""},
                                     {"--near", "0"},
                                     {"--near", "-1"},
                                     {"--near", "nan"},
                                     {"--near", "inf"},
                                     {"--near", "1e999"},
                                     {"--near", "1m"},
                                     {"--stats", ""},
                                     {"--stencil", ""}};
    for (const Arguments& arguments : bad) expect_refused(knot(arguments), {arguments[0]});
    EXPECT_THAT(files(), IsEmpty());
}

TEST_F(Usage, an_option_needs_its_value_and_comes_once) {
    expect_refused(knot({"--size"}), {"--size"});
    expect_refused(knot({"--size", "8x8", "--size", "9x9"}), {"--size"});
    expect_refused(knot({"--light"}), {"--light"});
}

TEST_F(Usage, values_that_begin_with_a_minus_are_values) {
    run_well(render("builtin:knot", {"--backend", "null", "--eye", "-1,-2,-3", "--target", "-1,0,0",
                                     "--light", "dir:-1,-1,0"}));
}

TEST_F(Usage, a_camera_needs_a_direction) {
    expect_refused(knot({"--eye", "1,2,3", "--target", "1,2,3"}), {"--eye", "--target"});
    expect_refused(knot({"--eye", "0,0,0", "--target", "1e-200,0,0"}), {"--eye", "--target"});
    // Straight down along --up leaves the roll open: legal.
    run_well(knot({"--eye", "0,5,0", "--target", "0,0,0"}));
}

TEST_F(Usage, a_stencil_path_is_opengls) {
    expect_refused(knot({"--gl-stencil", "separate"}), {"--gl-stencil separate", "null"});
}

TEST_F(Usage, a_size_beyond_the_device_is_refused) {
    expect_refused(knot({"--size", "9000x9"}), {"9000x9", "8192"});
}

TEST_F(Usage, scenes_that_cannot_be_read_are_refused_by_name) {
    std::filesystem::create_directory(path("folder.glb"));
    for (const char* command : {"render", "inspect"}) {
        expect_refused({command, "missing.glb"}, {"missing.glb", "does not exist"});
        expect_refused({command, "missing/file.gltf"}, {"missing/file.gltf"});
        expect_refused({command, "folder.glb"}, {"folder.glb"});
        expect_refused({command, "."}, {".glb", ".gltf", ".scene.json"});
        expect_refused({command, "model.obj"}, {"model.obj"});
        expect_refused({command, "builtin:nothing"}, {"nothing", "still-life"});
        expect_refused({command, "two\nlines.glb"}, {"two lines.glb"});
    }
}

TEST_F(Usage, what_cannot_be_written_is_refused_and_nothing_is_written) {
    write("x.png", "as it was");
    write("mask.light0.pgm", "as it was");
    std::filesystem::create_directory(path("folder"));
    expect_refused(knot({"--stencil", "missing/mask"}), {"missing/mask.light0.pgm"});
    expect_refused(knot({"--stencil", "mask", "--stats", "missing/s.json"}), {"missing/s.json"});
    expect_refused(knot({"--stencil", "mask", "--stats", "folder"}), {"folder"});
    expect_refused(knot({"--stencil", "mask", "--stats", "x.png"}), {"x.png"});
    expect_refused(knot({"--stencil", "mask", "--stats", "/dev/full"}), {"/dev/full"});
    expect_refused({"render", "builtin:knot", "--backend", "null", "--out", "missing/x.png"},
                   {"missing/x.png"});
    EXPECT_EQ(read("x.png"), "as it was");
    EXPECT_EQ(read("mask.light0.pgm"), "as it was");
    EXPECT_THAT(files(), ElementsAre("folder", "mask.light0.pgm", "x.png"));
}

TEST_F(Usage, a_mask_that_cannot_be_written_leaves_the_others_alone) {
    // Only the second light's name is taken by a folder: found out at the very end.
    std::filesystem::create_directory(path("mask.light1.pgm"));
    expect_refused(
        render("builtin:still-life", {"--backend", "null", "--out", "x.png", "--stencil", "mask"}),
        {"mask.light1.pgm"});
    EXPECT_THAT(files(), ElementsAre("mask.light1.pgm"));
}

}  // namespace
}  // namespace gnomon::cli::test
