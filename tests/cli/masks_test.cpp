// SPDX-License-Identifier: MIT
//
// What `gnomon render` draws: masks in the right place, and equal bytes wherever the contract says
// so.
#include <gmock/gmock.h>

#include "tests/cli/program.hpp"

namespace gnomon::cli::test {
namespace {

using testing::ElementsAre;
using testing::IsSupersetOf;

const std::vector<std::string> drawing_backends{"gl", "vk"};

class Masks : public ProgramTest, public testing::WithParamInterface<std::string> {
protected:
    void SetUp() override {
        ProgramTest::SetUp();
        if (!draws(GetParam())) GTEST_SKIP() << GetParam() << " does not draw here";
    }
    [[nodiscard]] static Arguments with_backend(const Arguments& more = {}) {
        return joined({"--backend", GetParam()}, more);
    }
    [[nodiscard]] Mask mask(const std::string& scene, const Arguments& more = {}) const {
        return mask_of(scene, with_backend(more));
    }
    [[nodiscard]] std::string picture(const std::string& scene, const Arguments& more = {}) const {
        run_well(render(scene, with_backend(joined({"--out", "x.png"}, more))));
        return read("x.png");
    }
    [[nodiscard]] std::string wall() const { return write("wall.scene.json", wall_and_block()); }
};

// The block's shadow on the wall is as wide as the block: x from 1 to 2, y from 1.5 to 2.5 on a
// plane 10 m away, of which 2 * 10 * tan(22.5 degrees) = 8.284 m are seen in 120 rows.
TEST_P(Masks, row_0_is_on_top_and_an_undrawn_caster_casts) {
    const Mask m = mask(wall(), facing_the_wall({"--receivers", "wall"}));
    ASSERT_EQ(m.width, 160U);
    ASSERT_EQ(m.height, 120U);
    const double rows_per_metre = 120.0 / 8.28427;
    for (std::uint32_t y = 0; y < m.height; ++y) {
        for (std::uint32_t x = 0; x < m.width; ++x) {
            const double x_m = (x + 0.5 - 80.0) / rows_per_metre;
            const double y_m = (60.0 - y - 0.5) / rows_per_metre;
            const bool inside = x_m > 1.0 && x_m < 2.0 && y_m > 1.5 && y_m < 2.5;
            const double edge = std::min({std::abs(x_m - 1.0), std::abs(x_m - 2.0),
                                          std::abs(y_m - 1.5), std::abs(y_m - 2.5)});
            if (edge < 0.01) continue;
            ASSERT_EQ(m.at(x, y) != 0, inside) << x << ", " << y;
        }
    }
    EXPECT_GT(m.covered(), 150U);
}

TEST_P(Masks, globs_choose_who_casts_and_who_is_drawn) {
    const std::string scene = wall();
    const Arguments undrawn = facing_the_wall({"--receivers", "wall"});
    EXPECT_EQ(mask(scene, joined(undrawn, {"--casters", "block"})).bytes,
              mask(scene, undrawn).bytes);
    EXPECT_EQ(mask(scene, joined(undrawn, {"--casters", "w*"})).covered(), 0U);
    EXPECT_EQ(mask(scene, joined(undrawn, {"--casters", "no such node"})).covered(), 0U);
    const std::string drawn = picture(scene, facing_the_wall());
    EXPECT_NE(picture(scene, undrawn), drawn);
    EXPECT_NE(picture(scene, facing_the_wall({"--receivers", "no such node"})), drawn);
}

TEST_P(Masks, lights_replace_those_of_the_file_and_are_numbered_in_order) {
    const std::string scene = wall();
    const Arguments far_above{"--receivers", "wall", "--light", "dir:0,-1,-1"};
    run_well(render(scene, with_backend(joined(facing_the_wall(far_above), {"--stencil", "m"}))));
    EXPECT_THAT(files(), ElementsAre("m.light0.pgm", "m.light1.pgm", "wall.scene.json"));
    const Mask straight = read_mask("m.light0.pgm");
    const Mask lowered = read_mask("m.light1.pgm");
    EXPECT_EQ(straight.bytes, mask(scene, facing_the_wall({"--receivers", "wall"})).bytes);
    EXPECT_GT(lowered.covered(), 0U);
    EXPECT_NE(lowered.at(102, 31), straight.at(102, 31)) << "the light that falls stays above";
    run_well(render("builtin:still-life", with_backend({"--stencil", "s"})));
    EXPECT_THAT(files(), IsSupersetOf({"s.light0.pgm", "s.light1.pgm", "s.light2.pgm"}));
}

TEST_P(Masks, four_samples_are_four_masks) {
    run_well(render("builtin:knot", with_backend({"--samples", "4", "--stencil", "m"})));
    EXPECT_THAT(files(), ElementsAre("m.light0.pgm", "m.light0.s0.pgm", "m.light0.s1.pgm",
                                     "m.light0.s2.pgm", "m.light0.s3.pgm"));
    const Mask plain = read_mask("m.light0.pgm");
    EXPECT_EQ(plain.bytes, read_mask("m.light0.s0.pgm").bytes);
    EXPECT_GT(plain.covered(), 0U);
    for (const char* other : {"m.light0.s1.pgm", "m.light0.s2.pgm", "m.light0.s3.pgm"})
        EXPECT_NE(read_mask(other).bytes, plain.bytes) << other;
}

TEST_P(Masks, techniques_agree) {
    for (const char* scene : {"builtin:still-life", "builtin:open-shapes"}) {
        const Mask automatic = mask(scene, {"--technique", "auto"});
        EXPECT_GT(automatic.covered(), 0U);
        EXPECT_EQ(mask(scene, {"--technique", "zpass"}).bytes, automatic.bytes) << scene;
        EXPECT_EQ(mask(scene, {"--technique", "zfail"}).bytes, automatic.bytes) << scene;
    }
}

TEST_P(Masks, averted_caps_leave_averted_faces_to_shading) {
    const Arguments averted{"--caps", "averted"};
    const std::string scene = "builtin:still-life";
    const Mask facing = mask(scene, {"--caps", "facing"});
    EXPECT_EQ(facing.bytes, mask(scene).bytes) << "the default";
    const Mask open = mask(scene, averted);
    EXPECT_LT(open.covered(), facing.covered());
    for (std::size_t i = 0; i < open.bytes.size(); ++i)
        ASSERT_LE(static_cast<std::uint8_t>(open.bytes[i]),
                  static_cast<std::uint8_t>(facing.bytes[i]))
            << i;
    EXPECT_EQ(mask(scene, joined(averted, {"--technique", "zpass"})).bytes, open.bytes);
    EXPECT_EQ(mask(scene, joined(averted, {"--technique", "zfail"})).bytes, open.bytes);
    EXPECT_NE(picture("builtin:knot", averted), picture("builtin:knot"));
}

TEST_P(Masks, two_runs_give_the_same_bytes) {
    const Arguments moving{"--frames", "3", "--animate", "light:10", "--stencil", "m"};
    const std::string first = picture("builtin:still-life", moving);
    const std::string first_mask = read("m.light0.pgm");
    EXPECT_EQ(picture("builtin:still-life", moving), first);
    EXPECT_EQ(read("m.light0.pgm"), first_mask);
    EXPECT_NE(picture("builtin:still-life"), first) << "the last frame is the one that is written";
}

TEST_P(Masks, culling_changes_open_scenes_alone) {
    EXPECT_EQ(mask("builtin:still-life", {"--cull", "back"}).bytes,
              mask("builtin:still-life", {"--cull", "none"}).bytes);
    EXPECT_NE(mask("builtin:open-shapes", {"--cull", "back"}).bytes,
              mask("builtin:open-shapes").bytes);
}

TEST_P(Masks, every_overlay_is_seen) {
    const std::string plain = picture("builtin:still-life");
    std::vector<std::string> seen{plain};
    for (const char* overlay : {"volumes", "silhouettes", "caps", "wireframe", "count",
                                "volumes,silhouettes,caps,wireframe,count"}) {
        seen.push_back(picture("builtin:still-life", {"--technique", "zfail", "--show", overlay}));
        for (std::size_t i = 0; i + 1 < seen.size(); ++i)
            EXPECT_NE(seen.back(), seen[i]) << overlay << " looks like number " << i;
    }
}

TEST_P(Masks, overlays_leave_the_mask_alone) {
    EXPECT_EQ(mask("builtin:knot", {"--show", "volumes,silhouettes,caps,wireframe,count"}).bytes,
              mask("builtin:knot").bytes);
}

TEST_P(Masks, field_of_view_and_up_and_near_are_heeded) {
    const std::string scene = wall();
    const std::string plain = picture(scene, facing_the_wall());
    EXPECT_NE(picture(scene, {"--eye", "0,0,10", "--target", "0,0,0", "--light", "dir:0,0,-1",
                              "--fovy", "60"}),
              plain);
    EXPECT_NE(picture(scene, facing_the_wall({"--up", "1,0,0"})), plain);
    EXPECT_NE(picture(scene, facing_the_wall({"--near", "9"})), plain) << "the block is cut off";
    EXPECT_EQ(picture(scene, facing_the_wall({"--near", "0.01"})), plain);
}

TEST_P(Masks, a_mirrored_camera_node_counts_like_any_other) {
    // The scale of a camera's node says nothing (glTF 2.0, 3.10): equal pictures.
    const auto with_scale = [&](const std::string& scale) {
        const std::string file =
            R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"camera":0,)"
            R"("translation":[0,0,10],"scale":)" +
            scale +
            R"(}],"cameras":[{"type":"perspective","perspective":{"yfov":0.8,"znear":0.1}}]})";
        write("camera.gltf", file);
        const std::string scene =
            R"({"models":[{"file":"camera.gltf"}],)" + wall_and_block().substr(1);
        return mask(write("mirror.scene.json", scene),
                    {"--quiet", "--receivers", "wall", "--light", "dir:0,0,-1"});
    };
    const Mask plain = with_scale("[1,1,1]");
    EXPECT_GT(plain.covered(), 0U);
    EXPECT_EQ(with_scale("[-1,1,1]").bytes, plain.bytes);
    EXPECT_EQ(with_scale("[2,3,4]").bytes, plain.bytes);
}

INSTANTIATE_TEST_SUITE_P(Backends, Masks, testing::ValuesIn(drawing_backends),
                         [](const auto& param) { return param.param; });

class Parity : public ProgramTest {};

TEST_F(Parity, opengls_stencil_paths_give_equal_bytes) {
    if (!draws("gl")) GTEST_SKIP() << "gl does not draw here";
    for (const char* scene : {"builtin:room", "builtin:open-shapes"}) {
        std::vector<std::string> seen;
        for (const char* stencil_path : {"two-side", "separate", "two-pass"}) {
            const Outcome outcome =
                run(render(scene, {"--backend", "gl", "--gl-stencil", stencil_path, "--stencil",
                                   "m", "--stats", "stats.json", "--quiet"}));
            if (outcome.exit_code == 1) continue;  // an adapter need not have all three
            ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
            EXPECT_EQ(nlohmann::json::parse(read("stats.json"))["stencil_path"], stencil_path);
            seen.push_back(read("m.light0.pgm"));
            EXPECT_EQ(seen.back(), seen.front()) << scene << ", " << stencil_path;
        }
        EXPECT_GE(seen.size(), 2U);
    }
}

TEST_F(Parity, opengl_and_vulkan_give_equal_bytes) {
    if (!draws("gl") || !draws("vk")) GTEST_SKIP() << "only one of them draws here";
    for (const char* scene : {"builtin:still-life", "builtin:open-shapes"}) {
        for (const char* samples : {"1", "4"}) {
            const Mask gl = mask_of(scene, {"--backend", "gl", "--samples", samples});
            const Mask vk = mask_of(scene, {"--backend", "vk", "--samples", samples});
            EXPECT_GT(gl.covered(), 0U);
            EXPECT_EQ(gl.bytes, vk.bytes) << scene << " at " << samples << " samples";
        }
    }
}

}  // namespace
}  // namespace gnomon::cli::test
