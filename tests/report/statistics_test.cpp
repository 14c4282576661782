// SPDX-License-Identifier: MIT
//
// Medians, intervals and sums of errors, against numbers worked out by hand.
#include <gnomon/report/report.hpp>

#include <cmath>

#include <gtest/gtest.h>

namespace gnomon::report {
namespace {

TEST(Spread, RanksAreInterpolated) {
    const Spread s = spread_of({4.0, 1.0, 3.0, 2.0});
    EXPECT_DOUBLE_EQ(s.median, 2.5);
    EXPECT_DOUBLE_EQ(s.p95, 3.85);
    EXPECT_EQ(s.low, 1.0);
    EXPECT_EQ(s.high, 4.0);
    const Spread one = spread_of({7.0});
    EXPECT_EQ(one.median, 7.0);
    EXPECT_EQ(one.p95, 7.0);
    EXPECT_EQ(spread_of({}).high, 0.0);
}

TEST(Ratio, IsGeometricAndPaired) {
    // Ratios 1/2 and 2: their geometric mean is 1. Student's t of one degree of freedom is 12.706,
    // the standard error of the logarithms ln 2.
    const Ratio r = ratio_of({1.0, 8.0}, {2.0, 4.0});
    EXPECT_NEAR(r.mean, 1.0, 1e-12);
    EXPECT_NEAR(std::log(r.high), 12.706 * std::log(2.0), 1e-9);
    EXPECT_NEAR(std::log(r.low), -12.706 * std::log(2.0), 1e-9);
}

TEST(Ratio, EqualRatiosHaveNoInterval) {
    const Ratio r = ratio_of({3.0, 6.0, 30.0}, {1.0, 2.0, 10.0});
    EXPECT_NEAR(r.mean, 3.0, 1e-12);
    EXPECT_NEAR(r.low, 3.0, 1e-9);
    EXPECT_NEAR(r.high, 3.0, 1e-9);
}

TEST(Ratio, AFifthAtEitherEndDoesNotCount) {
    // Of ten the two least and the two largest are left out.
    const std::vector<double> ones(10, 1.0);
    const Ratio calm = ratio_of({2.0, 2.1, 2.2, 2.0, 2.1, 2.2, 2.0, 2.1, 2.2, 2.1}, ones);
    const Ratio upset = ratio_of({2.0, 2.1, 2.2, 2.0, 90.0, 2.2, 0.001, 2.1, 50.0, 2.1}, ones);
    EXPECT_NEAR(calm.mean, 2.1, 0.03);
    EXPECT_NEAR(upset.mean, 2.1, 0.03);
    EXPECT_LT(upset.high, 2.35);
    EXPECT_GT(upset.low, 1.85);
    // Yuen's interval, worked out apart: h = 3 of 5 kept, winsorised logarithms ln 2, ln 2, ln 3,
    // ln 4, ln 4.
    const Ratio five = ratio_of({1.0, 2.0, 3.0, 4.0, 9.0}, {1.0, 1.0, 1.0, 1.0, 1.0});
    EXPECT_NEAR(five.mean, std::cbrt(24.0), 1e-12);
    const double ln[] = {std::log(2.0), std::log(2.0), std::log(3.0), std::log(4.0), std::log(4.0)};
    double mean = 0.0;
    for (const double x : ln) mean += x / 5.0;
    double squares = 0.0;
    for (const double x : ln) squares += (x - mean) * (x - mean);
    EXPECT_NEAR(std::log(five.high / five.mean), 4.303 * std::sqrt(squares / 6.0), 1e-9);
}

TEST(Ratio, OnePairSaysNothingAboutTheInterval) {
    const Ratio r = ratio_of({2.0, 0.0}, {1.0, 5.0});  // the second failed
    EXPECT_NEAR(r.mean, 2.0, 1e-12);
    EXPECT_EQ(r.low, 0.0);
    EXPECT_TRUE(std::isinf(r.high));
    EXPECT_TRUE(std::isinf(ratio_of({}, {}).high));
}

truth::Judgement judgement(std::uint64_t false_shadow, std::uint64_t false_light,
                           double displacement_px) {
    truth::Judgement j;
    j.lit = 900;
    j.shadowed = 100;
    j.band = 50;
    j.band_lit = 30;
    j.band_shadowed = 20;
    j.band_false_light = 2;
    j.false_shadow = false_shadow;
    j.false_light = false_light;
    j.edge_displacement_px = displacement_px;
    return j;
}

TEST(Errors, WorstAndMedianOfFrames) {
    const Errors e = errors_of({judgement(1, 0, 1.0), judgement(5, 10, 3.0), judgement(4, 0, 1.0)});
    EXPECT_EQ(e.wrong_median, 4U);
    EXPECT_EQ(e.wrong_worst, 15U);
    EXPECT_EQ(e.false_shadow_worst, 5U);
    EXPECT_EQ(e.false_light_worst, 10U);
    EXPECT_EQ(e.wrong_at_all_median, 6U);
    EXPECT_EQ(e.wrong_at_all_worst, 17U);
    EXPECT_DOUBLE_EQ(e.wrong_share_worst, 0.015);
    EXPECT_DOUBLE_EQ(e.band_share, 50.0 / 1050.0);
    EXPECT_EQ(e.edge_displacement_px, 3.0);
    // Of 120 in shadow 12 are missing, and 5 that are lit are not: 108 of 125.
    EXPECT_DOUBLE_EQ(e.iou_worst, 108.0 / 125.0);
    EXPECT_EQ(errors_of({}).wrong_worst, 0U);
}

}  // namespace
}  // namespace gnomon::report
