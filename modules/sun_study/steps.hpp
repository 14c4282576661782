// SPDX-License-Identifier: MIT
//
// Steps of a sun study: the instants of a day that are looked at, where the sun stands at each, and
// how much time each stands for.
//
// Sun hours are the trapezoidal rule over a day's steps: a step stands for half of the time to the
// step before it and half of that to the one after, so that together they stand for the time from
// the first to the last one.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/sun/position.hpp>

namespace gnomon::sun_study {

/// A day's stretch of time, by the place's own clock.
struct Period {
    sun::Date date{};
    std::chrono::minutes from{0};
    std::chrono::minutes to{0};
    std::chrono::seconds step{600};
    std::chrono::minutes offset{0};  ///< of the clock from UTC
};

/// When the sun counts. All must hold; a sun that is not above the horizon never counts.
struct SunRules {
    double min_altitude_rad = 0.0;  ///< as it is seen, refraction included
    std::chrono::minutes skip_after_sunrise{0};
    std::chrono::minutes skip_before_sunset{0};
};

struct Step {
    std::chrono::seconds clock{0};  ///< since the day's midnight
    sun::Instant utc{};
    sun::SunPosition sun;
    /// How much time it stands for. In half seconds, so that sums are exact in whatever order.
    std::uint32_t half_seconds = 0;
    bool counts = false;  ///< else it is dark everywhere, by the rules
};

inline constexpr double half_seconds_an_hour = 7200.0;

/// From `from` on, every `step`, while not after `to`. Fails with ErrorCode::InvalidInput, and one
/// sentence: `to` not after `from`, or less than two steps. A sun that counts at none of them is
/// none of that: a polar night is a day without sun.
[[nodiscard]] Result<std::vector<Step>> make_steps(const Period& period, const sun::Place& place,
                                                   const sun::Air& air, const SunRules& rules);

/// In one sentence, why the sun counts at none of a day's steps; empty where it does at some.
[[nodiscard]] std::string why_no_sun(std::span<const Step> steps, const Period& period,
                                     const sun::Place& place);

}  // namespace gnomon::sun_study
