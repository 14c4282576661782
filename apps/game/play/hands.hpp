// SPDX-License-Identifier: MIT
//
// Hands: keyboard, mouse and gamepad as the game understands them. Keys by their place on a US
// keyboard. What is held becomes a Pad, what turns the camera a Look, what is pressed a MenuPress.
#pragma once

#include <bitset>

#include <glm/glm.hpp>

#include <gnomon/input/input.hpp>

#include "controls.hpp"
#include "drawing.hpp"
#include "play/screens.hpp"

namespace gnomon::game {

/// The gamepad's buttons, as input::Gamepad counts them.
enum class PadButton : std::uint8_t {
    A,
    B,
    X,
    Y,
    LeftBumper,
    RightBumper,
    Back,
    Start,
    Guide,
    LeftThumb,
    RightThumb,
    Up,
    Right,
    Down,
    Left
};

/// Arrows or W, A, S and D, the left stick or the cross: the way. Shift, A or the right trigger:
/// run. Control, C, B or the left trigger: sneak.
[[nodiscard]] Pad pad_of(const input::Input& input);

/// A stick with its dead zone taken out: 0 within it, 1 at the rim, straight between; what is not a
/// number is at rest.
[[nodiscard]] glm::dvec2 past_dead_zone(const glm::vec2& stick);

struct LookOptions {
    bool by_mouse = true;  ///< the mouse's motion turns the camera
    bool by_wheel = true;  ///< its wheel and middle button are the camera's, and not a panel's
    double mouse_speed = 1.0;
    bool inverted = false;
};

/// The mouse, Q and E, or the right stick turn; the wheel and the bumpers come nearer; V, the
/// middle button or a right stick that is pressed looks as the level does.
[[nodiscard]] Look turned(const Look& look, const CameraRig& rig, const input::Input& input,
                          const LookOptions& options, double dt_s);

/// Tells what was pressed from what is held: input::Input has only levels of gamepads.
class Buttons {
public:
    /// Once a frame.
    void see(const input::Input& input);
    [[nodiscard]] bool was_pressed(PadButton button) const {
        return pressed_[static_cast<std::size_t>(button)];
    }
    /// A gamepad that was there is gone.
    [[nodiscard]] bool was_lost() const { return lost_; }
    /// -1, 0 or 1 along each axis, y down: the stick was tilted beyond a half, which it was not.
    [[nodiscard]] const glm::ivec2& flicked() const { return flicked_; }

private:
    std::bitset<15> held_, pressed_;
    glm::ivec2 tilt_{0};
    glm::ivec2 flicked_{0};
    bool had_one_ = false;
    bool lost_ = false;
};

/// Of keys and gamepad; the mouse is for who knows where the lines of a menu are.
[[nodiscard]] MenuPress menu_press(const input::Input& input, const Buttons& buttons);

}  // namespace gnomon::game
