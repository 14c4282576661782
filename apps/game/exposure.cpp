// SPDX-License-Identifier: MIT
#include "exposure.hpp"

#include <algorithm>
#include <cstddef>

#include <gnomon/core/expects.hpp>

#include "timing.hpp"

namespace gnomon::game {

Reading read_exposure(const shadows::ShadowQueries& queries, std::span<const MeterLight> lights,
                      std::span<const glm::dvec3> points, double seen_lux,
                      std::span<const std::uint64_t> own) {
    GNOMON_EXPECTS(points.size() <= 32);  // a bit each
    Reading reading;
    reading.reached.assign(lights.size(), 0);
    std::vector<double> lux(points.size(), 0.0);
    const double too_dark = 1e-3 * seen_lux;
    for (std::size_t l = 0; l < lights.size(); ++l) {
        for (std::size_t p = 0; p < points.size(); ++p) {
            const double here = illuminance(lights[l], points[p]);
            if (here < too_dark) continue;
            if (queries.at(lights[l].shadow, points[p], {.ignored_casters = own}) !=
                shadows::Exposure::Lit) {
                continue;
            }
            reading.reached[l] |= std::uint32_t{1} << p;
            lux[p] += here;
        }
    }
    for (const double here : lux) reading.level += std::min(here / seen_lux, 1.0);
    if (!points.empty()) reading.level /= static_cast<double>(points.size());
    return reading;
}

Meter advanced(const Meter& meter, double level, double noise, double caught_after_s) {
    constexpr double smooth_s = 0.12;
    constexpr double forget_s = 3.0;
    Meter next = meter;
    next.light += (level - meter.light) * std::min(tick_s / smooth_s, 1.0);
    next.is_seen =
        meter.is_seen ? next.light > Meter::hidden_below : next.light >= Meter::seen_from;
    const double seen = std::max(next.is_seen ? next.light : 0.0, noise);
    next.alarm += seen > 0.0 ? seen * tick_s / caught_after_s : -tick_s / forget_s;
    next.alarm = std::clamp(next.alarm, 0.0, 1.0);
    return next;
}

}  // namespace gnomon::game
