// SPDX-License-Identifier: MIT
#include "play/hands.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::game {

namespace {

using input::Key;
using input::MouseButton;

constexpr double radians_a_pixel = 0.0032;
constexpr double turns_a_second = 1.9;  // radians, by keys and sticks
constexpr double most_zoom = 1.7;
constexpr double least_zoom = 0.65;
constexpr float trigger_pulled = 0.3F;

bool is_held(const input::Input& input, PadButton button) {
    return input.gamepad && input.gamepad->buttons[static_cast<std::size_t>(button)];
}

double sign_of(bool plus, bool minus) { return (plus ? 1.0 : 0.0) - (minus ? 1.0 : 0.0); }

}  // namespace

glm::dvec2 past_dead_zone(const glm::vec2& stick) {
    const double tilt = std::hypot(static_cast<double>(stick.x), static_cast<double>(stick.y));
    if (!(tilt > dead_zone) || !std::isfinite(tilt)) return {0.0, 0.0};
    return glm::dvec2(stick) / tilt * ((std::min(tilt, 1.0) - dead_zone) / (1.0 - dead_zone));
}

Pad pad_of(const input::Input& input) {
    const auto down = [&](Key key) { return input.is_down(key); };
    Pad pad;
    pad.right = sign_of(down(Key::D) || down(Key::Right) || is_held(input, PadButton::Right),
                        down(Key::A) || down(Key::Left) || is_held(input, PadButton::Left));
    pad.up = sign_of(down(Key::W) || down(Key::Up) || is_held(input, PadButton::Up),
                     down(Key::S) || down(Key::Down) || is_held(input, PadButton::Down));
    pad.run = input.shift() || is_held(input, PadButton::A);
    pad.sneak = input.control() || down(Key::C) || is_held(input, PadButton::B);
    if (input.gamepad) {
        // The dead zone is input_of()'s: here it is only kept from leaning on the keys.
        const glm::vec2 stick = input.gamepad->left_stick;
        if (past_dead_zone(stick) != glm::dvec2(0.0)) {
            pad.right += static_cast<double>(stick.x);
            pad.up -= static_cast<double>(stick.y);
        }
        pad.run = pad.run || input.gamepad->right_trigger > trigger_pulled;
        pad.sneak = pad.sneak || input.gamepad->left_trigger > trigger_pulled;
    }
    return pad;
}

Look turned(const Look& look, const CameraRig& rig, const input::Input& input,
            const LookOptions& options, double dt_s) {
    const bool is_reset = input.was_pressed(Key::V) || is_held(input, PadButton::RightThumb) ||
                          (options.by_wheel && input.was_pressed(MouseButton::Middle));
    if (is_reset) return {};
    glm::dvec2 turn(0.0);  // to the right, and down
    if (options.by_mouse) {
        const glm::dvec2 motion =
            input.cursor_motion_px() * (radians_a_pixel * options.mouse_speed);
        turn += glm::dvec2(motion.x, options.inverted ? -motion.y : motion.y);
    }
    glm::dvec2 held(sign_of(input.is_down(Key::E), input.is_down(Key::Q)), 0.0);
    if (input.gamepad) held += past_dead_zone(input.gamepad->right_stick);
    turn += held * (turns_a_second * dt_s);

    Look next = look;
    // A turn to the right takes the eye round to the left; a camera that looks down stands high.
    next.yaw_rad = std::remainder(look.yaw_rad - turn.x, 2.0 * 3.14159265358979323846);
    next.pitch_rad = std::clamp(look.pitch_rad + turn.y, glm::radians(20.0) - rig.pitch_rad,
                                glm::radians(85.0) - rig.pitch_rad);
    const double closer =
        (options.by_wheel ? input.scroll.y : 0.0) +
        6.0 * dt_s *
            sign_of(is_held(input, PadButton::RightBumper), is_held(input, PadButton::LeftBumper));
    next.nearer = std::clamp(look.nearer * std::pow(1.08, closer), least_zoom, most_zoom);
    return next;
}

void Buttons::see(const input::Input& input) {
    const input::Gamepad pad = input.gamepad.value_or(input::Gamepad{});
    lost_ = had_one_ && !input.gamepad;
    had_one_ = input.gamepad.has_value();
    pressed_ = pad.buttons & ~held_;
    held_ = pad.buttons;
    const auto tilted = [](float axis) { return axis > 0.5F ? 1 : axis < -0.5F ? -1 : 0; };
    const glm::ivec2 tilt(tilted(pad.left_stick.x), tilted(pad.left_stick.y));
    flicked_ = {tilt.x == tilt_.x ? 0 : tilt.x, tilt.y == tilt_.y ? 0 : tilt.y};
    tilt_ = tilt;
}

MenuPress menu_press(const input::Input& input, const Buttons& buttons) {
    const auto stepped = [&](Key key) { return input.was_pressed(key) || input.was_repeated(key); };
    const auto pressed = [&](Key key) { return input.was_pressed(key); };
    const auto one = [](bool plus, bool minus) { return (plus ? 1 : 0) - (minus ? 1 : 0); };
    MenuPress press;
    press.down = std::clamp(
        one(stepped(Key::Down) || stepped(Key::S) || buttons.was_pressed(PadButton::Down),
            stepped(Key::Up) || stepped(Key::W) || buttons.was_pressed(PadButton::Up)) +
            buttons.flicked().y,
        -1, 1);
    press.right = std::clamp(
        one(stepped(Key::Right) || stepped(Key::D) || buttons.was_pressed(PadButton::Right),
            stepped(Key::Left) || stepped(Key::A) || buttons.was_pressed(PadButton::Left)) +
            buttons.flicked().x,
        -1, 1);
    press.accept = pressed(Key::Enter) || pressed(Key::Space) || buttons.was_pressed(PadButton::A);
    press.back =
        pressed(Key::Escape) || pressed(Key::Backspace) || buttons.was_pressed(PadButton::B);
    press.pause = pressed(Key::Escape) || pressed(Key::P) || buttons.was_pressed(PadButton::Start);
    press.interrupted = buttons.was_lost() || input.focus_lost;
    press.restart = pressed(Key::R) || buttons.was_pressed(PadButton::Back);
    return press;
}

}  // namespace gnomon::game
