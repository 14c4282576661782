// SPDX-License-Identifier: MIT
#include "statistics.hpp"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::bench {
namespace {

TEST(Spread, OfNothingIsNotANumber) {
    EXPECT_TRUE(std::isnan(spread_of({}).median));
    EXPECT_TRUE(std::isnan(spread_of({}).high));
}

TEST(Spread, HasTheQuartilesOfItsValues) {
    const std::vector<double> values{9, 1, 5, 3, 7};
    const Spread spread = spread_of(values);
    EXPECT_EQ(spread.median, 5);
    EXPECT_EQ(spread.lower_quartile, 3);
    EXPECT_EQ(spread.upper_quartile, 7);
    EXPECT_EQ(spread.low, 1);  // five values are too few for any other
    EXPECT_EQ(spread.high, 9);
}

// Ranks from any table of the sign test: 6 values need the extremes, 20 the 6th from each side.
TEST(Spread, HasTheRanksOfTheSignTest) {
    const auto interval = [](std::size_t n) {
        std::vector<double> values(n);
        std::iota(values.begin(), values.end(), 1.0);
        return std::pair(spread_of(values).low, spread_of(values).high);
    };
    EXPECT_EQ(interval(6), std::pair(1.0, 6.0));
    EXPECT_EQ(interval(20), std::pair(6.0, 15.0));
    EXPECT_EQ(interval(100), std::pair(40.0, 61.0));
}

TEST(Spread, HoldsTheMedianInNineteenOfTwentyCases) {
    GNOMON_RANDOM(random);
    int held = 0;
    constexpr int tries = 2'000;
    for (int i = 0; i < tries; ++i) {
        std::vector<double> values(31);
        for (double& value : values) value = -std::log(random.uniform(0.0, 1.0));
        const Spread spread = spread_of(values);
        held += spread.low <= std::log(2.0) && std::log(2.0) <= spread.high ? 1 : 0;
    }
    EXPECT_GT(held, tries * 94 / 100);
    EXPECT_LT(held, tries * 99 / 100);
}

}  // namespace
}  // namespace gnomon::bench
