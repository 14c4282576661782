// SPDX-License-Identifier: MIT
//
// The sun-path diagram: the dome of the sky laid out as a map is, north on top and east to the
// right, with the way of the sun on each day and its place at whole hours.
#pragma once

#include <cstddef>
#include <vector>

#include "profile/study.hpp"

namespace gnomon::cli {

/// A PNG. Rings are altitudes, the outermost the horizon; distances from the middle are those of
/// the stereographic projection. Days beyond the first twelve are left out.
[[nodiscard]] Result<std::vector<std::byte>> draw_sun_path(const Study& study);

}  // namespace gnomon::cli
