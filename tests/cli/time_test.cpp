// SPDX-License-Identifier: MIT
//
// --time, --animation and --animate time:SECONDS, on a figure that walks.
#include <gmock/gmock.h>

#include "program.hpp"
#include "tests/scene/walking_figure.hpp"

namespace gnomon::cli::test {
namespace {

using testing::HasSubstr;

class TimeTest : public ProgramTest {
protected:
    void SetUp() override {
        ProgramTest::SetUp();
        write("walk.glb", scene::test::walking_figure().glb());
        write("walk.scene.json", R"({"models": [{"file": "walk.glb"},
                                               {"file": "walk.glb", "translation": [1, 0, 0]}],
                                    "primitives": [{"shape": "plane", "name": "ground"}]})");
    }
    [[nodiscard]] std::string mask_at(const std::string& scene, const Arguments& more) const {
        return mask_of(scene, joined({"--eye", "2,2,3", "--target", "0,0.8,0"}, more)).bytes;
    }
};

TEST_F(TimeTest, the_pose_is_that_of_the_time_and_loops) {
    for (const char* backend : {"gl", "vk"}) {
        if (!draws(backend)) continue;
        for (const char* scene : {"walk.glb", "walk.scene.json"}) {
            SCOPED_TRACE(std::string(backend) + " " + scene);
            const Arguments on{"--backend", backend};
            const std::string early = mask_at(scene, joined(on, {"--time", "0.25"}));
            EXPECT_NE(early, mask_at(scene, joined(on, {"--time", "0.5"})));
            EXPECT_NE(early, mask_at(scene, on));
            EXPECT_EQ(early, mask_at(scene, joined(on, {"--time", "3.25"})));
            EXPECT_EQ(early, mask_at(scene, joined(on, {"--time", "0.25", "--animation", "walk"})));
            EXPECT_EQ(early, mask_at(scene, joined(on, {"--time", "0.25", "--animation", "0"})));
            // Buffers that were filled before and are filled again.
            EXPECT_EQ(early,
                      mask_at(scene, joined(on, {"--frames", "3", "--animate", "time:0.125"})));
        }
    }
}

TEST_F(TimeTest, a_pose_that_stays_is_found_once) {
    const auto still =
        stats_of("walk.scene.json", {"--backend", "null", "--time", "0.3", "--frames", "3"});
    EXPECT_GT(still["frames"][0]["pairs_redetected"], 1);
    EXPECT_EQ(still["frames"][1]["pairs_redetected"], 0);
    EXPECT_EQ(still["frames"][2]["pairs_redetected"], 0);
    const auto moving = stats_of("walk.scene.json",
                                 {"--backend", "null", "--animate", "time:0.01", "--frames", "3"});
    EXPECT_EQ(moving["frames"][2]["pairs_redetected"], 2);  // the ground is as it was
    EXPECT_EQ(moving["frames"][2]["reasons"]["mesh changed"], 2);
    EXPECT_GT(moving["frames"][2]["upload_bytes"], still["frames"][2]["upload_bytes"]);
}

TEST_F(TimeTest, no_animation_is_a_note_and_no_failure) {
    const Outcome outcome = run(render("builtin:knot", {"--backend", "null", "--time", "1"}));
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.errors, HasSubstr("has no animations"));
    run_well(render("builtin:knot", {"--backend", "null", "--time", "1", "--quiet"}));
}

TEST_F(TimeTest, an_animation_that_is_not_there_is_refused_with_those_that_are) {
    expect_refused(render("walk.glb", {"--backend", "null", "--animation", "run"}),
                   {"--animation", "\"run\"", "0 \"walk\""});
}

}  // namespace
}  // namespace gnomon::cli::test
