// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <gnomon/sun/daylight.hpp>

namespace gnomon::sun {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

// Almanacs give the minute.
void expect_near(const std::optional<Instant>& event, const char* date, int hour, int minute) {
    ASSERT_TRUE(event);
    const Instant expected =
        instant_of(*parse_date(date), std::chrono::hours(hour) + std::chrono::minutes(minute), {});
    EXPECT_LE(std::abs((*event - expected).count()), 90) << to_text(*event);
}

// The United States Naval Observatory's table for Greenwich.
TEST(Daylight, AgreesWithTheAlmanac) {
    const Daylight day =
        daylight_of(*parse_date("2024-06-21"), std::chrono::minutes(0), {51.4769 * degree, 0.0});
    expect_near(day.sunrise, "2024-06-21", 3, 43);
    expect_near(day.sunset, "2024-06-21", 20, 22);
    EXPECT_FALSE(day.begins_light);
}

TEST(Daylight, KnowsMidnightSunAndPolarNight) {
    const Place tromso{69.65 * degree, 18.96 * degree};
    const std::chrono::minutes offset(60);
    const Daylight summer = daylight_of(*parse_date("2026-06-21"), offset, tromso);
    EXPECT_TRUE(summer.begins_light);
    EXPECT_FALSE(summer.sunrise || summer.sunset);
    const Daylight winter = daylight_of(*parse_date("2026-12-21"), offset, tromso);
    EXPECT_FALSE(winter.begins_light);
    EXPECT_FALSE(winter.sunrise || winter.sunset);
}

TEST(Daylight, IsOfThePlacesOwnDay) {
    const Place auckland{-36.85 * degree, 174.76 * degree};
    const Daylight day =
        daylight_of(*parse_date("2026-03-21"), std::chrono::minutes(13 * 60), auckland);
    ASSERT_TRUE(day.sunrise && day.sunset);
    EXPECT_LT(*day.sunrise, *day.sunset);
    EXPECT_NEAR(static_cast<double>((*day.sunset - *day.sunrise).count()) / 3600.0, 12.0, 0.3);
}

}  // namespace
}  // namespace gnomon::sun
