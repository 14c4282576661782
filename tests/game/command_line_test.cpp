// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/paths.hpp"

namespace gnomon::game {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

struct Said {
    int code = 0;
    std::string out;
    std::string error;
};

Said say(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "gnomon-game");
    if (arguments.size() > 1 && std::ranges::find(arguments, "--assets") == arguments.end()) {
        arguments.insert(arguments.end(), {"--assets", GNOMON_GAME_ASSETS});
    }
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    Said said;
    said.code = run(static_cast<int>(argv.size()), argv.data());
    std::fflush(stdout);
    said.out = testing::internal::GetCapturedStdout();
    said.error = testing::internal::GetCapturedStderr();
    return said;
}

std::filesystem::path output(const char* name) {
    const std::filesystem::path folder = test::output_folder() / "game";
    std::filesystem::create_directories(folder);
    return folder / name;
}

TEST(CommandLine, lists_the_levels) {
    const Said said = say({"--list-levels"});
    EXPECT_EQ(said.code, 0);
    EXPECT_THAT(said.out, StartsWith("courtyard: The Courtyard\n"));
}

TEST(CommandLine, a_replay_says_its_hash_last) {
    const std::filesystem::path file = output("wait.replay");
    std::ofstream(file) << "gnomon-replay 1\nlevel courtyard\nticks 30\n30 0 0 s\nend\n";
    const Said said = say({"--headless", "--replay", file.string()});
    EXPECT_EQ(said.code, 0) << said.error;
    EXPECT_THAT(said.out, MatchesRegex("The Courtyard: not over after 0.50 s\nhash: "
                                       "[0-9a-f]{16}\n"));
    EXPECT_EQ(say({"--headless", "--replay", file.string()}).out, said.out);
}

TEST(CommandLine, records_even_where_no_picture_can_be_taken) {
    const std::filesystem::path file = output("waited.replay");
    const std::string text = "gnomon-replay 1\nlevel courtyard\nticks 3\n3 0 0 s\nend\n";
    std::ofstream(file) << text;
    const std::filesystem::path copy = output("copy.replay");
    std::filesystem::remove(copy);
    // A folder cannot lie in a file.
    const Said said = say({"--headless", "--replay", file.string(), "--record", copy.string(),
                           "--capture", (file / "pictures").string()});
    EXPECT_EQ(said.code, 2);
    EXPECT_THAT(said.error, HasSubstr("the folder cannot be made"));
    std::ifstream written(copy);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(written), {}), text);
}

TEST(CommandLine, captures_pictures) {
    const std::filesystem::path file = output("short.replay");
    std::ofstream(file) << "gnomon-replay 1\nlevel courtyard\nticks 5\n5 0 0 -\nend\n";
    const std::filesystem::path folder = output("pictures");
    std::filesystem::remove_all(folder);
    const Said said = say({"--headless", "--replay", file.string(), "--capture", folder.string(),
                           "--every", "2", "--size", "160x90", "--samples", "1", "--masks"});
    if (said.error.find("No backend") != std::string::npos) GTEST_SKIP() << said.error;
    EXPECT_EQ(said.code, 0) << said.error;
    for (const char* name : {"tick_000000.light0.pgm", "tick_000005.light1.pgm"}) {
        // "P5\n160 90\n255\n" and a byte a pixel.
        EXPECT_EQ(std::filesystem::file_size(folder / name), 14U + 160U * 90U) << name;
    }
    for (const char* name :
         {"tick_000000.png", "tick_000002.png", "tick_000004.png", "tick_000005.png"}) {
        EXPECT_GT(std::filesystem::file_size(folder / name), 1000U) << name;
    }
    EXPECT_THAT(said.out, HasSubstr("4 pictures in "));
}

TEST(CommandLine, tells_what_frames_took) {
    const std::filesystem::path file = output("timed.replay");
    std::ofstream(file) << "gnomon-replay 1\nlevel courtyard\nticks 5\n5 0 0 -\nend\n";
    const Said said = say(
        {"--headless", "--replay", file.string(), "--times", "--size", "160x90", "--samples", "1"});
    if (said.error.find("No backend") != std::string::npos) GTEST_SKIP() << said.error;
    EXPECT_EQ(said.code, 0) << said.error;
    EXPECT_THAT(said.out, HasSubstr("milliseconds, 5 frames"));
    for (const char* line : {"simulation and light meter  ", "shadows on the processor  ",
                             "recording and uploads  ", "frame, until the device has finished  "}) {
        const std::size_t at = said.out.find(line);
        ASSERT_NE(at, std::string::npos) << said.out;
        double median = 0.0;
        double p95 = 0.0;
        std::istringstream numbers(said.out.substr(at + std::string_view(line).size()));
        EXPECT_TRUE(numbers >> median >> p95) << said.out;
        EXPECT_GT(median, 0.0);
        EXPECT_LE(median, p95);
    }
    EXPECT_THAT(said.out, Not(HasSubstr("pictures in ")));
}

TEST(CommandLine, refuses_in_one_sentence) {
    const struct {
        std::vector<std::string> arguments;
        int code;
        const char* sentence;
    } rows[] = {
        {{"--headless"},
         2,
         "gnomon-game: --headless needs --replay FILE or --autopilot: nobody can press "
         "anything.\n"},
        {{"--headless", "--autopilot", "--replay", "x"},
         2,
         "gnomon-game: --replay and --autopilot both say what is pressed; give one of them.\n"},
        {{"--headless", "--replay", "no/such.replay"},
         2,
         "gnomon-game: no/such.replay: the recording cannot be read: No such file or directory.\n"},
        {{"--headless", "--autopilot", "--capture", "x", "--size", "12by9"},
         2,
         "gnomon-game: --size is \"12by9\", but must be two numbers from 1 to 16384 with an x "
         "between, such as 1280x720.\n"},
        {{"--headless", "--autopilot", "--samples", "4"},
         2,
         "gnomon-game: --samples is about what is drawn, by --capture DIR or --times alone; give "
         "one as well.\n"},
        {{"--headless", "--autopilot", "--size", "640x360"},
         2,
         "gnomon-game: --size is about what is drawn, by --capture DIR or --times alone; give "
         "one as well.\n"},
        {{"--headless", "--autopilot", "--masks"},
         2,
         "gnomon-game: --masks is about what --capture DIR keeps; give that as well.\n"},
        {{"--headless", "--autopilot", "--times", "--capture", "x", "--masks"},
         2,
         "gnomon-game: --masks reads every light back, which --times would count; give one of "
         "them.\n"},
        {{"--replay", "x", "--times"},
         2,
         "gnomon-game: --times is about frames drawn as fast as it goes; give --headless as "
         "well.\n"},
        {{"--headless", "--autopilot", "--frames", "3"},
         2,
         "gnomon-game: --frames is about the window, which --headless goes without.\n"},
        {{"--list-levels", "--assets", "no/such"},
         2,
         "gnomon-game: no/such/levels: the folder cannot be read.\n"},
        {{"--headless", "--autopilot", "--assets", "no/such"},
         2,
         "gnomon-game: no/such/levels: the folder cannot be read.\n"},
        {{"--replay", "x", "--level", "courtyard"},
         2,
         "gnomon-game: --level goes without --replay: a recording names its own level.\n"}};
    for (const auto& row : rows) {
        const Said said = say(row.arguments);
        EXPECT_EQ(said.code, row.code);
        EXPECT_EQ(said.error, row.sentence);
        EXPECT_EQ(said.out, "");
    }
    EXPECT_THAT(say({"--headless", "--autopilot", "--level", "moon"}).error,
                EndsWith("there are courtyard, barracks, dockyard.\n"));
}

}  // namespace
}  // namespace gnomon::game
