// SPDX-License-Identifier: MIT
//
// A perspective picture of the surfaces of a sun study, coloured by their sun hours.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "profile/day_result.hpp"

namespace gnomon::cli {

/// Where it is looked from and at, in plan coordinates; by default from above, from the side that
/// the sun comes from, at all of it.
struct SurfaceCamera {
    std::optional<glm::dvec3> eye_plan;
    std::optional<glm::dvec3> target_plan;
};

/// A PNG. Patches that look away are left out, nearer ones are painted over farther ones. `most_h`
/// is what any could have. Fails with ErrorCode::InvalidInput where eye and target are one point.
[[nodiscard]] Result<std::vector<std::byte>> draw_surfaces(const Study& study,
                                                           const SurfaceResult& surfaces,
                                                           const sun::Date& date, double most_h,
                                                           const SurfaceCamera& camera);

}  // namespace gnomon::cli
