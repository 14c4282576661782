// SPDX-License-Identifier: MIT
//
// Exposure: how well a figure can be seen, from gnomon's shadow queries at a handful of its points
// under every light, and what follows from being seen for long.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/shadow_query.hpp>

#include "level.hpp"
#include "lights.hpp"

namespace gnomon::game {

/// What one look at all lights says.
struct Reading {
    double level = 0.0;  ///< 0: dark all over, 1: every point has seen_lux or more
    /// Bit p of entry l: point p is reached by light l (of meter_lights()), and by enough of it to
    /// matter.
    std::vector<std::uint32_t> reached;
};

/// Of 32 points at most. The keys in `own` are looked through: nobody hides in their own shadow. A
/// point on which a light sheds less than a thousandth of `seen_lux` is not asked about.
[[nodiscard]] Reading read_exposure(const shadows::ShadowQueries& queries,
                                    std::span<const MeterLight> lights,
                                    std::span<const glm::dvec3> points, double seen_lux,
                                    std::span<const std::uint64_t> own);

/// The meter that the player sees, and the patience of who watches. Plain data.
struct Meter {
    double light = 0.0;    ///< the reading, smoothed, 0 to 1
    bool is_seen = false;  ///< with hysteresis: begins at `seen_from`, ends at `hidden_below`
    double alarm = 0.0;    ///< 1: caught

    static constexpr double seen_from = 0.30;
    static constexpr double hidden_below = 0.18;
};

/// One tick. `noise` adds to what is seen: 0 to 1.
[[nodiscard]] Meter advanced(const Meter& meter, double level, double noise, double caught_after_s);

}  // namespace gnomon::game
