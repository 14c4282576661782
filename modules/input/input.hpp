// SPDX-License-Identifier: MIT
//
// Input: what keyboard, mouse, gamepad and desktop did until this frame, as plain data that can be
// stored, compared and played back (script.hpp). gnomon::window fills it from a window; a program
// that reads nothing else behaves the same in a test. It knows no window library.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace gnomon::input {

/// By their place on a US keyboard.
enum class Key : std::uint8_t {
    // clang-format off
    A, B, C, D, E, F, G, H, I, J, K, L, M, N, O, P, Q, R, S, T, U, V, W, X, Y, Z,
    Digit0, Digit1, Digit2, Digit3, Digit4, Digit5, Digit6, Digit7, Digit8, Digit9,
    F1, F2, F3, F4, F5, F6, F7, F8, F9, F10, F11, F12,
    Left, Right, Up, Down, Home, End, PageUp, PageDown,
    Space, Enter, Escape, Tab, Backspace, Insert, Delete,
    Minus, Equal, Comma, Period, Slash,
    LeftShift, RightShift, LeftControl, RightControl, LeftAlt, RightAlt,
    // clang-format on
};
inline constexpr std::size_t key_count = static_cast<std::size_t>(Key::RightAlt) + 1;

enum class MouseButton : std::uint8_t { Left, Right, Middle };
inline constexpr std::size_t mouse_button_count = 3;

/// "A", "1", "F5", "Space", "LeftShift": what scripts and help texts call it.
[[nodiscard]] std::string_view name_of(Key key);
[[nodiscard]] std::optional<Key> key_named(std::string_view name);
/// "left", "right", "middle".
[[nodiscard]] std::optional<MouseButton> mouse_button_named(std::string_view name);

inline constexpr std::size_t gamepad_button_count = 15;
/// A gamepad, in the layout of an Xbox controller.
struct Gamepad {
    glm::vec2 left_stick{0.0F};   ///< x to the right, y down; -1 .. 1, no dead zone taken out
    glm::vec2 right_stick{0.0F};  ///< likewise
    float left_trigger = 0.0F;    ///< 0 .. 1
    float right_trigger = 0.0F;
    /// a, b, x, y, left and right bumper, back, start, guide, left and right thumb, then the pad's
    /// up, right, down, left.
    std::bitset<gamepad_button_count> buttons;
    bool operator==(const Gamepad&) const = default;
};

/// Levels, which stay, and what happened since the last begin_frame().
class Input {
public:
    /// Forgets what happened; keeps what is held and where the mouse is.
    void begin_frame();

    // Events, as a window or a script reports them.
    void press(Key key);
    /// The desktop says once more that a key is held. Of one that is not, nothing.
    void repeat(Key key);
    void release(Key key);
    void press(MouseButton button);
    void release(MouseButton button);
    void move_cursor(const glm::dvec2& position_px);
    /// What the first gamepad does now, once a frame; none: none is connected. While the keyboard
    /// is another window's it is at rest, for it is that window's as well. A button that is held
    /// from then, or from before the gamepad was connected, counts once it was let go.
    void see_gamepad(const std::optional<Gamepad>& state, bool has_focus);
    /// Everything that is held is let go.
    void release_all();
    /// The keyboard is another window's now: everything that is held is let go, and focus_lost is
    /// set.
    void lose_focus();

    [[nodiscard]] bool is_down(Key key) const { return keys_down_[at(key)]; }
    /// Went down this frame; also where it was let go within the same frame.
    [[nodiscard]] bool was_pressed(Key key) const { return keys_pressed_[at(key)]; }
    /// Is held, and the desktop repeated it this frame: what steps and deletes goes on.
    [[nodiscard]] bool was_repeated(Key key) const { return keys_repeated_[at(key)]; }
    [[nodiscard]] bool is_down(MouseButton button) const { return buttons_down_[at(button)]; }
    [[nodiscard]] bool was_pressed(MouseButton button) const {
        return buttons_pressed_[at(button)];
    }
    [[nodiscard]] bool was_released(MouseButton button) const {
        return buttons_released_[at(button)];
    }
    [[nodiscard]] bool shift() const { return is_down(Key::LeftShift) || is_down(Key::RightShift); }
    [[nodiscard]] bool control() const {
        return is_down(Key::LeftControl) || is_down(Key::RightControl);
    }
    [[nodiscard]] bool alt() const { return is_down(Key::LeftAlt) || is_down(Key::RightAlt); }

    /// In pixels of the framebuffer from its upper left corner.
    [[nodiscard]] const glm::dvec2& cursor_px() const { return cursor_px_; }
    /// How far it moved this frame.
    [[nodiscard]] glm::dvec2 cursor_motion_px() const { return cursor_px_ - cursor_before_px_; }
    /// Whether anything at all happened this frame; what is merely held is nothing, a gamepad's
    /// sticks and buttons included, which are levels alone.
    [[nodiscard]] bool anything_happened() const;

    glm::dvec2 scroll{0.0};  ///< this frame's, in notches: y > 0 is away from the user
    std::u32string text;     ///< characters typed this frame
    std::vector<std::string> dropped_files;
    std::vector<std::string> commands;  ///< of a script: what only the program understands
    bool focus_lost = false;            ///< this frame
    bool redraw_requested = false;      ///< what the window showed has been lost
    bool close_requested = false;       ///< stays
    std::optional<Gamepad> gamepad;     ///< the first one, now; none: none is connected

private:
    [[nodiscard]] static std::size_t at(Key key) { return static_cast<std::size_t>(key); }
    [[nodiscard]] static std::size_t at(MouseButton button) {
        return static_cast<std::size_t>(button);
    }

    std::bitset<key_count> keys_down_, keys_pressed_, keys_repeated_;
    std::bitset<mouse_button_count> buttons_down_, buttons_pressed_, buttons_released_;
    // The gamepad's that have not been seen up with the keyboard here.
    std::bitset<gamepad_button_count> ignored_ = std::bitset<gamepad_button_count>().set();
    glm::dvec2 cursor_px_{0.0};
    glm::dvec2 cursor_before_px_{0.0};
};

}  // namespace gnomon::input
