// SPDX-License-Identifier: MIT
//
// Autopilot: wins a level, if that can be done unseen. What moves does so whatever the player does,
// so the autopilot can look at every place at every moment ahead, by the very queries that the
// light meter is fed by, find the darkest way through space and time, and walk it. It makes the
// recordings that come with the levels, and shows of a new level that it can be won.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>

#include "level.hpp"
#include "recording.hpp"
#include "timing.hpp"

namespace gnomon::game {

/// A way through space and time: where to be at every `slice`.
struct Plan {
    static constexpr Tick slice = 24;
    std::vector<glm::dvec2> places;
};

struct PlanOptions {
    double longest_s = 110.0;
    double brightest = 0.5;  ///< no place of the way is lit more than that (Reading::level)
};

/// The way from the start to the exit with the least light on it, time counted as well: dynamic
/// programming over a grid of half metres, slice by slice. Doors count as open. Fails with
/// ErrorCode::Unsupported where there is none. Cost: some seconds.
[[nodiscard]] Result<Plan> plan_way(const Level& level, const PlanOptions& options = {});

/// Plans, walks, and gives what was pressed. `name`: what the recording calls the level. Fails with
/// ErrorCode::Unsupported, one sentence, where it does not win.
[[nodiscard]] Result<Recording> play_by_itself(const Level& level, const std::string& name);

}  // namespace gnomon::game
