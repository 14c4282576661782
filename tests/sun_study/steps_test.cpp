// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <gnomon/sun_study/steps.hpp>
#include <gnomon/sun_study/sun_hours.hpp>

namespace gnomon::sun_study {
namespace {

using std::chrono::hours;
using std::chrono::minutes;
using testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180.0;
constexpr sun::Place linz{48.306 * degree, 14.286 * degree};
constexpr sun::Place tromso{69.65 * degree, 18.96 * degree};

Period day(const char* date, int from_h, int to_h, int step_min = 30) {
    return {.date = *sun::parse_date(date),
            .from = hours(from_h),
            .to = hours(to_h),
            .step = minutes(step_min),
            .offset = hours(1)};
}

std::string message_of(const Period& period, const sun::Place& place, const SunRules& rules = {}) {
    const auto steps = make_steps(period, place, {}, rules);
    return steps ? why_no_sun(*steps, period, place) : steps.error().message;
}

TEST(Steps, StandForTheTimeFromTheFirstToTheLast) {
    const auto steps = make_steps(day("2026-03-21", 9, 15), linz, {}, {});
    ASSERT_TRUE(steps);
    ASSERT_EQ(steps->size(), 13U);
    std::uint64_t sum = 0;
    for (const Step& step : *steps) sum += step.half_seconds;
    EXPECT_EQ(sum, 6U * 7200U);
    EXPECT_EQ(sun::to_text(steps->front().utc), "2026-03-21T08:00:00Z");
    EXPECT_EQ(steps->back().clock, hours(15));
    // 3 h by 80 minutes: 09:00, 10:20, 11:40.
    const auto uneven = make_steps(day("2026-03-21", 9, 12, 80), linz, {}, {});
    ASSERT_TRUE(uneven);
    ASSERT_EQ(uneven->size(), 3U);
    EXPECT_EQ((*uneven)[0].half_seconds + (*uneven)[1].half_seconds + (*uneven)[2].half_seconds,
              2U * 160U * 60U);
}

TEST(Steps, CountOnlyWhereTheRulesLetThem) {
    const Period period = day("2026-03-21", 0, 24, 10);
    const auto counted = [&](const SunRules& rules) {
        double h = 0.0;
        const auto steps = make_steps(period, linz, {}, rules);
        for (const Step& step : *steps) {
            if (step.counts) h += step.half_seconds / half_seconds_an_hour;
        }
        return h;
    };
    EXPECT_NEAR(counted({}), 12.1, 0.2);
    EXPECT_NEAR(counted({.skip_after_sunrise = minutes(60), .skip_before_sunset = minutes(30)}),
                12.1 - 1.5, 0.2);
    const auto high = make_steps(period, linz, {}, {.min_altitude_rad = 10.0 * degree});
    for (const Step& step : *high) {
        EXPECT_EQ(step.counts, step.sun.altitude_rad >= 10.0 * degree);
    }
}

double counted_hours(const Period& period, const sun::Place& place, const SunRules& rules) {
    const auto steps = make_steps(period, place, {}, rules);
    if (!steps) return -1.0;
    double h = 0.0;
    for (const Step& step : *steps) h += step.counts ? step.half_seconds / half_seconds_an_hour : 0;
    return h;
}

// In Reykjavik the sun of the solstice sets four minutes after midnight, and rises at 02:55.
TEST(Steps, LeaveOutMinutesAboutASunsetAfterMidnight) {
    constexpr sun::Place reykjavik{64.147 * degree, -21.94 * degree};
    Period period = day("2026-06-21", 0, 24, 5);
    period.offset = hours(0);
    const double all = counted_hours(period, reykjavik, {});
    EXPECT_NEAR(all, 21.0, 0.5);
    // The horizon of what counts is the sun's centre's, some minutes from sunrise.
    const double less = counted_hours(
        period, reykjavik, {.skip_after_sunrise = hours(2), .skip_before_sunset = hours(1)});
    EXPECT_NEAR(less, all - 3.0, 0.4);
    EXPECT_GE(less, all - 3.0);
    const auto steps = make_steps(period, reykjavik, {}, {.skip_before_sunset = hours(1)});
    ASSERT_TRUE(steps);
    for (const Step& step : *steps) {
        if (step.clock >= hours(5) && step.clock <= hours(22)) {
            EXPECT_TRUE(step.counts);
        }
        // The sunset is the next day's.
        if (step.clock > hours(23) + minutes(10)) {
            EXPECT_FALSE(step.counts);
        }
    }
}

// 120 degrees west in UTC: the day ends at two in the night and begins at two in the afternoon.
TEST(Steps, LeaveOutMinutesWhereverTheClockPutsTheDay) {
    constexpr sun::Place west{40.0 * degree, -120.0 * degree};
    Period period = day("2026-03-21", 0, 24, 5);
    period.offset = hours(0);
    const double all = counted_hours(period, west, {});
    EXPECT_NEAR(all, 12.1, 0.2);
    const double less = counted_hours(
        period, west, {.skip_after_sunrise = hours(1), .skip_before_sunset = minutes(30)});
    EXPECT_NEAR(less, all - 1.5, 0.2);
}

TEST(Steps, SayWhatIsWrong) {
    EXPECT_THAT(message_of(day("2026-03-21", 15, 9), linz), HasSubstr("15:00 to 09:00"));
    EXPECT_THAT(message_of(day("2026-03-21", 9, 9), linz), HasSubstr("empty"));
    EXPECT_THAT(message_of(day("2026-03-21", 9, 10, 90), linz), HasSubstr("does not fit"));
    EXPECT_THAT(message_of(day("2026-12-21", 9, 15), tromso),
                testing::AllOf(HasSubstr("stays below the horizon"), HasSubstr("2026-12-21"),
                               HasSubstr("69.65")));
    EXPECT_THAT(message_of(day("2026-12-21", 9, 15), linz, {.min_altitude_rad = 60.0 * degree}),
                HasSubstr("no sun counts"));
    EXPECT_EQ(message_of(day("2026-12-21", 9, 15), linz), "");
}

// Steps all the same, so that a year has it among its days.
TEST(Steps, OfAPolarNightAreThereAndDoNotCount) {
    const auto steps = make_steps(day("2026-12-21", 9, 15), tromso, {}, {});
    ASSERT_TRUE(steps);
    ASSERT_EQ(steps->size(), 13U);
    for (const Step& step : *steps) {
        EXPECT_FALSE(step.counts);
        EXPECT_LT(step.sun.altitude_rad, 0.0);
    }
}

}  // namespace
}  // namespace gnomon::sun_study
