// SPDX-License-Identifier: MIT
//
// Perspective pictures of a sun study, coloured by sun hours: of its surfaces alone, and of the
// whole scene.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "profile/day_result.hpp"
#include "profile/perspective.hpp"

namespace gnomon::cli {

/// A PNG of the patches that are turned to the eye. `most_h` is what any could have. Fails as
/// Perspective::create() does.
[[nodiscard]] Result<std::vector<std::byte>> draw_surfaces(const Study& study,
                                                           const SurfaceResult& surfaces,
                                                           const sun::Date& date, double most_h,
                                                           const PictureCamera& camera);

/// A PNG of the plane and the casters on it: cells, and patches of `surfaces` where there are any,
/// by their hours; what casts and was not asked about in grey, shaded. Fails as
/// Perspective::create() does.
[[nodiscard]] Result<std::vector<std::byte>> draw_scene(const Study& study, const DayResult& day,
                                                        const SurfaceResult* surfaces,
                                                        std::span<const PlanCorners> casters,
                                                        const PictureCamera& camera);

}  // namespace gnomon::cli
