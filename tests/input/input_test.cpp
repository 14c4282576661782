// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <gnomon/input/input.hpp>

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <set>

namespace gnomon::input {
namespace {

TEST(Input, a_press_is_an_event_once_and_a_level_until_released) {
    Input input;
    input.begin_frame();
    input.press(Key::W);
    EXPECT_TRUE(input.was_pressed(Key::W));
    EXPECT_TRUE(input.is_down(Key::W));
    input.begin_frame();
    EXPECT_FALSE(input.was_pressed(Key::W));
    EXPECT_TRUE(input.is_down(Key::W));
    input.release(Key::W);
    EXPECT_FALSE(input.is_down(Key::W));
}

TEST(Input, a_repeat_is_no_press) {
    Input input;
    input.begin_frame();
    input.repeat(Key::Left);
    EXPECT_FALSE(input.anything_happened()) << "it is not held";
    input.press(Key::Left);
    EXPECT_FALSE(input.was_repeated(Key::Left));
    input.begin_frame();
    input.repeat(Key::Left);
    EXPECT_TRUE(input.was_repeated(Key::Left));
    EXPECT_FALSE(input.was_pressed(Key::Left));
    EXPECT_TRUE(input.anything_happened());
    input.begin_frame();
    EXPECT_FALSE(input.was_repeated(Key::Left));
    EXPECT_TRUE(input.is_down(Key::Left));
}

TEST(Input, a_click_within_one_frame_is_seen) {
    Input input;
    input.begin_frame();
    input.press(MouseButton::Left);
    input.release(MouseButton::Left);
    EXPECT_TRUE(input.was_pressed(MouseButton::Left));
    EXPECT_TRUE(input.was_released(MouseButton::Left));
    EXPECT_FALSE(input.is_down(MouseButton::Left));
}

TEST(Input, motion_is_this_frames) {
    Input input;
    input.move_cursor({10.0, 20.0});
    input.begin_frame();
    EXPECT_FALSE(input.anything_happened());
    input.move_cursor({13.0, 16.0});
    EXPECT_EQ(input.cursor_motion_px(), glm::dvec2(3.0, -4.0));
    EXPECT_TRUE(input.anything_happened());
    input.begin_frame();
    EXPECT_EQ(input.cursor_motion_px(), glm::dvec2(0.0));
    EXPECT_EQ(input.cursor_px(), glm::dvec2(13.0, 16.0));
}

TEST(Input, a_window_without_the_keyboard_holds_nothing) {
    Input input;
    input.press(Key::LeftShift);
    input.press(MouseButton::Right);
    input.begin_frame();
    EXPECT_FALSE(input.focus_lost);
    input.lose_focus();
    EXPECT_TRUE(input.focus_lost);
    EXPECT_TRUE(input.anything_happened());
    EXPECT_FALSE(input.shift());
    EXPECT_FALSE(input.is_down(MouseButton::Right));
    EXPECT_TRUE(input.was_released(MouseButton::Right));
    EXPECT_FALSE(input.was_released(MouseButton::Left));
    input.begin_frame();
    EXPECT_FALSE(input.focus_lost);
    EXPECT_FALSE(input.anything_happened());
}

Gamepad pad_with(std::initializer_list<std::size_t> buttons) {
    Gamepad pad;
    pad.left_stick = {0.5F, -1.0F};
    pad.right_trigger = 1.0F;
    for (const std::size_t button : buttons) pad.buttons.set(button);
    return pad;
}

TEST(Input, a_gamepad_is_at_rest_while_the_keyboard_is_anothers) {
    Input input;
    input.see_gamepad(pad_with({}), true);
    input.see_gamepad(pad_with({0, 7}), true);
    EXPECT_EQ(input.gamepad, pad_with({0, 7}));
    input.see_gamepad(pad_with({0, 6}), false);
    EXPECT_EQ(input.gamepad, Gamepad{}) << "it is there";
    input.see_gamepad(std::nullopt, false);
    EXPECT_FALSE(input.gamepad) << "it was pulled out";
}

TEST(Input, a_gamepads_button_that_is_held_when_the_keyboard_comes_back_presses_nothing) {
    Input input;
    input.see_gamepad(pad_with({0}), true);
    EXPECT_EQ(input.gamepad, pad_with({})) << "from before there was a window";
    input.see_gamepad(pad_with({}), true);
    input.see_gamepad(pad_with({0}), true);
    EXPECT_EQ(input.gamepad, pad_with({0}));
    input.see_gamepad(pad_with({0, 1}), false);
    input.see_gamepad(pad_with({0, 1}), true);
    EXPECT_EQ(input.gamepad, pad_with({})) << "but the sticks are as they are";
    input.see_gamepad(pad_with({1, 2}), true);
    EXPECT_EQ(input.gamepad, pad_with({2})) << "of 1 nobody has let go";
    input.see_gamepad(pad_with({0, 2}), true);
    EXPECT_EQ(input.gamepad, pad_with({0, 2}));
    // Away and back between two frames.
    input.lose_focus();
    input.see_gamepad(pad_with({0}), true);
    EXPECT_EQ(input.gamepad, pad_with({}));
    // It is pulled out and put in again.
    input.see_gamepad(std::nullopt, true);
    input.see_gamepad(pad_with({0, 3}), true);
    EXPECT_EQ(input.gamepad, pad_with({}));
    input.see_gamepad(pad_with({}), true);
    input.see_gamepad(pad_with({0}), true);
    EXPECT_EQ(input.gamepad, pad_with({0}));
}

TEST(Input, what_is_let_go_at_once_lost_no_keyboard) {
    Input input;
    input.press(Key::W);
    input.begin_frame();
    input.release_all();
    EXPECT_FALSE(input.is_down(Key::W));
    EXPECT_FALSE(input.focus_lost);
}

TEST(Input, every_key_has_a_name_of_its_own) {
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < key_count; ++i) {
        const auto key = static_cast<Key>(i);
        ASSERT_FALSE(name_of(key).empty()) << i;
        EXPECT_TRUE(names.insert(name_of(key)).second) << name_of(key);
        EXPECT_EQ(key_named(name_of(key)), key);
    }
    EXPECT_EQ(name_of(Key::Digit7), "7");
    EXPECT_EQ(name_of(Key::F12), "F12");
    EXPECT_EQ(name_of(Key::RightAlt), "RightAlt");
    EXPECT_FALSE(key_named("w"));
}

}  // namespace
}  // namespace gnomon::input
