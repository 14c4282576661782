// SPDX-License-Identifier: MIT
//
// The exact Euclidean distance transform of a picture.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::truth::internal {

/// Per pixel the squared distance, in pixels, from its centre to that of the nearest one that is a
/// site (not 0); infinite everywhere where there is none. Row by row, width * height of them. Cost:
/// linear. After P. F. Felzenszwalb and D. P. Huttenlocher, "Distance Transforms of Sampled
/// Functions" (2012).
[[nodiscard]] std::vector<double> squared_distances(std::span<const std::uint8_t> sites,
                                                    std::uint32_t width, std::uint32_t height);

}  // namespace gnomon::truth::internal
