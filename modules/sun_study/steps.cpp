// SPDX-License-Identifier: MIT
#include <gnomon/sun_study/steps.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <gnomon/sun/daylight.hpp>

namespace gnomon::sun_study {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

std::string place_text(const sun::Place& place) {
    return fmt::format("{:.4g}\u00b0 {}, {:.4g}\u00b0 {}", std::abs(place.latitude_rad) / degree,
                       place.latitude_rad < 0.0 ? "S" : "N", std::abs(place.longitude_rad) / degree,
                       place.longitude_rad < 0.0 ? "W" : "E");
}

std::string stretch_text(const Period& period) {
    return fmt::format("{} to {} ({})", sun::clock_text(period.from), sun::clock_text(period.to),
                       sun::offset_text(period.offset));
}

// Sunrises and sunsets that what is left out about them may reach into the period from.
struct DayEdges {
    std::vector<sun::Instant> sunrises;
    std::vector<sun::Instant> sunsets;
};

// By the clock a sunset may come before the day's sunrise, or fall on the day after: the days about
// the date are asked as well, and each a second time from noon to noon, since Daylight has one of
// each and a day can have two sunsets, just after a midnight and just before the next.
DayEdges edges_about(const Period& period, const sun::Place& place, const SunRules& rules) {
    DayEdges edges;
    if (rules.skip_after_sunrise.count() == 0 && rules.skip_before_sunset.count() == 0) {
        return edges;
    }
    for (const int days : {-1, 0, 1}) {
        const sun::Date date = std::chrono::sys_days(period.date) + std::chrono::days(days);
        for (const std::chrono::hours turned : {std::chrono::hours(0), std::chrono::hours(12)}) {
            const sun::Daylight day = sun::daylight_of(date, period.offset + turned, place);
            if (day.sunrise) edges.sunrises.push_back(*day.sunrise);
            if (day.sunset) edges.sunsets.push_back(*day.sunset);
        }
    }
    return edges;
}

bool is_left_out(sun::Instant utc, const DayEdges& edges, const SunRules& rules) {
    return std::ranges::any_of(
               edges.sunrises,
               [&](sun::Instant at) { return at <= utc && utc < at + rules.skip_after_sunrise; }) ||
           std::ranges::any_of(edges.sunsets, [&](sun::Instant at) {
               return at - rules.skip_before_sunset < utc && utc <= at;
           });
}

}  // namespace

Result<std::vector<Step>> make_steps(const Period& period, const sun::Place& place,
                                     const sun::Air& air, const SunRules& rules) {
    if (period.to <= period.from) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("The time from {} is empty: it has to end after it begins.",
                                stretch_text(period)));
    }
    if (period.from + period.step > period.to) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("A step of {} s does not fit into the time from {}: at least two "
                                "steps are needed.",
                                period.step.count(), stretch_text(period)));
    }
    const DayEdges edges = edges_about(period, place, rules);
    std::vector<Step> steps;
    for (std::chrono::seconds clock = period.from; clock <= period.to; clock += period.step) {
        Step step;
        step.clock = clock;
        step.utc = sun::instant_of(period.date, clock, period.offset);
        step.sun = sun::sun_position(step.utc, place, air);
        const double altitude = step.sun.altitude_rad;
        step.counts = altitude > 0.0 && altitude >= rules.min_altitude_rad &&
                      !is_left_out(step.utc, edges, rules);
        step.half_seconds = static_cast<std::uint32_t>(2 * period.step.count());
        steps.push_back(step);
    }
    steps.front().half_seconds /= 2;
    steps.back().half_seconds /= 2;
    return steps;
}

std::string why_no_sun(std::span<const Step> steps, const Period& period, const sun::Place& place) {
    double highest_rad = -std::numbers::pi;
    for (const Step& step : steps) {
        if (step.counts) return {};
        highest_rad = std::max(highest_rad, step.sun.altitude_rad);
    }
    const double highest_deg = highest_rad / degree;
    const std::string date = sun::to_text(period.date);
    if (highest_deg <= 0.0) {
        return fmt::format(
            "On {} the sun stays below the horizon at {} from {}: its greatest "
            "altitude is {:.2f}\u00b0.",
            date, place_text(place), stretch_text(period), highest_deg);
    }
    return fmt::format(
        "On {} no sun counts at {} from {}: its greatest altitude is {:.2f}\u00b0, "
        "and the least altitude or the minutes left out at sunrise and sunset leave "
        "nothing.",
        date, place_text(place), stretch_text(period), highest_deg);
}

}  // namespace gnomon::sun_study
