// SPDX-License-Identifier: MIT
#include "play/hands.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "play/pacer.hpp"
#include "play/stepper.hpp"

namespace gnomon::game {
namespace {

using input::Key;

input::Input holding(std::initializer_list<Key> keys) {
    input::Input input;
    for (const Key key : keys) input.press(key);
    return input;
}

input::Input with_pad(const input::Gamepad& pad) {
    input::Input input;
    input.gamepad = pad;
    return input;
}

input::Gamepad pressing(std::initializer_list<PadButton> buttons) {
    input::Gamepad pad;
    for (const PadButton button : buttons) pad.buttons.set(static_cast<std::size_t>(button));
    return pad;
}

input::Input with_sticks(const glm::vec2& left, const glm::vec2& right = {0.0F, 0.0F}) {
    input::Gamepad pad;
    pad.left_stick = left;
    pad.right_stick = right;
    return with_pad(pad);
}

input::Input with_triggers(float left, float right) {
    input::Gamepad pad;
    pad.left_trigger = left;
    pad.right_trigger = right;
    return with_pad(pad);
}

TEST(Hands, walk_by_letters_arrows_and_the_cross) {
    const std::pair<Key, glm::dvec2> keys[] = {
        {Key::W, {0, 1}},  {Key::S, {0, -1}},    {Key::A, {-1, 0}},    {Key::D, {1, 0}},
        {Key::Up, {0, 1}}, {Key::Down, {0, -1}}, {Key::Left, {-1, 0}}, {Key::Right, {1, 0}}};
    for (const auto& [key, way] : keys) {
        const Pad pad = pad_of(holding({key}));
        EXPECT_EQ(glm::dvec2(pad.right, pad.up), way) << input::name_of(key);
    }
    const std::pair<PadButton, glm::dvec2> cross[] = {{PadButton::Up, {0, 1}},
                                                      {PadButton::Down, {0, -1}},
                                                      {PadButton::Left, {-1, 0}},
                                                      {PadButton::Right, {1, 0}}};
    for (const auto& [button, way] : cross) {
        const Pad pad = pad_of(with_pad(pressing({button})));
        EXPECT_EQ(glm::dvec2(pad.right, pad.up), way);
    }
    const Pad both = pad_of(holding({Key::A, Key::D, Key::W, Key::Up}));
    EXPECT_EQ(both.right, 0.0) << "opposites";
    EXPECT_EQ(both.up, 1.0) << "twice the same";
}

TEST(Hands, run_and_sneak) {
    EXPECT_TRUE(pad_of(holding({Key::LeftShift})).run);
    EXPECT_TRUE(pad_of(holding({Key::RightShift})).run);
    EXPECT_TRUE(pad_of(holding({Key::LeftControl})).sneak);
    EXPECT_TRUE(pad_of(holding({Key::C})).sneak);
    EXPECT_TRUE(pad_of(with_triggers(0.0F, 0.8F)).run);
    EXPECT_TRUE(pad_of(with_triggers(0.8F, 0.0F)).sneak);
    EXPECT_TRUE(pad_of(with_pad(pressing({PadButton::B}))).sneak);
    EXPECT_TRUE(pad_of(with_pad(pressing({PadButton::A}))).run);
    const Pad rest = pad_of(with_triggers(0.1F, 0.1F));
    EXPECT_FALSE(rest.run || rest.sneak || rest.restart || rest.pause);
}

TEST(Hands, a_stick_goes_where_it_is_tilted) {
    EXPECT_EQ(input_of(pad_of(with_sticks({1.0F, 0.0F})), 0.0), (Input{.east = 127}));
    // A stick's y is down.
    EXPECT_EQ(input_of(pad_of(with_sticks({0.0F, -1.0F})), 0.0), (Input{.south = -127}));
}

TEST(Hands, a_stick_that_rests_badly_does_nothing) {
    EXPECT_EQ(input_of(pad_of(with_sticks({0.1F, -0.1F})), 0.0), Input{});
    // Nor does it lean on a key.
    input::Input input = with_sticks({0.1F, -0.1F});
    input.press(Key::W);
    EXPECT_EQ(input_of(pad_of(input), 0.0), (Input{.south = -127}));
    EXPECT_EQ(past_dead_zone({0.1F, 0.1F}), glm::dvec2(0.0));
    EXPECT_EQ(past_dead_zone({std::numeric_limits<float>::quiet_NaN(), 1.0F}), glm::dvec2(0.0));
    EXPECT_NEAR(past_dead_zone({0.575F, 0.0F}).x, 0.5, 1e-6);
    EXPECT_NEAR(past_dead_zone({0.0F, -3.0F}).y, -1.0, 1e-6);
}

TEST(Look, follows_the_mouse) {
    input::Input input;
    input.move_cursor({100.0, 50.0});
    input.begin_frame();
    input.move_cursor({130.0, 60.0});
    const CameraRig rig;
    const Look right = turned({}, rig, input, {}, tick_s);
    EXPECT_LT(right.yaw_rad, -0.05) << "a turn to the right takes the eye to the left";
    EXPECT_GT(right.pitch_rad, 0.01) << "down looks down";
    const Look quick = turned({}, rig, input, {.mouse_speed = 2.0}, tick_s);
    EXPECT_NEAR(quick.yaw_rad, 2.0 * right.yaw_rad, 1e-12);
    const Look inverted = turned({}, rig, input, {.inverted = true}, tick_s);
    EXPECT_NEAR(inverted.pitch_rad, -right.pitch_rad, 1e-12);
    EXPECT_EQ(inverted.yaw_rad, right.yaw_rad);
    const Look free = turned({}, rig, input, {.by_mouse = false}, tick_s);
    EXPECT_EQ(free.yaw_rad, 0.0);
}

TEST(Look, follows_stick_keys_and_wheel) {
    const CameraRig rig;
    EXPECT_LT(turned({}, rig, with_sticks({0.0F, 0.0F}, {1.0F, 0.0F}), {}, 0.1).yaw_rad, -0.1);
    EXPECT_EQ(turned({}, rig, with_sticks({0.0F, 0.0F}, {0.1F, 0.1F}), {}, 0.1).yaw_rad, 0.0);
    EXPECT_LT(turned({}, rig, holding({Key::E}), {}, 0.1).yaw_rad, -0.1);
    EXPECT_GT(turned({}, rig, holding({Key::Q}), {}, 0.1).yaw_rad, 0.1);
    input::Input wheel;
    wheel.scroll = {0.0, 1.0};
    EXPECT_GT(turned({}, rig, wheel, {}, tick_s).nearer, 1.05);
    wheel.scroll = {0.0, 1000.0};
    EXPECT_LT(turned({}, rig, wheel, {}, tick_s).nearer, 2.0);
    const Look away{.yaw_rad = 1.0, .pitch_rad = 0.2, .nearer = 1.3};
    const Look home = turned(away, rig, holding({Key::V}), {}, tick_s);
    EXPECT_EQ(home.yaw_rad, 0.0);
    EXPECT_EQ(home.nearer, 1.0);
}

// Beyond what the camera can do nothing piles up that would have to be undone first.
TEST(Look, stays_where_the_camera_can_go) {
    const CameraRig rig;
    Look look;
    for (int i = 0; i < 500; ++i) {
        look = turned(look, rig, with_sticks({0.0F, 0.0F}, {0.3F, 1.0F}), {}, 0.1);
    }
    EXPECT_NEAR(rig.pitch_rad + look.pitch_rad, glm::radians(85.0), 1e-9);
    EXPECT_LE(std::abs(look.yaw_rad), 3.1416);
}

TEST(Menus, understand_keys) {
    const Buttons none;
    EXPECT_EQ(menu_press(holding({Key::Down}), none), (MenuPress{.down = 1}));
    EXPECT_EQ(menu_press(holding({Key::W}), none), (MenuPress{.down = -1}));
    EXPECT_EQ(menu_press(holding({Key::D}), none), (MenuPress{.right = 1}));
    EXPECT_EQ(menu_press(holding({Key::Left}), none), (MenuPress{.right = -1}));
    EXPECT_EQ(menu_press(holding({Key::Enter}), none), (MenuPress{.accept = true}));
    EXPECT_EQ(menu_press(holding({Key::Escape}), none), (MenuPress{.back = true, .pause = true}));
    EXPECT_EQ(menu_press(holding({Key::P}), none), (MenuPress{.pause = true}));
    EXPECT_EQ(menu_press(holding({Key::R}), none), (MenuPress{.restart = true}));
    input::Input held = holding({Key::Down, Key::Enter});
    held.begin_frame();
    EXPECT_EQ(menu_press(held, none), MenuPress{}) << "held since the frame before";
    held.repeat(Key::Down);
    held.repeat(Key::Enter);
    EXPECT_EQ(menu_press(held, none), (MenuPress{.down = 1}));
}

TEST(Menus, understand_gamepads_once_a_press) {
    Buttons buttons;
    input::Input input = with_pad(pressing({PadButton::A, PadButton::Down}));
    buttons.see(input);
    EXPECT_EQ(menu_press(input, buttons), (MenuPress{.down = 1, .accept = true}));
    buttons.see(input);
    EXPECT_EQ(menu_press(input, buttons), MenuPress{});
    input = with_sticks({0.0F, -0.9F});
    buttons.see(input);
    EXPECT_EQ(menu_press(input, buttons), (MenuPress{.down = -1}));
    buttons.see(input);
    EXPECT_EQ(menu_press(input, buttons), MenuPress{});
    input = with_pad(pressing({PadButton::Start}));
    buttons.see(input);
    EXPECT_EQ(menu_press(input, buttons), (MenuPress{.pause = true}));
    input = with_pad(pressing({PadButton::B}));
    buttons.see(input);
    EXPECT_EQ(menu_press(input, buttons), (MenuPress{.back = true}));
}

TEST(Look, leaves_the_wheel_to_a_panel_that_the_mouse_is_over) {
    const CameraRig rig;
    input::Input input;
    input.begin_frame();
    input.scroll.y = 2.0;
    input.press(input::MouseButton::Middle);
    const Look before{.yaw_rad = 0.5, .nearer = 1.2};
    const Look over = turned(before, rig, input, {.by_mouse = false, .by_wheel = false}, 0.016);
    EXPECT_EQ(over.nearer, before.nearer);
    EXPECT_EQ(over.yaw_rad, before.yaw_rad);
    EXPECT_EQ(turned(before, rig, input, {}, 0.016).yaw_rad, 0.0) << "as the level does";
    input.begin_frame();
    input.scroll.y = 2.0;
    EXPECT_GT(turned(before, rig, input, {}, 0.016).nearer, before.nearer);
}

TEST(Menus, a_window_that_loses_the_keyboard_pauses_once_and_lets_go) {
    input::Input input;
    input.press(input::Key::W);
    input.begin_frame();
    input.lose_focus();
    Buttons buttons;
    buttons.see(input);
    EXPECT_EQ(menu_press(input, buttons), (MenuPress{.interrupted = true}));
    EXPECT_EQ(pad_of(input), Pad{}) << "nobody walks on";
    input.begin_frame();
    buttons.see(input);
    EXPECT_EQ(menu_press(input, buttons), MenuPress{});
}

TEST(Menus, a_gamepad_that_is_pulled_out_pauses_once) {
    Buttons buttons;
    buttons.see(input::Input());
    EXPECT_FALSE(buttons.was_lost()) << "there was none";
    buttons.see(with_pad({}));
    buttons.see(input::Input());
    EXPECT_EQ(menu_press(input::Input(), buttons), (MenuPress{.interrupted = true}));
    buttons.see(input::Input());
    EXPECT_EQ(menu_press(input::Input(), buttons), MenuPress{});
}

TEST(Steps, lose_no_time_whatever_the_frames) {
    for (const double frame_s : {1.0 / 240.0, 1.0 / 144.0, 1.0 / 75.0, 1.0 / 60.3, 1.0 / 59.94,
                                 1.0 / 50.0, 1.0 / 30.0, 1.0 / 12.0}) {
        Stepper stepper;
        std::uint32_t ticks = 0;
        double time_s = 0.0;
        for (; time_s < 30.0; time_s += frame_s) ticks += stepper.advance(frame_s);
        EXPECT_NEAR(ticks, time_s * ticks_a_second, 1.6) << frame_s;
    }
}

TEST(Steps, a_screen_that_trembles_has_a_tick_in_every_frame) {
    Stepper stepper;
    for (int i = 0; i < 600; ++i) {
        const double tremble_s = (i * 37 % 11 - 5) * 0.0003;
        ASSERT_EQ(stepper.advance(tick_s + tremble_s), 1U) << i;
    }
}

TEST(Steps, do_not_catch_up_with_what_was_slept_through) {
    Stepper stepper;
    EXPECT_EQ(stepper.advance(60.0), 6U);
    EXPECT_EQ(stepper.advance(-1.0), 0U);
    EXPECT_EQ(stepper.advance(std::numeric_limits<double>::quiet_NaN()), 0U);
    EXPECT_EQ(stepper.advance(tick_s), 1U);
}

TEST(Steps, go_at_a_speed) {
    Stepper quick(8.0);
    for (int i = 0; i < 100; ++i) ASSERT_EQ(quick.advance(tick_s), 8U);
    EXPECT_NEAR(quick.until_next_s(), tick_s, 1e-9) << "eight ticks a frame";
    Stepper slow(0.5);
    std::uint32_t ticks = 0;
    for (int i = 0; i < 100; ++i) ticks += slow.advance(tick_s);
    EXPECT_EQ(ticks, 50U);
}

/// Frames as Front::run() makes them, by a clock of the test's own.
struct Frames {
    std::vector<double> lengths_s;
    std::vector<std::uint32_t> ticks;
};
/// `drawn` says when a frame that began then has been drawn and shown.
template <class Drawn>
Frames frames_of(std::size_t count, const Drawn& drawn, double speed = 1.0) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> overslept_s(0.00002, 0.0003);
    Stepper stepper(speed);
    Frames frames;
    double begun_s = 0.0;
    double now_s = drawn(0.0);
    while (frames.ticks.size() < count) {
        const double nap = nap_s(now_s - begun_s, stepper.until_next_s());
        if (nap > 0.0) {
            now_s += nap + overslept_s(random);
            continue;
        }
        frames.lengths_s.push_back(now_s - begun_s);
        frames.ticks.push_back(stepper.advance(now_s - begun_s));
        begun_s = now_s;
        now_s = drawn(begun_s);
    }
    return frames;
}

TEST(Pace, without_a_screen_that_sets_it_is_a_tick_a_frame_as_even_as_ticks) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> work_s(0.001, 0.013);
    const Frames frames = frames_of(20000, [&](double s) { return s + work_s(random); });
    double all_s = 0.0;
    for (std::size_t i = 0; i < frames.ticks.size(); ++i) {
        ASSERT_EQ(frames.ticks[i], 1U) << i;
        ASSERT_NEAR(frames.lengths_s[i], tick_s, 0.0007) << i;
        all_s += frames.lengths_s[i];
    }
    EXPECT_NEAR(all_s, 20000.0 * tick_s, 0.001) << "what naps overrun does not add up";
}

TEST(Pace, of_a_slow_game_is_even_and_has_frames_between_its_ticks) {
    for (const double speed : {0.1, 0.35, 0.5, 0.7}) {
        std::mt19937 random(5);
        std::uniform_real_distribution<double> work_s(0.001, 0.009);
        const Frames frames = frames_of(
            2000, [&](double s) { return s + work_s(random); }, speed);
        double since_tick_s = 0.0;
        std::size_t ticks = 0;
        for (std::size_t i = 0; i < frames.ticks.size(); ++i) {
            since_tick_s += frames.lengths_s[i];
            // What trembles is made up for in the next frame.
            ASSERT_LT(frames.lengths_s[i], tick_s + 2.0 * Stepper::tremble_s) << speed << ", " << i;
            ASSERT_LE(frames.ticks[i], 1U) << speed << ", " << i;
            if (frames.ticks[i] == 0) continue;
            ASSERT_NEAR(since_tick_s, tick_s / speed, 0.0007) << speed << ", " << i;
            since_tick_s = 0.0;
            ++ticks;
        }
        EXPECT_GT(ticks, 190U) << speed;
    }
}

TEST(Pace, is_the_screens_where_that_has_about_sixty_pictures_a_second) {
    for (const double screen_hz : {59.94, 60.0, 60.05}) {
        std::mt19937 random(9);
        std::uniform_real_distribution<double> work_s(0.002, 0.009);
        std::uniform_real_distribution<double> trembles_s(0.0, 0.0004);
        const Frames frames = frames_of(6000, [&](double s) {
            const double shown = std::ceil((s + work_s(random)) * screen_hz) / screen_hz;
            return shown + trembles_s(random);
        });
        // A clock that is another one's is made up for, half a tick at a time.
        const double others = 6000.0 * std::abs(60.0 / screen_hz - 1.0);
        std::size_t uneven = 0;
        for (const std::uint32_t ticks : frames.ticks) uneven += ticks == 1 ? 0 : 1;
        EXPECT_LE(static_cast<double>(uneven), others + 2.0) << screen_hz;
    }
}

TEST(Pace, input_is_looked_at_often) {
    double since_s = 0.0;
    int naps = 0;
    for (double nap = nap_s(since_s, tick_s); nap > 0.0; nap = nap_s(since_s, tick_s)) {
        EXPECT_LE(nap, 0.0071);
        since_s += nap;
        ++naps;
    }
    EXPECT_NEAR(since_s, tick_s, 1e-9);
    EXPECT_GE(naps, 3);
    EXPECT_EQ(nap_s(0.0, std::numeric_limits<double>::quiet_NaN()), 0.0);
}

}  // namespace
}  // namespace gnomon::game
