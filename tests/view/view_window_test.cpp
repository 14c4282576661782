// SPDX-License-Identifier: MIT
//
// gnomon view as a user runs it, with scripts for hands, on both backends.
#include <gmock/gmock.h>

#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include <sys/stat.h>

#include <gnomon/window/window.hpp>

#include "tests/cli/program.hpp"
#include "tests/support/devices.hpp"
#include "tests/support/share.hpp"
#include "tests/view/png.hpp"

namespace gnomon::cli::test {
namespace {

using gnomon::test::decode_png;
using gnomon::test::difference;
using gnomon::test::Image;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

class View : public ProgramTest {
protected:
    static Arguments view(const std::string& scene, const Arguments& more) {
        return joined({"view", scene, "--size", "320x240", "--no-panel"}, more);
    }
    Arguments scripted(const std::string& scene, const std::string& script,
                       const Arguments& more = {}) const {
        write("run.input", script);
        return view(scene, joined({"--script", "run.input"}, more));
    }
    Image image(const std::string& name) const {
        Image decoded = decode_png(read(name));
        EXPECT_FALSE(decoded.rgba.empty()) << name;
        return decoded;
    }
};

class ViewOn : public View, public testing::WithParamInterface<window::Backend> {
protected:
    void SetUp() override {
        View::SetUp();
        skip_without(GetParam());
    }
    static void skip_without(window::Backend backend) {
        const std::string name(window::name_of(backend));
        const auto opened = window::Window::open({.size_px = {64, 64}, .backend = backend});
        if (!opened && gnomon::test::is_required(name)) FAIL() << opened.error().message;
        if (!opened) GTEST_SKIP() << opened.error().message;
    }
    Arguments on(const Arguments& arguments) const {
        return joined(arguments, {"--backend", std::string(window::name_of(GetParam()))});
    }
};

/// What has nothing to do with how a backend draws; of each in `make soak`.
class ViewOnce : public ViewOn {};

TEST_P(ViewOn, shows_what_render_draws) {
    const Arguments camera{"--eye", "4,3,7", "--target", "0,1,0"};
    const std::string name(window::name_of(GetParam()));
    run_well(
        on(view("builtin:pillars", joined(camera, {"--frames", "2", "--screenshot", "a.png"}))));
    EXPECT_THAT(files(), ElementsAre("a.png"));
    run_well(joined(
        {"render", "builtin:pillars", "--size", "320x240", "--out", "b.png", "--backend", name},
        camera));
    const Image shown = image("a.png");
    EXPECT_EQ(shown.width, 320U);
    EXPECT_EQ(shown.height, 240U);
    // But for the lights' handles.
    EXPECT_LT(difference(shown, image("b.png"), 1).pixels, 800U);
}

TEST_P(ViewOnce, drags_a_caster_and_the_camera) {
    const std::string before = "2 screenshot before.png\n3 screenshot again.png\n";
    run_well(on(scripted("builtin:pillars",
                         before + "4 move 160 110\n"
                                  "5 click left\n"  // selects the knot
                                  "8 tap T\n"
                                  "9 press left\n"
                                  "10 move 190 80\n"
                                  "11 release left\n"
                                  "12 tap Escape\n"
                                  "14 screenshot caster.png\n"
                                  "15 move 300 20\n"
                                  "16 tap R\n"
                                  "17 press left\n"
                                  "18 move 240 60\n"
                                  "19 release left\n"
                                  "21 screenshot camera.png\n"
                                  "22 tap L\n22 tap L\n"
                                  "24 scroll 2\n"
                                  "26 screenshot zoom.png\n",
                         {"--eye", "0,2,9", "--target", "0,1.4,0"})));
    EXPECT_EQ(difference(image("before.png"), image("again.png")).pixels, 0U);
    EXPECT_GT(difference(image("again.png"), image("caster.png"), 20).pixels, 300U);
    EXPECT_GT(difference(image("caster.png"), image("camera.png"), 20).pixels, 5000U);
    EXPECT_GT(difference(image("camera.png"), image("zoom.png"), 20).pixels, 3000U);
}

TEST_P(ViewOnce, a_script_gives_the_same_pictures_again) {
    const std::string script =
        "1 tap 2\n"
        "4 move 200 100\n"
        "5 press left\n"
        "6 move 150 130\n"
        "8 release left\n"
        "9 screenshot PICTURE.png\n";
    for (const std::string name : {"first", "second"}) {
        std::string text = script;
        text.replace(text.find("PICTURE"), 7, name);
        run_well(on(scripted("builtin:walk", text)));
    }
    EXPECT_EQ(read("first.png"), read("second.png"));
}

TEST_P(ViewOn, exchanges_the_backend_while_it_runs) {
    if (window::backends().size() < 2) GTEST_SKIP() << "There is one backend in this build.";
    skip_without(window::Backend::Gl);
    skip_without(window::Backend::Vk);
    if (IsSkipped()) return;
    // Each "backend" ends the run where the exchange fails.
    run_well(on(scripted("builtin:pillars",
                         "2 screenshot one.png\n3 tap B\n6 screenshot two.png\n"
                         "7 backend gl\n8 backend vk\n9 backend gl\n11 screenshot three.png\n",
                         {"--eye", "4,3,7", "--target", "0,1,0"})));
    // The note that names the adapter is below.
    const auto upper_part = [&](const std::string& name) {
        Image upper = image(name);
        upper.height = 200;
        upper.rgba.resize(std::size_t{4} * upper.width * upper.height);
        return upper;
    };
    EXPECT_EQ(difference(upper_part("one.png"), upper_part("two.png"), 2).pixels, 0U);
    EXPECT_EQ(difference(upper_part("one.png"), upper_part("three.png"), 2).pixels, 0U);
    EXPECT_GT(difference(image("one.png"), image("two.png"), 20).pixels, 100U) << "B: the note";
}

TEST_P(ViewOnce, takes_dropped_files_and_refuses_bad_ones) {
    write("wall.scene.json", wall_and_block());
    write("bad.glb", "this is no model");
    run_well(on(scripted("builtin:pillars",
                         "2 screenshot before.png\n"
                         "3 drop bad.glb\n"
                         "4 drop there-is-no-such-file.glb\n"
                         "6 screenshot refused.png\n"
                         "7 drop wall.scene.json\n"
                         "9 screenshot wall.png\n"
                         "10 drop builtin:pillars\n"
                         "12 screenshot back.png\n")));
    const auto upper = [&](const std::string& name) {
        Image part = image(name);
        part.height = 200;
        part.rgba.resize(std::size_t{4} * part.width * part.height);
        return part;
    };
    EXPECT_EQ(difference(upper("before.png"), upper("refused.png")).pixels, 0U);
    EXPECT_GT(difference(upper("before.png"), upper("wall.png"), 20).pixels, 5000U);
    EXPECT_EQ(difference(upper("before.png"), upper("back.png")).pixels, 0U);
}

TEST_P(ViewOn, follows_the_windows_size) {
    run_well(on(scripted("builtin:pillars",
                         "2 size 400x200\n4 screenshot wide.png\n5 size 200x260\n"
                         "7 screenshot narrow.png\n8 tap Tab\n10 screenshot panel.png\n")));
    EXPECT_EQ(image("wide.png").width, 400U);
    EXPECT_EQ(image("wide.png").height, 200U);
    EXPECT_EQ(image("narrow.png").width, 200U);
    EXPECT_EQ(image("narrow.png").height, 260U);
    EXPECT_GT(difference(image("narrow.png"), image("panel.png"), 20).pixels, 20000U);
}

TEST_P(ViewOnce, keys_do_no_harm_and_P_leaves_a_picture) {
    std::string script;
    int frame = 0;
    for (const char* key :
         {"1", "2", "3",     "4",    "5",     "6",  "Tab", "F1",  "Q", "T", "R",   "C",
          "L", "F", "Space", "Left", "Right", "F5", "P",   "Tab", "G", "G", "F11", "F11"}) {
        script += std::to_string(frame) + " tap " + key + "\n";
        ++frame;
    }
    run_well(on(scripted("builtin:walk", script, {"--screenshot", "end.png"})));
    EXPECT_THAT(files(), UnorderedElementsAre("run.input", "end.png", "gnomon-walk-1.png"));
}

TEST_P(ViewOnce, the_ground_may_go_while_it_is_held) {
    write("block.scene.json",
          R"({"primitives": [{"shape": "box", "size": [1, 1, 1], "translation": [0, 0.5, 0]}]})");
    for (const std::string mode : {"T", "R"}) {
        run_well(on(scripted("block.scene.json",
                             "0 tap " + mode +
                                 "\n"
                                 "2 move 90 180\n"
                                 "3 click left\n"  // selects it
                                 "6 screenshot before.png\n"
                                 "6 press left\n"
                                 "7 move 120 150\n"
                                 "8 screenshot held.png\n"
                                 "9 tap G\n"
                                 "10 move 130 140\n"
                                 "11 release left\n"
                                 "12 tap G\n"
                                 "13 press left\n"
                                 "14 tap G\n"
                                 "15 release left\n",
                             {"--ground", "--eye", "0,4,6", "--target", "0,0.5,0"})));
        EXPECT_GT(difference(image("before.png"), image("held.png"), 20).pixels, 1000U) << mode;
    }
}

TEST_P(ViewOnce, a_picture_of_nothing_is_refused) {
    write("run.input", "0 screenshot a.png\n");
    expect_refused(on(view("builtin:pillars", {"--quiet", "--script", "run.input"})),
                   {"a.png", "nothing has been drawn yet"});
    EXPECT_THAT(files(), ElementsAre("run.input"));
}

INSTANTIATE_TEST_SUITE_P(Backends, ViewOn, testing::ValuesIn(window::backends()),
                         [](const auto& info) { return std::string(window::name_of(info.param)); });

std::vector<window::Backend> one_backend() {
    return gnomon::test::thorough() ? window::backends() : std::vector{window::backends().front()};
}
INSTANTIATE_TEST_SUITE_P(Backends, ViewOnce, testing::ValuesIn(one_backend()),
                         [](const auto& info) { return std::string(window::name_of(info.param)); });

// There is no display to open one on, and that is not what it says.
TEST_F(View, says_what_is_wrong_before_a_window_opens) {
    struct NoDisplay {
        NoDisplay() {
            if (const char* now = std::getenv("DISPLAY")) before = now;
            unsetenv("DISPLAY");
        }
        ~NoDisplay() {
            if (before) setenv("DISPLAY", before->c_str(), 1);
        }
        std::optional<std::string> before;
    };
    const NoDisplay no_display;
    expect_refused({"view", "no-such-file.glb"}, {"no-such-file.glb"});
    expect_refused({"view", "builtin:nothing"}, {"nothing", "pillars"});
    expect_refused({"view", "builtin:knot", "--backend", "null"}, {"--backend", "null"});
    expect_refused({"view", "builtin:knot", "--frames", "0"}, {"--frames"});
    expect_refused({"view", "builtin:knot", "--silhouette", "guess"}, {"guess"});
    expect_refused({"view", "builtin:knot", "--script", "none.input"}, {"none.input"});
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    expect_refused({"view", "builtin:knot", "--script", "pipe"},
                   {"pipe: the script must be a plain file"});
    std::filesystem::remove(path("pipe"));
    expect_refused({"view", "builtin:knot", "--screenshot", "no/such/folder/a.png"}, {"folder"});
    write("bad.input", "0 move 1 2\n1 leap\n");
    expect_refused({"view", "builtin:knot", "--script", "bad.input"},
                   {"bad.input:2", "leap", "screenshot"});
    write("size.input", "0 size large\n");
    expect_refused({"view", "builtin:knot", "--quiet", "--script", "size.input"},
                   {"size.input:1", "large"});
    write("backend.input", "0 close\n1 backend glide\n");
    expect_refused({"view", "builtin:knot", "--quiet", "--script", "backend.input"},
                   {"backend.input:2", "glide"});
    write("nowhere.input", "0 close\n1 screenshot no/such/folder/a.png\n");
    expect_refused({"view", "builtin:knot", "--quiet", "--script", "nowhere.input"},
                   {"nowhere.input:2", "folder"});
    EXPECT_THAT(files(),
                UnorderedElementsAre("backend.input", "bad.input", "nowhere.input", "size.input"));
}

}  // namespace
}  // namespace gnomon::cli::test
