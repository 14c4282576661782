// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gnomon/input/script.hpp>

#include <array>

namespace gnomon::input {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Script parsed(std::string_view text, std::span<const std::string_view> commands = {}) {
    auto script = Script::parse(text, "a.input", commands);
    EXPECT_TRUE(script) << script.error().message;
    return std::move(*script);
}

TEST(Script, plays_events_in_their_frames) {
    Script script = parsed(
        "# begins\n"
        "0 move 640 360.5\n"
        "1 press left   # and holds\n"
        "\n"
        "2 tap Space\r\n"
        "2 scroll -1.5\n"
        "3 release left\n"
        "3 drop a model.glb\n"
        "4 type h\xC3\xA9\n"
        "4 press W\n"
        "5 unfocus\n"
        "5 close");
    EXPECT_EQ(script.last_frame(), 5U);
    Input input;
    std::vector<std::string> seen;
    for (std::uint64_t frame = 0; frame <= 5; ++frame) {
        input.begin_frame();
        script.play(frame, input);
        std::string what;
        if (input.was_pressed(MouseButton::Left)) what += "left ";
        if (input.was_released(MouseButton::Left)) what += "released ";
        if (input.was_pressed(Key::Space)) what += "space ";
        if (input.is_down(Key::Space)) what += "held ";
        if (input.scroll.y != 0.0) what += "scroll ";
        if (!input.text.empty()) what += "text ";
        for (const std::string& file : input.dropped_files) what += file + " ";
        if (input.focus_lost) what += input.is_down(Key::W) ? "lost held " : "lost ";
        if (input.close_requested) what += "close ";
        seen.push_back(what);
        if (frame == 4) {
            EXPECT_EQ(input.text, U"h\u00E9");
        }
        EXPECT_EQ(input.cursor_px(), glm::dvec2(640.0, 360.5));
    }
    EXPECT_THAT(seen, ElementsAre("", "left ", "space held scroll ", "released a model.glb ",
                                  "text ", "lost close "));
}

TEST(Script, hands_a_programs_own_words_to_it) {
    constexpr std::array<std::string_view, 1> commands{"size"};
    Script script = parsed("7 size 800x600\n", commands);
    Input input;
    for (std::uint64_t frame = 0; frame <= 7; ++frame) {
        input.begin_frame();
        script.play(frame, input);
    }
    EXPECT_THAT(input.commands, ElementsAre("size 800x600"));
}

TEST(Script, a_hash_within_a_word_begins_no_comment) {
    Script script = parsed("0 drop a#1.glb # and a comment\n#1 close\n1 drop b\t#2\n");
    Input input;
    script.play(0, input);
    EXPECT_THAT(input.dropped_files, ElementsAre("a#1.glb"));
    input.begin_frame();
    script.play(1, input);
    EXPECT_THAT(input.dropped_files, ElementsAre("b"));
    EXPECT_FALSE(input.close_requested);
}

TEST(Script, a_programs_own_words_may_be_refused_with_their_line) {
    constexpr std::array<std::string_view, 1> commands{"size"};
    const auto check = [](std::string_view command) -> Status {
        if (command == "size 1x1") return {};
        return fail(ErrorCode::InvalidInput, std::string(command) + " is no size.");
    };
    EXPECT_TRUE(Script::parse("0 size 1x1", "a.input", commands, check));
    const auto refused = Script::parse("0 size 1x1\n2 size big", "a.input", commands, check);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::InvalidInput);
    EXPECT_EQ(refused.error().message, "a.input:2: size big is no size.");
}

TEST(Script, says_what_is_wrong_and_where) {
    const auto message = [](std::string_view text) {
        const auto script = Script::parse(text, "a.input");
        EXPECT_FALSE(script) << text;
        if (script) return std::string();
        EXPECT_EQ(script.error().code, ErrorCode::InvalidInput);
        return script.error().message;
    };
    EXPECT_EQ(message("0 close\n\nx close"), "a.input:3: \"x\" is no frame from 0 to 1000000.");
    EXPECT_EQ(message("3 close\n2 close"), "a.input:2: frame 2 comes after frame 3.");
    EXPECT_THAT(message("0 jump 3"), HasSubstr("there is no event \"jump\"; there are move, "));
    EXPECT_EQ(message("0 move 3"), "a.input:1: move takes two numbers, not \"3\".");
    EXPECT_EQ(message("0 move 3 nan"), "a.input:1: move takes two numbers, not \"3 nan\".");
    EXPECT_EQ(message("0 move 3 -1000001"),
              "a.input:1: move to \"3 -1000001\": each is at most 1000000 pixels from 0.");
    EXPECT_EQ(message("0 scroll -1001"),
              "a.input:1: scroll by \"-1001\": at most 1000 notches either way.");
    EXPECT_TRUE(Script::parse("0 move -1e6 1e6\n0 scroll 1000", "a.input"));
    EXPECT_THAT(message("0 press spacebar"), HasSubstr("\"spacebar\" is neither"));
    EXPECT_EQ(message("0 drop"), "a.input:1: drop what?");
    EXPECT_THAT(message("1000001 close"), HasSubstr("no frame"));
}

}  // namespace
}  // namespace gnomon::input
