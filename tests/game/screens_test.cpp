// SPDX-License-Identifier: MIT
#include "play/screens.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace gnomon::game {
namespace {

using Kind = MenuItem::Kind;
using Deed = Order::Kind;

const MenuPress accept{.accept = true};
const MenuPress back{.back = true};
const MenuPress down{.down = 1};
const MenuPress up{.down = -1};
// Escape is both, as the keyboard has it.
const MenuPress escape{.back = true, .pause = true};

/// Goes down to the first line of a kind.
void choose(Screens& screens, Kind kind) {
    for (std::size_t i = 0; i < screens.items().size(); ++i) {
        if (screens.items()[screens.selected()].kind == kind) return;
        EXPECT_EQ(screens.press(down), Order{});
    }
    ADD_FAILURE() << "no such line";
}

TEST(Screens, begin_with_a_title_that_has_all_levels) {
    const Screens screens({.levels = 3});
    EXPECT_EQ(screens.now(), Screen::Title);
    ASSERT_EQ(screens.items().size(), 5U);
    EXPECT_EQ(screens.items()[2], (MenuItem{Kind::Level, 2}));
    EXPECT_EQ(screens.items()[3].kind, Kind::Settings);
    EXPECT_EQ(screens.items()[4].kind, Kind::Quit);
    EXPECT_EQ(screens.selected(), 0U);
}

TEST(Screens, go_round_at_both_ends_of_a_menu) {
    Screens screens({.levels = 3});
    EXPECT_EQ(screens.press(up), Order{});
    EXPECT_EQ(screens.selected(), 4U);
    EXPECT_EQ(screens.press(down), Order{});
    EXPECT_EQ(screens.selected(), 0U);
}

TEST(Screens, begin_the_level_that_is_chosen) {
    Screens screens({.levels = 3});
    EXPECT_EQ(screens.press(down), Order{});
    EXPECT_EQ(screens.level(), 1U) << "which the title shows already";
    EXPECT_EQ(screens.press(accept), (Order{.kind = Deed::Begin, .level = 1}));
    EXPECT_EQ(screens.now(), Screen::Playing);
    EXPECT_TRUE(screens.items().empty());
}

TEST(Screens, take_what_the_mouse_points_at) {
    Screens screens({.levels = 3});
    EXPECT_EQ(screens.press({.pointed = 2}), Order{});
    EXPECT_EQ(screens.selected(), 2U);
    EXPECT_EQ(screens.press({.pointed = 99}), Order{});
    EXPECT_EQ(screens.selected(), 2U);
    EXPECT_EQ(screens.press({.accept = true, .pointed = 0}),
              (Order{.kind = Deed::Begin, .level = 0}));
}

TEST(Screens, one_key_too_many_does_not_quit) {
    Screens screens({.levels = 2});
    EXPECT_EQ(screens.press(escape), Order{});
    EXPECT_EQ(screens.items()[screens.selected()].kind, Kind::Quit);
    EXPECT_EQ(screens.press(escape), Order{});
    EXPECT_EQ(screens.press(accept), (Order{.kind = Deed::Quit}));
}

TEST(Screens, pause_and_go_on) {
    Screens screens({.levels = 2});
    screens.begin(1);
    EXPECT_EQ(screens.press(escape), Order{});
    EXPECT_EQ(screens.now(), Screen::Paused);
    EXPECT_EQ(screens.press({.interrupted = true}), Order{});
    EXPECT_EQ(screens.now(), Screen::Paused) << "what interrupts never resumes";
    EXPECT_EQ(screens.press(escape), Order{});
    EXPECT_EQ(screens.now(), Screen::Playing) << "the same key";
    EXPECT_EQ(screens.press({.pause = true}), Order{});
    EXPECT_EQ(screens.press(accept), Order{});
    EXPECT_EQ(screens.now(), Screen::Playing) << "by the first line";
    EXPECT_EQ(screens.level(), 1U);
}

TEST(Screens, a_recording_goes_on_where_nobody_looks) {
    Screens screens({.levels = 2, .watches = true});
    screens.begin(0);
    EXPECT_EQ(screens.press({.interrupted = true}), Order{});
    EXPECT_EQ(screens.now(), Screen::Playing);
    EXPECT_EQ(screens.press({.pause = true}), Order{});
    EXPECT_EQ(screens.now(), Screen::Paused);
}

TEST(Screens, nothing_but_pause_and_restart_is_a_menu_press_while_playing) {
    Screens screens({.levels = 2});
    screens.begin(0);
    EXPECT_EQ(screens.press({.down = 1, .right = 1, .accept = true, .back = true, .pointed = 0}),
              Order{});
    EXPECT_EQ(screens.now(), Screen::Playing);
    EXPECT_EQ(screens.press({.restart = true}), (Order{.kind = Deed::Restart}));
    EXPECT_EQ(screens.now(), Screen::Playing);
}

TEST(Screens, restart_and_leave_from_the_pause) {
    Screens screens({.levels = 2});
    screens.begin(1);
    EXPECT_EQ(screens.press(escape), Order{});
    choose(screens, Kind::Restart);
    EXPECT_EQ(screens.press(accept), (Order{.kind = Deed::Restart}));
    EXPECT_EQ(screens.now(), Screen::Playing);
    EXPECT_EQ(screens.press(escape), Order{});
    choose(screens, Kind::ToTitle);
    EXPECT_EQ(screens.press(accept), (Order{.kind = Deed::Leave}));
    EXPECT_EQ(screens.now(), Screen::Title);
    EXPECT_EQ(screens.selected(), 1U) << "the level that was played";
}

TEST(Screens, a_level_that_is_won_leads_to_the_next_one_and_the_last_to_the_title) {
    Screens screens({.levels = 2});
    screens.begin(0);
    screens.ended(Outcome::Playing);
    EXPECT_EQ(screens.now(), Screen::Playing);
    screens.ended(Outcome::Won);
    EXPECT_EQ(screens.now(), Screen::Won);
    EXPECT_EQ(screens.press(accept), (Order{.kind = Deed::Begin, .level = 1}));
    EXPECT_EQ(screens.level(), 1U);
    screens.ended(Outcome::Won);
    EXPECT_EQ(screens.items().front().kind, Kind::Restart) << "there is no next one";
    EXPECT_EQ(screens.press(back), (Order{.kind = Deed::Leave}));
}

TEST(Screens, who_is_caught_tries_again) {
    Screens screens({.levels = 2});
    screens.begin(0);
    screens.ended(Outcome::Caught);
    EXPECT_EQ(screens.now(), Screen::Caught);
    EXPECT_EQ(screens.press({.pause = true}), Order{});
    EXPECT_EQ(screens.now(), Screen::Caught);
    EXPECT_EQ(screens.press(accept), (Order{.kind = Deed::Restart}));
    EXPECT_EQ(screens.now(), Screen::Playing);
    screens.ended(Outcome::Caught);
    EXPECT_EQ(screens.press({.restart = true}), (Order{.kind = Deed::Restart}));
    EXPECT_EQ(screens.now(), Screen::Playing);
}

TEST(Screens, an_end_is_of_a_game_that_is_played) {
    Screens screens({.levels = 2});
    screens.ended(Outcome::Won);
    EXPECT_EQ(screens.now(), Screen::Title);
    screens.begin(0);
    EXPECT_EQ(screens.press({.pause = true}), Order{});
    screens.ended(Outcome::Caught);
    EXPECT_EQ(screens.now(), Screen::Paused);
}

TEST(Screens, settings_go_back_to_where_they_were_opened) {
    for (const bool from_pause : {false, true}) {
        Screens screens({.levels = 2});
        if (from_pause) {
            screens.begin(0);
            EXPECT_EQ(screens.press({.pause = true}), Order{});
        }
        const Screen opened_from = screens.now();
        choose(screens, Kind::Settings);
        const std::size_t line = screens.selected();
        EXPECT_EQ(screens.press(accept), Order{});
        EXPECT_EQ(screens.now(), Screen::Settings);
        EXPECT_EQ(screens.behind(), opened_from);
        EXPECT_EQ(screens.items().size(), all_settings.size() + 1);
        EXPECT_EQ(screens.press(escape), (Order{.kind = Deed::Save}));
        EXPECT_EQ(screens.now(), opened_from);
        EXPECT_EQ(screens.selected(), line);
        EXPECT_EQ(screens.press(accept), Order{});
        choose(screens, Kind::Back);
        EXPECT_EQ(screens.press({.right = 1}), Order{});
        EXPECT_EQ(screens.press(accept), (Order{.kind = Deed::Save}));
        EXPECT_EQ(screens.now(), opened_from);
    }
}

TEST(Screens, settings_change_by_steps) {
    Screens screens({.levels = 1});
    choose(screens, Kind::Settings);
    EXPECT_EQ(screens.press(accept), Order{});
    for (std::size_t i = 0; i < all_settings.size(); ++i) {
        const Setting setting = all_settings[i];
        EXPECT_EQ(screens.press({.right = -1}),
                  (Order{.kind = Deed::Change, .setting = setting, .by = -1}));
        EXPECT_EQ(screens.press(accept),
                  (Order{.kind = Deed::Change, .setting = setting, .by = 1}));
        EXPECT_EQ(screens.now(), Screen::Settings);
        EXPECT_EQ(screens.press(down), Order{});
    }
}

TEST(Screens, a_recording_can_be_held_but_not_changed) {
    Screens screens({.levels = 2, .watches = true});
    screens.begin(1);
    EXPECT_EQ(screens.press({.restart = true}), Order{});
    screens.ended(Outcome::Won);
    EXPECT_EQ(screens.now(), Screen::Playing);
    EXPECT_EQ(screens.press({.pause = true}), Order{});
    const auto items = screens.items();
    EXPECT_TRUE(std::ranges::none_of(items, [](const MenuItem& item) {
        return item.kind == Kind::Restart || item.kind == Kind::ToTitle;
    }));
    EXPECT_EQ(screens.press({.restart = true}), Order{});
    EXPECT_EQ(screens.now(), Screen::Paused);
    choose(screens, Kind::Quit);
    EXPECT_EQ(screens.press(accept), (Order{.kind = Deed::Quit}));
}

TEST(Screens, a_title_that_offers_a_recording_comes_back_after_it) {
    Screens screens({.levels = 1, .can_watch = true, .can_quit = false});
    ASSERT_EQ(screens.items().size(), 3U);
    choose(screens, Kind::Watch);
    EXPECT_EQ(screens.press(accept), (Order{.kind = Deed::Watch}));
    EXPECT_EQ(screens.now(), Screen::Playing);
    EXPECT_TRUE(screens.watches());
    EXPECT_EQ(screens.press({.restart = true}), Order{});
    EXPECT_EQ(screens.press(escape), Order{});
    choose(screens, Kind::ToTitle);
    EXPECT_EQ(screens.press(accept), (Order{.kind = Deed::Leave}));
    EXPECT_FALSE(screens.watches());
    choose(screens, Kind::Watch);
    EXPECT_EQ(screens.press(accept), (Order{.kind = Deed::Watch}));
    screens.ended(Outcome::Won);
    EXPECT_EQ(screens.now(), Screen::Playing) << "its end stands as long as whoever shows it likes";
    EXPECT_EQ(screens.leave(), (Order{.kind = Deed::Leave}));
    EXPECT_EQ(screens.now(), Screen::Title);
    EXPECT_FALSE(screens.watches());
}

TEST(Screens, settings_are_those_that_there_are) {
    Screens screens({.levels = 1, .settings = {Setting::Scale, Setting::Samples}});
    choose(screens, Kind::Settings);
    EXPECT_EQ(screens.press(accept), Order{});
    ASSERT_EQ(screens.items().size(), 3U);
    EXPECT_EQ(screens.items()[1].setting, Setting::Samples);
}

// Whatever is pressed, a menu has a line that is chosen, and a game none.
TEST(Screens, hold_together_under_any_presses) {
    std::uint32_t state = 1;
    const auto dice = [&](std::uint32_t sides) {
        state = state * 1664525U + 1013904223U;
        return (state >> 16U) % sides;
    };
    Screens screens({.levels = 3});
    std::array<int, 6> seen{};
    for (int i = 0; i < 20000; ++i) {
        const Screen before = screens.now();
        const Order order = screens.press({.down = static_cast<int>(dice(3)) - 1,
                                           .right = static_cast<int>(dice(3)) - 1,
                                           .accept = dice(3) == 0,
                                           .back = dice(6) == 0,
                                           .pause = dice(6) == 0,
                                           .restart = dice(9) == 0,
                                           .pointed = dice(12)});
        if (dice(4) == 0) screens.ended(static_cast<Outcome>(dice(3)));
        ++seen[static_cast<std::size_t>(screens.now())];
        if (screens.now() == Screen::Playing) {
            EXPECT_TRUE(screens.items().empty());
        } else {
            ASSERT_LT(screens.selected(), screens.items().size());
        }
        ASSERT_LT(screens.level(), 3U);
        EXPECT_TRUE(order.kind != Deed::Leave || before != Screen::Title);
        EXPECT_TRUE(order.kind != Deed::Change || before == Screen::Settings);
        EXPECT_TRUE(order.kind != Deed::Quit || before == Screen::Title);
    }
    EXPECT_TRUE(std::ranges::all_of(seen, [](int times) { return times > 100; }));
}

}  // namespace
}  // namespace gnomon::game
