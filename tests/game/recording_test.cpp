// SPDX-License-Identifier: MIT
#include "recording.hpp"

#include <gtest/gtest.h>

#include <ostream>

#include "assets.hpp"

namespace gnomon::game {
namespace {

Recording sample() {
    Recording recording{.level = "court-yard_2", .inputs = {}};
    recording.inputs.assign(5, {});
    recording.inputs.insert(recording.inputs.end(), 3, {.east = -127, .south = 127, .sneak = true});
    recording.inputs.push_back({.east = 1, .run = true, .restart = true, .pause = true});
    return recording;
}

TEST(Recordings, are_text_that_reads_back) {
    const std::string text = to_text(sample());
    EXPECT_EQ(text,
              "gnomon-replay 1\nlevel court-yard_2\nticks 9\n5 0 0 -\n3 -127 127 s\n1 1 0 rnp\n"
              "end\n");
    const auto back = read_recording(text, "a.replay");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(*back, sample());
    const Recording nothing{.level = "x", .inputs = {}};
    EXPECT_EQ(*read_recording(to_text(nothing), "a.replay"), nothing);
}

TEST(Recordings, may_have_another_systems_line_ends) {
    EXPECT_TRUE(read_recording("gnomon-replay 1\r\nlevel a\r\nticks 1\r\n1 0 0 -\r\nend\r\n", "f"));
}

struct Bad {
    const char* name;
    std::string text;
    std::string sentence;
};
void PrintTo(const Bad& bad, std::ostream* out) { *out << bad.name; }

class BadRecordings : public testing::TestWithParam<Bad> {};

TEST_P(BadRecordings, are_refused_in_one_sentence) {
    const auto read = read_recording(GetParam().text, "a.replay");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::InvalidInput);
    EXPECT_EQ(read.error().message, "a.replay:" + GetParam().sentence);
}

const std::string head = "gnomon-replay 1\nlevel a\nticks 4\n";

INSTANTIATE_TEST_SUITE_P(
    Texts, BadRecordings,
    testing::Values(
        Bad{"empty", "", "0: here must be \"gnomon-replay\" and a value."},
        Bad{"other_file", "{\"a\": 1}\n", "1: here must be \"gnomon-replay\" and a value."},
        Bad{"version", "gnomon-replay 2\n", "1: the version is \"2\", but this program reads 1."},
        Bad{"level", "gnomon-replay 1\nlevel ../etc\n",
            "2: the level is \"../etc\", but must be 1 to 60 letters, digits, \"-\" or \"_\"."},
        Bad{"level_that_a_terminal_obeys", "gnomon-replay 1\nlevel \x1b[2J\n",
            "2: the level is \"?[2J\", but must be 1 to 60 letters, digits, \"-\" or \"_\"."},
        Bad{"ticks", "gnomon-replay 1\nlevel a\nticks 300000\n",
            "3: ticks is \"300000\", but must be a whole number from 0 to 216000."},
        Bad{"words", head + "4 0 0\n",
            "4: the line has 3 words, but must have 4: ticks, east, south, letters."},
        Bad{"axis", head + "4 0 128 -\n",
            "4: south is \"128\", but must be a whole number from -127 to 127."},
        Bad{"no_number", head + "4 x 0 -\n",
            "4: east is \"x\", but must be a whole number from -127 to 127."},
        Bad{"letter", head + "4 0 0 sx\n",
            "4: \"sx\" is not made of the letters s, r, n and p, each at most once, nor is it -."},
        Bad{"letter_twice", head + "4 0 0 ss\n",
            "4: \"ss\" is not made of the letters s, r, n and p, each at most once, nor is it -."},
        Bad{"too_many", head + "3 0 0 -\n2 0 0 -\nend\n",
            "5: there is input for more than the 4 ticks that the recording is said to have."},
        Bad{"too_few", head + "3 0 0 -\nend\n",
            "5: there is input for 3 ticks, but the recording is said to have 4."},
        Bad{"cut_off", head + "4 0 0 -\n",
            "4: the recording breaks off; its last line must be \"end\"."},
        Bad{"more_after_the_end", head + "4 0 0 -\nend\ngnomon-replay 1\n",
            "6: here is a line after the line \"end\", but that must be the last."}),
    [](const auto& row) { return row.param.name; });

TEST(Recordings, a_file_that_is_not_there_is_named) {
    const auto read = load_recording("no/such.replay");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().message,
              "no/such.replay: the recording cannot be read: No such file or directory.");
}

}  // namespace
}  // namespace gnomon::game
