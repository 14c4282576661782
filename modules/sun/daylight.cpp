// SPDX-License-Identifier: MIT
#include <gnomon/sun/daylight.hpp>

#include <numbers>

namespace gnomon::sun {

namespace {

bool is_up(Instant utc, const Place& place) {
    constexpr double rim_on_horizon_rad = -50.0 / 60.0 * std::numbers::pi / 180.0;
    return sun_position(utc, place).airless_altitude_rad > rim_on_horizon_rad;
}

// The first second at which it is up as `later` is.
Instant change_between(Instant earlier, Instant later, const Place& place) {
    const bool up_then = is_up(later, place);
    while (later - earlier > std::chrono::seconds(1)) {
        const Instant middle = earlier + (later - earlier) / 2;
        (is_up(middle, place) == up_then ? later : earlier) = middle;
    }
    return later;
}

}  // namespace

Daylight daylight_of(const Date& date, std::chrono::minutes offset, const Place& place) {
    constexpr std::chrono::minutes stride(5);
    const Instant midnight = instant_of(date, std::chrono::seconds(0), offset);
    Daylight day;
    bool up = day.begins_light = is_up(midnight, place);
    for (Instant at = midnight; at < midnight + std::chrono::hours(24); at += stride) {
        const bool up_next = is_up(at + stride, place);
        if (up_next == up) continue;
        auto& event = up_next ? day.sunrise : day.sunset;
        if (!event) event = change_between(at, at + stride, place);
        up = up_next;
    }
    return day;
}

}  // namespace gnomon::sun
