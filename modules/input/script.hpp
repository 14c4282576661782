// SPDX-License-Identifier: MIT
//
// Script: input written down, frame by frame, so that a run with a window can be repeated exactly.
// Text, one event a line; `#` begins a comment at a line's start or after a blank:
//
//     0  move 640 360        the cursor, in pixels from the upper left corner; up to 1e6
//     2  press left          a mouse button (left, right, middle) or a key (A, 1, F5, LeftShift, …)
//     9  release left
//     12 tap Space           pressed, and let go in the next frame
//     14 click left          likewise
//     15 scroll 1            notches, away from the user; up to 1000 either way
//     20 type hello          characters; a line's end ends them
//     25 drop model.glb      a file let go over the window
//     28 unfocus            the keyboard goes to another window: what is held is let go
//     30 close
//
// Frames ascend. What else a program understands it names when it reads the script.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/input/input.hpp>

namespace gnomon::input {

class Script {
public:
    /// Whether a command, its word included, is one that the program can obey; if not, why.
    using CommandCheck = std::function<Status(std::string_view command)>;

    /// Lines whose word is among `commands` go to Input::commands as they are, once `check`, where
    /// there is one, has agreed. Fails with ErrorCode::InvalidInput, one sentence that names file,
    /// line, what is wrong and what there is.
    [[nodiscard]] static Result<Script> parse(std::string_view text, std::string_view file_name,
                                              std::span<const std::string_view> commands = {},
                                              const CommandCheck& check = {});

    /// Adds the events of `frame` to `input`, whose frame has begun. Frames are asked for in order,
    /// none left out; a Script is played once.
    void play(std::uint64_t frame, Input& input);
    /// The last frame that has an event.
    [[nodiscard]] std::uint64_t last_frame() const;

private:
    enum class Kind : std::uint8_t {
        Move,
        PressKey,
        ReleaseKey,
        PressButton,
        ReleaseButton,
        Scroll,
        Type,
        Drop,
        Unfocus,
        Close,
        Command
    };
    struct Event {
        std::uint64_t frame = 0;
        Kind kind = Kind::Move;
        Key key = Key::A;
        MouseButton button = MouseButton::Left;
        glm::dvec2 numbers{0.0};
        std::string text = {};
    };
    struct Line;
    [[nodiscard]] Status read(const Line& line, std::span<const std::string_view> commands,
                              const CommandCheck& check);
    [[nodiscard]] Status read_press(const Line& line);

    std::vector<Event> events_;  // by frame
    std::size_t next_ = 0;
};

}  // namespace gnomon::input
