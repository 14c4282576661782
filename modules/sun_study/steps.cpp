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

// From when to when the sun counts, by what is left out after sunrise and before sunset.
struct Window {
    std::optional<sun::Instant> begin;
    std::optional<sun::Instant> end;
};

Window window_of(const Period& period, const sun::Place& place, const SunRules& rules) {
    Window window;
    if (rules.skip_after_sunrise.count() == 0 && rules.skip_before_sunset.count() == 0) {
        return window;
    }
    const sun::Daylight day = sun::daylight_of(period.date, period.offset, place);
    if (day.sunrise) window.begin = *day.sunrise + rules.skip_after_sunrise;
    if (day.sunset) window.end = *day.sunset - rules.skip_before_sunset;
    return window;
}

}  // namespace

Result<std::vector<Step>> make_steps(const Period& period, const sun::Place& place,
                                     const sun::Air& air, const SunRules& rules) {
    const std::string date = sun::to_text(period.date);
    const std::string stretch =
        fmt::format("{} to {} ({})", sun::clock_text(period.from), sun::clock_text(period.to),
                    sun::offset_text(period.offset));
    if (period.to <= period.from) {
        return fail(
            ErrorCode::InvalidInput,
            fmt::format("The time from {} is empty: it has to end after it begins.", stretch));
    }
    if (period.from + period.step > period.to) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("A step of {} s does not fit into the time from {}: at least two "
                                "steps are needed.",
                                period.step.count(), stretch));
    }
    const Window window = window_of(period, place, rules);
    std::vector<Step> steps;
    double highest_rad = -std::numbers::pi;
    bool any = false;
    for (std::chrono::seconds clock = period.from; clock <= period.to; clock += period.step) {
        Step step;
        step.clock = clock;
        step.utc = sun::instant_of(period.date, clock, period.offset);
        step.sun = sun::sun_position(step.utc, place, air);
        const double altitude = step.sun.altitude_rad;
        step.counts = altitude > 0.0 && altitude >= rules.min_altitude_rad &&
                      (!window.begin || step.utc >= *window.begin) &&
                      (!window.end || step.utc <= *window.end);
        step.half_seconds = static_cast<std::uint32_t>(2 * period.step.count());
        highest_rad = std::max(highest_rad, altitude);
        any = any || step.counts;
        steps.push_back(step);
    }
    steps.front().half_seconds /= 2;
    steps.back().half_seconds /= 2;
    if (!any) {
        const double highest_deg = highest_rad / degree;
        if (highest_deg <= 0.0) {
            return fail(ErrorCode::InvalidInput,
                        fmt::format("On {} the sun stays below the horizon at {} from {}: its "
                                    "greatest altitude is {:.2f}\u00b0.",
                                    date, place_text(place), stretch, highest_deg));
        }
        return fail(ErrorCode::InvalidInput,
                    fmt::format("On {} no sun counts at {} from {}: its greatest altitude is "
                                "{:.2f}\u00b0, and the least altitude or the minutes left out at "
                                "sunrise and sunset leave nothing.",
                                date, place_text(place), stretch, highest_deg));
    }
    return steps;
}

}  // namespace gnomon::sun_study
