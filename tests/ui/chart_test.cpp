// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <gnomon/ui/chart.hpp>

#include <array>

namespace gnomon::ui {
namespace {

TEST(ChartHistory, forgets_the_oldest) {
    ChartHistory history(2, 3);
    for (int i = 1; i <= 5; ++i) {
        history.add(std::array{static_cast<float>(i), static_cast<float>(10 * i)});
    }
    ASSERT_EQ(history.frames(), 3U);
    EXPECT_EQ(history.at(0, 0), 5.0F);
    EXPECT_EQ(history.at(2, 0), 3.0F);
    EXPECT_EQ(history.at(2, 1), 30.0F);
    EXPECT_EQ(history.largest_sum(), 55.0F);
    EXPECT_EQ(history.median(1), 40.0F);
    history.clear();
    EXPECT_EQ(history.frames(), 0U);
    EXPECT_EQ(history.median(1), 0.0F);
}

TEST(Chart, scales_are_round_and_hold_the_value) {
    EXPECT_FLOAT_EQ(round_scale(0.0F), 1e-3F);
    EXPECT_FLOAT_EQ(round_scale(1.1F), 2.0F);
    EXPECT_FLOAT_EQ(round_scale(2.1F), 5.0F);
    EXPECT_FLOAT_EQ(round_scale(7.0F), 10.0F);
    EXPECT_FLOAT_EQ(round_scale(0.3F), 0.5F);
    EXPECT_GE(round_scale(16.7F), 16.7F);
}

}  // namespace
}  // namespace gnomon::ui
