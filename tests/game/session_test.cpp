// SPDX-License-Identifier: MIT
#include "play/session.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "small_level.hpp"

namespace gnomon::game {
namespace {

Session begun() {
    auto session = Session::begin(bare_level(), "bare");
    EXPECT_TRUE(session);
    return std::move(*session);
}

TEST(Session, says_when_a_recording_has_no_room_for_more) {
    Session session = begun();
    for (std::size_t i = 0; i < most_ticks; ++i) ASSERT_TRUE(session.tick({.pause = true}));
    EXPECT_FALSE(session.is_beyond_recording());
    EXPECT_FALSE(session.has_just_filled_recording());
    ASSERT_TRUE(session.restart()) << "which is an input as well";
    EXPECT_TRUE(session.is_beyond_recording());
    EXPECT_TRUE(session.has_just_filled_recording());
    ASSERT_TRUE(session.tick({.east = 127}));
    EXPECT_TRUE(session.is_beyond_recording());
    EXPECT_FALSE(session.has_just_filled_recording()) << "it is said once";
    EXPECT_EQ(session.inputs(), most_ticks + 2);
    EXPECT_EQ(session.played().inputs.size(), most_ticks);
    EXPECT_GT(session.world().player().velocity_m_s.x, 0.0) << "the game goes on";
    // What there is is a recording all the same.
    const auto read = read_recording(to_text(session.played()), "x");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, session.played());
}

TEST(Session, counts_the_inputs_of_what_it_follows) {
    Session session = begun();
    session.follow({{.east = 1}, {.east = 2}, {.east = 3}});
    EXPECT_EQ(session.inputs(), 0U);
    for (int i = 0; i < 5; ++i) ASSERT_TRUE(session.tick({}));
    EXPECT_TRUE(session.is_over());
    EXPECT_EQ(session.inputs(), 3U);
    ASSERT_TRUE(session.restart());
    EXPECT_EQ(session.inputs(), 0U);
    EXPECT_FALSE(session.is_over());
}

}  // namespace
}  // namespace gnomon::game
