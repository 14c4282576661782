// SPDX-License-Identifier: MIT
//
// Sunrise and sunset of a day at a place: when the sun's upper rim crosses the horizon of a flat
// Earth in standard air (its centre is then 50 arc minutes below, without refraction, as almanacs
// have it). Hills and houses are no part of it.
#pragma once

#include <optional>

#include <gnomon/sun/position.hpp>

namespace gnomon::sun {

/// The day is the place's own: from midnight to midnight by the clock. A day may have one of the
/// two alone, and none of them in the midnight sun or the polar night.
struct Daylight {
    std::optional<Instant> sunrise;
    std::optional<Instant> sunset;
    bool begins_light = false;  ///< the sun is up at midnight, when the day begins
};

/// To the second, but for days on which the sun grazes the horizon for less than five minutes.
/// Cost: some 300 positions of the sun.
[[nodiscard]] Daylight daylight_of(const Date& date, std::chrono::minutes offset,
                                   const Place& place);

}  // namespace gnomon::sun
