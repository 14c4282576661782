// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include <gnomon/input/input.hpp>

namespace gnomon::input {

namespace {

// In the order of Key.
constexpr std::array<std::string_view, key_count> key_names{
    // clang-format off
    "A", "B", "C", "D", "E", "F", "G", "H", "I", "J", "K", "L", "M", "N", "O", "P", "Q", "R", "S",
    "T", "U", "V", "W", "X", "Y", "Z",
    "0", "1", "2", "3", "4", "5", "6", "7", "8", "9",
    "F1", "F2", "F3", "F4", "F5", "F6", "F7", "F8", "F9", "F10", "F11", "F12",
    "Left", "Right", "Up", "Down", "Home", "End", "PageUp", "PageDown",
    "Space", "Enter", "Escape", "Tab", "Backspace", "Insert", "Delete",
    "Minus", "Equal", "Comma", "Period", "Slash",
    "LeftShift", "RightShift", "LeftControl", "RightControl", "LeftAlt", "RightAlt",
    // clang-format on
};
static_assert(!key_names.back().empty());

constexpr std::array<std::string_view, mouse_button_count> button_names{"left", "right", "middle"};

}  // namespace

std::string_view name_of(Key key) { return key_names[static_cast<std::size_t>(key)]; }

std::optional<Key> key_named(std::string_view name) {
    const auto found = std::ranges::find(key_names, name);
    if (found == key_names.end()) return std::nullopt;
    return static_cast<Key>(found - key_names.begin());
}

std::optional<MouseButton> mouse_button_named(std::string_view name) {
    const auto found = std::ranges::find(button_names, name);
    if (found == button_names.end()) return std::nullopt;
    return static_cast<MouseButton>(found - button_names.begin());
}

void Input::begin_frame() {
    keys_pressed_.reset();
    keys_repeated_.reset();
    buttons_pressed_.reset();
    buttons_released_.reset();
    cursor_before_px_ = cursor_px_;
    scroll = {0.0, 0.0};
    text.clear();
    dropped_files.clear();
    commands.clear();
    focus_lost = redraw_requested = false;
}

void Input::press(Key key) {
    keys_down_.set(at(key));
    keys_pressed_.set(at(key));
}

void Input::repeat(Key key) {
    if (is_down(key)) keys_repeated_.set(at(key));
}

void Input::release(Key key) { keys_down_.reset(at(key)); }

void Input::press(MouseButton button) {
    buttons_down_.set(at(button));
    buttons_pressed_.set(at(button));
}

void Input::release(MouseButton button) {
    if (buttons_down_[at(button)]) buttons_released_.set(at(button));
    buttons_down_.reset(at(button));
}

void Input::move_cursor(const glm::dvec2& position_px) { cursor_px_ = position_px; }

void Input::see_gamepad(const std::optional<Gamepad>& state, bool has_focus) {
    gamepad = state;
    if (!state || !has_focus) {
        if (state) gamepad = Gamepad{};
        ignored_.set();
        return;
    }
    ignored_ &= state->buttons;
    gamepad->buttons &= ~ignored_;
}

void Input::release_all() {
    keys_down_.reset();
    buttons_released_ |= buttons_down_;
    buttons_down_.reset();
    ignored_.set();
}

void Input::lose_focus() {
    release_all();
    focus_lost = true;
}

bool Input::anything_happened() const {
    return keys_pressed_.any() || keys_repeated_.any() || buttons_pressed_.any() ||
           buttons_released_.any() || cursor_motion_px() != glm::dvec2(0.0) ||
           scroll != glm::dvec2(0.0) || !text.empty() || !dropped_files.empty() ||
           !commands.empty() || focus_lost || redraw_requested || close_requested;
}

}  // namespace gnomon::input
