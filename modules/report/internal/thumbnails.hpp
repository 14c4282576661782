// SPDX-License-Identifier: MIT
//
// Small pictures for the page: masks, and where they are wrong.
#pragma once

#include <gnomon/report/report.hpp>

#include "technique.hpp"

namespace gnomon::report::internal {

/// At most this wide; a picture of more pixels shows the worst of those that fall together.
inline constexpr std::uint32_t thumbnail_width = 240;

/// Dark where any light's mask is; grey where nothing is judged.
[[nodiscard]] Thumbnail mask_thumbnail(const std::vector<truth::Picture>& truth,
                                       const Masks& masks);
/// What is true, in the same colours.
[[nodiscard]] Thumbnail truth_thumbnail(const std::vector<truth::Picture>& truth);
/// Red: shadow where there is none. Blue: light where there is none. Pale: within the band.
[[nodiscard]] Thumbnail difference_thumbnail(const std::vector<truth::Picture>& truth,
                                             const Masks& masks);

}  // namespace gnomon::report::internal
