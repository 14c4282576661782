// SPDX-License-Identifier: MIT
//
// gnomon-game as a user runs it, with scripts for hands, in windows of both backends.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <sys/stat.h>

#include <fmt/format.h>

#include <gnomon/window/window.hpp>

#include "assets.hpp"
#include "headless.hpp"
#include "play/settings_file.hpp"
#include "recording.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/devices.hpp"
#include "tests/support/share.hpp"
#include "tests/view/png.hpp"

namespace gnomon::game {
namespace {

using cli::test::Arguments;
using cli::test::joined;
using gnomon::test::decode_png;
using gnomon::test::difference;
using gnomon::test::Image;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

/// What a headless run ends with; each is played once.
std::string hash_line_of(const std::filesystem::path& file, const std::filesystem::path& assets) {
    static std::map<std::filesystem::path, std::string> known;
    if (const auto found = known.find(file); found != known.end()) return found->second;
    const auto recording = load_recording(file);
    if (!recording) return recording.error().message;
    const auto level = load_named_level(assets, recording->level);
    if (!level) return level.error().message;
    const auto ended = play(*level, *recording);
    if (!ended) return ended.error().message;
    return known[file] = fmt::format("hash: {:016x}\n", ended->hash);
}

/// A line of the script's command "report".
struct Report {
    std::string backend;
    std::uint64_t objects = 0;
    std::uint64_t held_bytes = 0;
    std::uint64_t resident_bytes = 0;
};
std::vector<Report> reports_in(const std::string& output) {
    std::vector<Report> reports;
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("report: ")) continue;
        std::ranges::replace(line, ',', ' ');
        std::istringstream words(line);
        Report report;
        std::string word;
        words >> word >> word >> word >> report.backend >> report.objects >> word >> word >>
            report.held_bytes >> word >> word >> report.resident_bytes;
        EXPECT_TRUE(words) << line;
        reports.push_back(report);
    }
    return reports;
}
std::vector<Report> of(const std::string& backend, const std::vector<Report>& reports) {
    std::vector<Report> some;
    std::ranges::copy_if(reports, std::back_inserter(some),
                         [&](const Report& report) { return report.backend == backend; });
    return some;
}

/// What the game holds does not grow; of drivers, a little stays with each device that went.
void expect_steady(const Report& before, const Report& after, std::size_t devices) {
    constexpr std::int64_t mib = 1 << 20;
    const auto grown = [](std::uint64_t from, std::uint64_t to) {
        return static_cast<std::int64_t>(to) - static_cast<std::int64_t>(from);
    };
    EXPECT_LT(grown(before.held_bytes, after.held_bytes), 4 * mib);
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return;  // what is freed stays for a while
#endif
    EXPECT_LT(grown(before.resident_bytes, after.resident_bytes),
              16 * mib + static_cast<std::int64_t>(devices) * mib);
}

/// A level's own recording, a walk of ten seconds at random, each ended by a restart, and so on.
Recording long_play(const std::string& level, std::size_t ticks, std::uint32_t seed) {
    Recording winning = gnomon::test::must(
        load_recording(std::string(GNOMON_GAME_ASSETS) + "/recordings/" + level + ".replay"));
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> axis(-127, 127);
    Recording play{.level = level, .inputs = {}};
    while (play.inputs.size() < ticks) {
        for (int i = 0; i < 20; ++i) {
            const Input step{.east = static_cast<std::int8_t>(axis(random)),
                             .south = static_cast<std::int8_t>(axis(random)),
                             .sneak = i % 5 == 1,
                             .run = i % 3 == 2};
            play.inputs.insert(play.inputs.end(), 30, step);
        }
        play.inputs.push_back({.restart = true});
        play.inputs.insert(play.inputs.end(), winning.inputs.begin(), winning.inputs.end());
        play.inputs.push_back({.restart = true});
    }
    play.inputs.resize(ticks);
    return play;
}

class GameWindow : public cli::test::ProgramTest {
protected:
    void SetUp() override {
        ProgramTest::SetUp();
        // What is remembered here is this test's.
        setenv("XDG_CONFIG_HOME", path("config").c_str(), 1);
    }
    [[nodiscard]] std::filesystem::path settings_file() const {
        return path("config") / "gnomon" / "game.json";
    }
    /// Small and plain.
    static Arguments small(const Arguments& more) {
        return joined({"--size", "180x120", "--samples", "1"}, more);
    }
    Arguments scripted(const std::string& script, const Arguments& more) const {
        write("run.input", script);
        return small(joined({"--script", "run.input"}, more));
    }
    /// Two levels: one that is won by a step to the north, one in which the sun catches.
    Arguments in_two_levels(const Arguments& more) const {
        std::filesystem::create_directories(path("two/levels"));
        const std::string common =
            R"("format": "gnomon-level 1", "size_m": [12, 10], "player": {"at": [0, 0]}, )";
        write("two/levels/a-near.json",
              "{" + common + R"("name": "Near", "exit": {"at": [0, -2], "half_m": [1, 1]}})");
        write(
            "two/levels/b-noon.json",
            "{" + common +
                R"("name": "Noon", "exit": {"at": [5, 4]}, "sun": {"from_deg": [0, 80], "lux": 90}, "caught_after_s": 0.3})");
        return joined({"--assets", "two"}, more);
    }
    Image image(const std::string& name) const {
        Image decoded = decode_png(read(name));
        EXPECT_FALSE(decoded.rgba.empty()) << name;
        return decoded;
    }
    std::size_t changed_pixels(const std::string& a, const std::string& b) const {
        return difference(image(a), image(b), 12).pixels;
    }
};

class GameWindowOn : public GameWindow, public testing::WithParamInterface<window::Backend> {
protected:
    void SetUp() override {
        GameWindow::SetUp();
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
class GameWindowOnce : public GameWindowOn {};

TEST_P(GameWindowOn, wins_every_level_with_the_hash_of_no_window_and_every_windows_masks) {
    using Masks = std::map<std::string, std::string>;  // by the file's name
    static std::map<std::string, Masks> first;         // of a level
    const std::string assets = GNOMON_GAME_ASSETS;
    const auto names = level_names(assets);
    ASSERT_TRUE(names);
    for (const std::string& name : *names) {
        const std::string file = assets + "/recordings/" + name + ".replay";
        const auto ran = run_well(
            on(scripted("0 move 9 9\n", {"--assets", assets, "--replay", file, "--speed", "100",
                                         "--capture", name, "--masks", "--every", "350"})));
        EXPECT_THAT(ran.output,
                    AllOf(HasSubstr(": won after "), EndsWith(hash_line_of(file, assets))))
            << name;
        Masks masks;
        std::size_t covered = 0;
        for (const auto& entry : std::filesystem::directory_iterator(path(name))) {
            if (entry.path().extension() != ".pgm") continue;
            const std::string mask = entry.path().filename().string();
            covered += read_mask(name + "/" + mask).covered();
            masks[mask] = read(name + "/" + mask);
        }
        EXPECT_TRUE(masks.contains("tick_000000.light1.pgm")) << name;
        EXPECT_TRUE(masks.contains("tick_000350.light1.pgm")) << name;
        EXPECT_GT(covered, 1000U) << name;
        const auto [known, is_first] = first.emplace(name, masks);
        EXPECT_TRUE(is_first || masks == known->second) << name;
    }
}

TEST_P(GameWindowOn, the_clocks_frames_change_no_hash) {
    write("wait.replay", "gnomon-replay 1\nlevel a-near\nticks 60\n30 90 0 -\n30 0 -90 s\nend\n");
    const auto ran =
        run_well(on(small(in_two_levels({"--replay", "wait.replay", "--speed", "8"}))));
    EXPECT_THAT(ran.output, EndsWith(hash_line_of(path("wait.replay"), path("two"))));
}

// A hundred times in `make soak`. Frames between: each backend draws.
TEST_P(GameWindowOn, a_backend_that_is_exchanged_changes_no_hash_and_leaves_nothing_behind) {
    if (window::backends().size() < 2) GTEST_SKIP() << "There is one backend in this build.";
    skip_without(window::Backend::Gl);
    skip_without(window::Backend::Vk);
    if (IsSkipped()) return;
    longest_run_s_ = 1200;
    const int exchanges = gnomon::test::thorough() ? 100 : 4;
    const bool from_gl = GetParam() == window::Backend::Gl;
    std::string script = "2 report\n";
    for (int i = 0; i < exchanges; ++i) {
        const int frame = 3 + 2 * i;
        // By hand, and by a command that ends the run where the exchange fails.
        script +=
            i < 2 ? fmt::format("{} tap F2\n", frame)
                  : fmt::format("{} backend {}\n", frame, (i % 2 == 0) == from_gl ? "vk" : "gl");
        script += fmt::format("{} report\n", frame + 1);
    }
    const int ticks = 2 * exchanges + 4;
    write("walk.replay",
          fmt::format("gnomon-replay 1\nlevel a-near\nticks {0}\n{0} 2 1 -\nend\n", ticks));
    const auto ran = run_well(on(scripted(script, in_two_levels({"--replay", "walk.replay"}))));
    EXPECT_THAT(ran.output, EndsWith(hash_line_of(path("walk.replay"), path("two"))));
    const std::vector<Report> reports = reports_in(ran.output);
    ASSERT_EQ(reports.size(), static_cast<std::size_t>(exchanges) + 1);
    for (const std::string backend : {"gl", "vk"}) {
        const std::vector<Report> own = of(backend, reports);
        ASSERT_GE(own.size(), 2U) << backend;
        EXPECT_GT(own.front().objects, 20U);
        for (const Report& report : own) {
            EXPECT_EQ(report.objects, own.front().objects) << backend;
        }
        // What is loaded and cached once is there after some.
        if (gnomon::test::thorough()) {
            expect_steady(own[own.size() / 5], own.back(), own.size() - 1 - own.size() / 5);
        }
    }
}

TEST_P(GameWindowOn, plays_for_long_at_ten_times_the_speed_in_steady_memory) {
    longest_run_s_ = 3000;
    const std::string level = GetParam() == window::Backend::Gl ? "courtyard" : "dockyard";
    const std::size_t ticks = gnomon::test::thorough() ? 10U * 60U * 60U : 10U * 60U;
    write("long.replay", to_text(long_play(level, ticks, 7)));
    std::string script;
    const std::size_t frames = ticks / 10;
    for (std::size_t i = 1; i <= 10; ++i) script += fmt::format("{} report\n", frames * i / 10 - 1);
    const std::string assets = GNOMON_GAME_ASSETS;
    const auto ran = run_well(
        on(scripted(script, {"--assets", assets, "--replay", "long.replay", "--speed", "10"})));
    EXPECT_THAT(ran.output, EndsWith(hash_line_of(path("long.replay"), assets)));
    const std::vector<Report> reports = reports_in(ran.output);
    ASSERT_EQ(reports.size(), 10U);
    // Buffers come when they are first needed.
    for (const Report& report : reports) {
        EXPECT_LE(report.objects, reports.back().objects);
        EXPECT_GE(report.objects + 4, reports.back().objects);
    }
    expect_steady(reports[1], reports.back(), 0);
}

TEST_P(GameWindowOnce, records_what_is_played_but_not_what_is_paused) {
    // The title, the level, a pause of twenty frames, the level anew, and on.
    run_well(on(scripted(
        "1 screenshot title.png\n"
        "2 tap Enter\n"
        "3 screenshot begun.png\n"
        "4 press D\n"
        "24 screenshot walked.png\n"
        "25 unfocus\n"  // which pauses, and lets go of D
        "27 screenshot paused.png\n"
        "44 press D\n"
        "45 tap Escape\n"
        "50 tap R\n"
        "51 release D\n"
        "60 close\n",
        in_two_levels({"--record", "mine.replay", "--capture", "pictures", "--every", "1"}))));
    EXPECT_GT(changed_pixels("title.png", "begun.png"), 1500U);
    EXPECT_GT(changed_pixels("begun.png", "walked.png"), 100U);
    EXPECT_GT(changed_pixels("walked.png", "paused.png"), 1500U);
    const auto recording = load_recording(path("mine.replay"));
    ASSERT_TRUE(recording) << recording.error().message;
    EXPECT_EQ(recording->level, "a-near");
    EXPECT_GT(recording->inputs[4].east, 100);
    std::size_t restarts = 0;
    for (const Input& input : recording->inputs) restarts += input.restart ? 1 : 0;
    EXPECT_EQ(restarts, 1U);
    // From the first step in frame 4 to 24, from 45 to 49, and the restart, after which D is held.
    EXPECT_NEAR(static_cast<double>(recording->inputs.size()), 21.0 + 5.0 + 2.0 + 9.0, 2.0);
    // Each tick has its picture, the restart's included.
    for (std::size_t place = 0; place <= recording->inputs.size(); ++place) {
        EXPECT_TRUE(std::filesystem::exists(path(fmt::format("pictures/tick_{:06}.png", place))))
            << place;
    }
    const auto again =
        run_well(on(scripted("0 move 1 1\n", in_two_levels({"--replay", "mine.replay"}))));
    EXPECT_THAT(again.output, EndsWith(hash_line_of(path("mine.replay"), path("two"))));
}

TEST_P(GameWindowOnce, is_won_and_lost_and_remembers_what_was_won) {
    run_well(
        on(scripted("1 screenshot title.png\n"
                    "2 tap Enter\n"
                    "3 press W\n"
                    "45 screenshot won.png\n"
                    "46 release W\n"
                    "47 tap Enter\n"  // the next one
                    "49 tap C\n"      // the first step: only now time goes on
                    "54 screenshot noon.png\n"
                    "90 screenshot caught.png\n"
                    "91 tap Enter\n"  // once more
                    "95 screenshot again.png\n"
                    "96 tap Escape\n97 tap Up\n98 tap Enter\n"  // to the title
                    "100 screenshot marked.png\n",
                    in_two_levels({}))));
    EXPECT_GT(changed_pixels("title.png", "won.png"), 1500U);
    EXPECT_GT(changed_pixels("won.png", "noon.png"), 1500U);
    EXPECT_GT(changed_pixels("noon.png", "caught.png"), 1500U);
    EXPECT_GT(changed_pixels("caught.png", "again.png"), 1500U);
    EXPECT_GT(changed_pixels("again.png", "marked.png"), 1500U);
    const LoadedSettings remembered = load_settings(settings_file());
    EXPECT_EQ(remembered.complaint, "");
    EXPECT_THAT(remembered.settings.won, testing::ElementsAre("a-near"));
}

TEST_P(GameWindowOnce, settings_are_kept_where_they_were_changed) {
    const std::string to_scale =
        "1 tap Up\n2 tap Up\n3 tap Enter\n"  // Quit, Settings, opened
        "4 tap Down\n5 tap Down\n6 tap Down\n7 tap Left\n8 tap Left\n"
        "9 screenshot settings.png\n10 tap Escape\n12 screenshot smaller.png\n";
    run_well(on(scripted(to_scale, in_two_levels({}))));
    EXPECT_EQ(load_settings(settings_file()).settings.scale_percent, 80U);
    EXPECT_EQ(image("smaller.png").width, 144U);
    EXPECT_EQ(image("smaller.png").height, 96U);
    // The next game begins with them.
    run_well(on(scripted("1 screenshot next.png\n", in_two_levels({}))));
    EXPECT_EQ(image("next.png").width, 144U);
}

TEST_P(GameWindowOnce, a_broken_file_of_settings_stays_until_somebody_saves) {
    const std::string broken = R"({"format": "gnomon-game-settings 1", "samples": 3})";
    std::filesystem::create_directories(settings_file().parent_path());
    write("config/gnomon/game.json", broken);
    // The level is won, which would be remembered.
    const auto won = run(on(scripted("1 tap Enter\n2 press W\n45 close\n", in_two_levels({}))));
    EXPECT_EQ(won.exit_code, 0);
    EXPECT_THAT(won.errors, AllOf(StartsWith("gnomon-game: "),
                                  EndsWith("samples is 3, but must be 1 or 4.\n")));
    EXPECT_EQ(read("config/gnomon/game.json"), broken);
    // Looking at the settings changes nothing; changing them does.
    const std::string open = "1 tap Up\n2 tap Up\n3 tap Enter\n";
    EXPECT_EQ(run(on(scripted(open + "5 tap Escape\n", in_two_levels({})))).exit_code, 0);
    EXPECT_EQ(read("config/gnomon/game.json"), broken);
    EXPECT_EQ(run(on(scripted(open + "4 tap Up\n5 tap Up\n6 tap Enter\n7 tap Escape\n",
                              in_two_levels({}))))
                  .exit_code,
              0);
    EXPECT_TRUE(load_settings(settings_file()).settings.mouse_inverted);
}

TEST_P(GameWindowOn, follows_the_windows_size_and_captures) {
    write("short.replay", "gnomon-replay 1\nlevel a-near\nticks 9\n9 0 0 s\nend\n");
    run_well(on(scripted(
        "2 size 400x200\n4 screenshot wide.png\n5 size 200x260\n"
        "7 screenshot narrow.png\n",
        in_two_levels({"--replay", "short.replay", "--capture", "pictures", "--every", "4"}))));
    EXPECT_EQ(image("wide.png").width, 400U);
    EXPECT_EQ(image("narrow.png").height, 260U);
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path("pictures"))) {
        names.push_back(entry.path().filename().string());
    }
    EXPECT_THAT(names, testing::UnorderedElementsAre("tick_000000.png", "tick_000004.png",
                                                     "tick_000008.png", "tick_000009.png"));
}

TEST_P(GameWindowOnce, keys_do_no_harm) {
    std::string script = "0 tap Enter\n";
    int frame = 2;
    for (const char* key :
         {"F1",    "1",    "2",     "3",    "4",      "5",      "6", "V",    "F12",
          "Q",     "E",    "C",     "F11",  "F11",    "F1",     "P", "Down", "Down",
          "Enter", "Down", "Right", "Left", "Escape", "Escape", "R", "Space"}) {
        script += fmt::format("{} tap {}\n", frame++, key);
    }
    script += fmt::format("{} move 20 20\n{} press right\n{} move 90 40\n{} scroll 2\n", frame,
                          frame + 1, frame + 2, frame + 3);
    run_well(on(scripted(script, in_two_levels({"--screenshot", "end.png"}))));
    EXPECT_EQ(image("end.png").width, 180U);
    EXPECT_EQ(image("gnomon-game-1.png").width, 180U);
}

INSTANTIATE_TEST_SUITE_P(Backends, GameWindowOn, testing::ValuesIn(window::backends()),
                         [](const auto& info) { return std::string(window::name_of(info.param)); });

std::vector<window::Backend> one_backend() {
    return gnomon::test::thorough() ? window::backends() : std::vector{window::backends().front()};
}
INSTANTIATE_TEST_SUITE_P(Backends, GameWindowOnce, testing::ValuesIn(one_backend()),
                         [](const auto& info) { return std::string(window::name_of(info.param)); });

// There is no display to open one on, and that is not what it says.
TEST_F(GameWindow, says_what_is_wrong_before_a_window_opens) {
    const std::optional<std::string> display = [] {
        const char* now = std::getenv("DISPLAY");
        return now != nullptr ? std::optional<std::string>(now) : std::nullopt;
    }();
    unsetenv("DISPLAY");
    write("bad.input", "0 move 1 2\n1 leap\n");
    write("size.input", "0 size large\n");
    write("moon.replay", "gnomon-replay 1\nlevel moon\nticks 1\n1 0 0 -\nend\n");
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    const std::pair<Arguments, std::vector<std::string>> rows[] = {
        {{"--script", "pipe"}, {"pipe: the script must be a plain file"}},
        {{"--replay", "pipe"}, {"pipe: the recording must be a plain file"}},
        {{"--masks"}, {"--masks", "--capture"}},
        {{"--level", "moon"}, {"moon", "a-near, b-noon"}},
        {{"--speed", "nan"}, {"--speed must be a number from 0.1 to 100."}},
        {{"--replay", "moon.replay"}, {"moon", "a-near, b-noon"}},
        {{"--replay", "none.replay"}, {"none.replay"}},
        {{"--script", "none.input"}, {"none.input"}},
        {{"--script", "bad.input"}, {"bad.input:2", "leap", "screenshot"}},
        {{"--script", "size.input"}, {"size.input:1", "large"}},
        {{"--screenshot", "no/such/folder/a.png"}, {"folder"}},
        {{"--record", "no/such/folder/a.replay"}, {"folder"}},
        {{"--speed", "2"}, {"--speed", "--replay"}},
        {{"--backend", "null"}, {"null"}},
        {{"--size", "9by9"}, {"9by9"}},
        {{"--frames", "0"}, {"--frames"}}};
    for (const auto& [arguments, parts] : rows) {
        SCOPED_TRACE(testing::PrintToString(arguments));
        const auto ran = run(in_two_levels(arguments));
        EXPECT_EQ(ran.exit_code, 2) << ran.errors;
        EXPECT_EQ(std::count(ran.errors.begin(), ran.errors.end(), '\n'), 1) << ran.errors;
        EXPECT_THAT(ran.errors, AllOf(StartsWith("gnomon-game: "), EndsWith(".\n")));
        for (const std::string& part : parts) EXPECT_THAT(ran.errors, HasSubstr(part));
    }
    ASSERT_EQ(::mkfifo(path("two/levels/c-pipe.json").c_str(), 0600), 0);
    const auto ran = run({"--assets", "two"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_THAT(ran.errors, HasSubstr("c-pipe.json: the level must be a plain file"));
    if (display) setenv("DISPLAY", display->c_str(), 1);
}

}  // namespace
}  // namespace gnomon::game
