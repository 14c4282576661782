// SPDX-License-Identifier: MIT
//
// Words: what the game says, wherever it is written: over the window's picture (pages.cpp, hud.cpp)
// or in a page of the browser's. They know nothing of letters and places.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "play/screens.hpp"
#include "play/session.hpp"
#include "play/settings.hpp"
#include "timing.hpp"

namespace gnomon::game {

namespace words {
inline constexpr std::string_view name = "GNOMON";
inline constexpr std::string_view promise = "What you see is what they see. Stay in the shadow.";
inline constexpr std::string_view first_step = "Your first step begins it";
inline constexpr std::string_view recording = "a recording";
inline constexpr std::string_view light = "light";
inline constexpr std::string_view alarm = "alarm";
}  // namespace words

/// What keys, mouse and gamepad do.
struct KeyLine {
    std::string_view keys;
    std::string_view deed;
    bool is_window = false;  ///< of the program in its window alone
};
inline constexpr std::array<KeyLine, 9> key_lines{{
    {"W A S D, arrows, left stick", "walk"},
    {"Shift, right trigger", "run: quick, and loud"},
    {"Ctrl or C, left trigger", "sneak, and duck"},
    {"mouse, Q E, right stick", "turn the camera"},
    {"wheel, bumpers", "come nearer"},
    {"R", "begin the level anew"},
    {"F1", "how the shadows are made", true},
    {"F2", "OpenGL or Vulkan", true},
    {"F11, F12", "full screen, picture", true},
}};

/// Over a screen's menu; empty for the title and while playing.
[[nodiscard]] std::string_view heading_of(Screen screen);

/// Of a line of a menu; `level`: what a line that names one calls it.
[[nodiscard]] std::string label_of(const MenuItem& item, std::string_view level);

/// `backend`: "gl", "vk", the one that draws.
[[nodiscard]] std::string value_of(Setting setting, const Settings& settings,
                                   std::string_view backend);

/// Of a level that is over: how it went.
[[nodiscard]] std::string end_of(const Session& session);

/// "1:04.5"
[[nodiscard]] std::string clock_text(Tick ticks);

}  // namespace gnomon::game
