// SPDX-License-Identifier: MIT
//
// The plan pictures of a sun study: the profile of cast shadows, coloured by time, and the sun
// hours as a heat map with contour lines. Both have a title, a legend, a scale bar and a north
// arrow.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "profile/day_result.hpp"

namespace gnomon::cli {

struct PlanPicture {
    std::vector<std::byte> png;
    /// Its world file (.pgw): the six numbers that place its pixels in the plan's coordinates.
    std::string world_file;
};

[[nodiscard]] Result<PlanPicture> draw_profile(const Study& study, const DayResult& day);
[[nodiscard]] Result<PlanPicture> draw_hours(const Study& study, const DayResult& day);
/// What the model changes, against the one before: hours gained and lost.
[[nodiscard]] Result<PlanPicture> draw_difference(const Study& study, const DayResult& day,
                                                  const DayResult& before);

/// Hours more (or, below zero, less) than before; nothing where either has a roof.
[[nodiscard]] std::optional<double> hours_gained(const DayResult& day, const DayResult& before,
                                                 std::size_t cell);

}  // namespace gnomon::cli
