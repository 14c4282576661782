// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gnomon/sun/position.hpp>

#include "tests/support/paths.hpp"

namespace gnomon::sun {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

Place place_at(double latitude_deg, double longitude_deg, double elevation_m = 0.0) {
    return {latitude_deg * degree, longitude_deg * degree, elevation_m};
}

Instant at(const char* date, int hour, int minute, int second, int offset_hours = 0) {
    return instant_of(
        *parse_date(date),
        std::chrono::hours(hour) + std::chrono::minutes(minute) + std::chrono::seconds(second),
        std::chrono::hours(offset_hours));
}

// How far apart two directions are, in degrees.
double angle_deg(double azimuth_a, double altitude_a, double azimuth_b, double altitude_b) {
    const glm::dvec3 a = towards_sun(azimuth_a, altitude_a);
    const glm::dvec3 b = towards_sun(azimuth_b, altitude_b);
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / degree;
}

struct Row {
    std::string text;
    Instant utc;
    Place place;
    double azimuth_rad = 0.0;
    double altitude_rad = 0.0;
};

std::vector<Row> table() {
    std::ifstream file(test::source_folder() / "tests/sun/data/sun_positions.csv");
    std::vector<Row> rows;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::istringstream cells(line);
        std::string utc;
        std::getline(cells, utc, ',');
        double v[5] = {};
        char comma = ',';
        cells >> v[0] >> comma >> v[1] >> comma >> v[2] >> comma >> v[3] >> comma >> v[4];
        EXPECT_TRUE(cells) << line;
        rows.push_back({line,
                        at(utc.substr(0, 10).c_str(), std::stoi(utc.substr(11, 2)),
                           std::stoi(utc.substr(14, 2)), std::stoi(utc.substr(17, 2))),
                        place_at(v[0], v[1], v[2]), v[3] * degree, v[4] * degree});
    }
    return rows;
}

// Section A.5 of the algorithm's paper.
TEST(SunPosition, MeetsTheReferenceCaseOfTheSolarPositionAlgorithm) {
    const SunPosition sun =
        sun_position(at("2003-10-17", 12, 30, 30, -7), place_at(39.742476, -105.1786, 1830.14),
                     {.pressure_mbar = 820.0, .temperature_c = 11.0}, 67.0);
    EXPECT_NEAR(sun.zenith_rad() / degree, 50.11162, 3e-4);
    EXPECT_NEAR(sun.azimuth_rad / degree, 194.34024, 3e-4);
}

TEST(SunPosition, AgreesWithATableOfAnotherAstronomyToAHundredthOfADegree) {
    const std::vector<Row> rows = table();
    ASSERT_GE(rows.size(), 200U);
    double worst = 0.0;
    for (const Row& row : rows) {
        const SunPosition sun = sun_position(row.utc, row.place);
        const double apart =
            angle_deg(sun.azimuth_rad, sun.airless_altitude_rad, row.azimuth_rad, row.altitude_rad);
        EXPECT_LT(apart, 0.01) << row.text;
        worst = std::max(worst, apart);
    }
    RecordProperty("worst_deg", std::to_string(worst));
}

// Altitude, azimuth and day of the year in one: who mistakes the sign of a longitude sees it here.
TEST(SunPosition, StandsInTheSouthAtNoonInTheNorthAndTheOtherWayRound) {
    const SunPosition linz = sun_position(at("2026-06-21", 11, 5, 0), place_at(48.306, 14.286));
    EXPECT_NEAR(linz.azimuth_rad / degree, 180.0, 1.0);
    EXPECT_NEAR(linz.altitude_rad / degree, 90.0 - 48.306 + 23.44, 0.05);
    const SunPosition sydney = sun_position(at("2026-06-21", 1, 57, 0), place_at(-33.86, 151.21));
    const double azimuth_deg = sydney.azimuth_rad / degree;
    EXPECT_LT(std::min(azimuth_deg, 360.0 - azimuth_deg), 1.0);
    const SunPosition morning = sun_position(at("2026-03-20", 6, 0, 0), place_at(0.0, 0.0));
    EXPECT_NEAR(morning.azimuth_rad / degree, 90.0, 0.5);
}

TEST(SunPosition, IsDefinedAtThePoles) {
    for (const double latitude : {-90.0, 90.0}) {
        const SunPosition sun = sun_position(at("2026-06-21", 12, 0, 0), place_at(latitude, 0.0));
        EXPECT_NEAR(sun.airless_altitude_rad / degree, std::copysign(23.43, latitude), 0.02);
        EXPECT_TRUE(std::isfinite(sun.azimuth_rad));
    }
}

TEST(SunPosition, IsLiftedByRefractionNearTheHorizonAlone) {
    const Air air;
    // Formula 42 by hand: 1.02 / 60 / tan(10.3 / 5.11 degrees) = 0.48303; at 10 degrees
    // 1.02 / 60 / tan(10.6816 degrees).
    EXPECT_NEAR(refraction_rad(0.0, air) / degree, 0.48303, 1e-4);
    EXPECT_NEAR(refraction_rad(10.0 * degree, air) / degree, 0.09013, 1e-4);
    EXPECT_LT(std::abs(refraction_rad(90.0 * degree, air)) / degree, 1e-4);
    EXPECT_EQ(refraction_rad(-1.0 * degree, air), 0.0);
    EXPECT_EQ(refraction_rad(0.0, {.pressure_mbar = 0.0}), 0.0);
}

TEST(DeltaT, IsWhatTheEarthTook) {
    // Observed, to the second: 29.1 s in 1950, 45.5 s in 1975, 63.8 s in 2000.
    EXPECT_NEAR(delta_t_s(at("1950-01-01", 0, 0, 0)), 29.1, 0.5);
    EXPECT_NEAR(delta_t_s(at("1975-01-01", 0, 0, 0)), 45.5, 0.5);
    EXPECT_NEAR(delta_t_s(at("2000-01-01", 0, 0, 0)), 63.8, 0.5);
    // The pieces meet.
    for (const int year : {1961, 1986, 2005, 2050}) {
        const std::string before = std::to_string(year - 1) + "-12-31";
        const std::string after = std::to_string(year) + "-01-02";
        EXPECT_NEAR(delta_t_s(at(before.c_str(), 0, 0, 0)), delta_t_s(at(after.c_str(), 0, 0, 0)),
                    0.5)
            << year;
    }
}

TEST(TowardsSun, TurnsWithThePlansNorth) {
    const glm::dvec3 south = towards_sun(180.0 * degree, 30.0 * degree);
    EXPECT_NEAR(south.y, -std::cos(30.0 * degree), 1e-12);
    EXPECT_NEAR(south.z, 0.5, 1e-12);
    // North lies to the right of the plan: what comes from the north comes from the right.
    EXPECT_NEAR(towards_sun(0.0, 0.0, 90.0 * degree).x, 1.0, 1e-12);
}

}  // namespace
}  // namespace gnomon::sun
