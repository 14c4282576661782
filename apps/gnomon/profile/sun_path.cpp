// SPDX-License-Identifier: MIT
#include "profile/sun_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "profile/canvas.hpp"

namespace gnomon::cli {

namespace {

constexpr std::size_t most_days = 12;
constexpr double radius = 320.0;
constexpr glm::dvec2 center(400.0, 440.0);
constexpr Color path_ink{0.13, 0.13, 0.15};
constexpr Color path_grey{0.70, 0.71, 0.74};
constexpr std::array<Color, 4> path_colors{
    {{0.13, 0.30, 0.62}, {0.10, 0.60, 0.50}, {0.95, 0.61, 0.14}, {0.76, 0.20, 0.22}}};

double ring(double altitude_rad) {
    return radius * std::tan((std::numbers::pi / 2.0 - altitude_rad) / 2.0);
}

glm::dvec2 place_in_sky(double azimuth_rad, double altitude_rad) {
    return center + ring(altitude_rad) * glm::dvec2(std::sin(azimuth_rad), -std::cos(azimuth_rad));
}

void draw_dome(Canvas& canvas) {
    for (int altitude = 0; altitude < 90; altitude += 10) {
        canvas.circle(center, ring(glm::radians(static_cast<double>(altitude))),
                      altitude == 0 ? path_ink : path_grey, altitude == 0 ? 1.5 : 0.8);
        if (altitude % 20 == 0 && altitude > 0) {
            canvas.text(center + glm::dvec2(4.0, ring(glm::radians(double(altitude))) - 3.0),
                        fmt::format("{}\u00b0", altitude), {.size = 11.0, .color = path_grey});
        }
    }
    constexpr std::array<const char*, 4> names{"N", "E", "S", "W"};
    for (int azimuth = 0; azimuth < 360; azimuth += 15) {
        const double rad = glm::radians(static_cast<double>(azimuth));
        const std::array spoke{center, place_in_sky(rad, 0.0)};
        if (azimuth % 30 == 0) canvas.segments(spoke, path_grey, 0.6);
        const glm::dvec2 beyond =
            center + (radius + 20.0) * glm::dvec2(std::sin(rad), -std::cos(rad));
        const bool named = azimuth % 90 == 0;
        if (azimuth % 30 == 0) {
            canvas.text(beyond + glm::dvec2(0.0, 5.0),
                        named ? names[static_cast<std::size_t>(azimuth / 90)]
                              : fmt::format("{}\u00b0", azimuth),
                        {.size = named ? 18.0 : 12.0, .align = Align::Center, .bold = named});
        }
    }
}

// The whole day's way, its hours, and thick what the study looks at.
void draw_day(Canvas& canvas, const Study& study, const sun::Date& date, const Color& color) {
    const sun::Place place{glm::radians(study.latitude_deg), glm::radians(study.longitude_deg),
                           study.elevation_m};
    std::vector<glm::dvec2> way;
    std::vector<glm::dvec2> studied;
    const auto flush = [&](std::vector<glm::dvec2>& points, double width) {
        if (points.size() > 1) canvas.path(points, color, width);
        points.clear();
    };
    for (std::chrono::minutes clock(0); clock <= std::chrono::hours(24);
         clock += std::chrono::minutes(5)) {
        const sun::Instant utc = sun::instant_of(date, clock, study.offset);
        const sun::SunPosition sun = sun::sun_position(utc, place, study.air);
        if (sun.altitude_rad <= 0.0) {
            flush(way, 1.2);
            flush(studied, 3.5);
            continue;
        }
        const glm::dvec2 at = place_in_sky(sun.azimuth_rad, sun.altitude_rad);
        way.push_back(at);
        if (clock >= study.from && clock <= study.to) {
            studied.push_back(at);
        } else {
            flush(studied, 3.5);
        }
        if (clock % std::chrono::hours(1) == std::chrono::minutes(0)) {
            canvas.disc(at, 3.5, color);
            if (clock % std::chrono::hours(3) == std::chrono::minutes(0)) {
                canvas.text(at + glm::dvec2(0.0, -8.0), sun::clock_text(clock),
                            {.size = 11.0, .align = Align::Center});
            }
        }
    }
    flush(way, 1.2);
    flush(studied, 3.5);
}

}  // namespace

Result<std::vector<std::byte>> draw_sun_path(const Study& study) {
    Canvas canvas(800, 830, {1.0, 1.0, 1.0});
    draw_dome(canvas);
    const std::size_t days = std::min(study.dates.size(), most_days);
    for (std::size_t i = 0; i < days; ++i) {
        const double t = days > 1 ? static_cast<double>(i) / static_cast<double>(days - 1) : 1.0;
        const Color color = ramp(path_colors, t);
        // Of more, some that are spread over all, the first and the last among them.
        const sun::Date& date =
            study.dates[days > 1 ? i * (study.dates.size() - 1) / (days - 1) : 0];
        draw_day(canvas, study, date, color);
        const glm::dvec2 at(24.0, 92.0 + 18.0 * static_cast<double>(i));
        canvas.rectangle(at, {18.0, 4.0}, color);
        canvas.text(at + glm::dvec2(26.0, 7.0), sun::to_text(date), {.size = 12.0});
    }
    canvas.text({24.0, 36.0}, "Sun path", {.size = 22.0, .bold = true});
    canvas.text({24.0, 62.0},
                fmt::format("{:.5g}\u00b0 {}, {:.5g}\u00b0 {}; hours of {}; thick: {} to {}",
                            std::abs(study.latitude_deg), study.latitude_deg < 0.0 ? "S" : "N",
                            std::abs(study.longitude_deg), study.longitude_deg < 0.0 ? "W" : "E",
                            sun::offset_text(study.offset), sun::clock_text(study.from),
                            sun::clock_text(study.to)),
                {.size = 14.0, .color = {0.42, 0.43, 0.46}});
    return canvas.png();
}

}  // namespace gnomon::cli
