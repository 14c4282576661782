// SPDX-License-Identifier: MIT
//
// Why a mask of shadow volumes may be wrong where it is exact by construction: a side that is seen
// edge-on. It covers next to nothing of the picture, and its depth runs through all that there is
// within that; a rasteriser that rounds corners to a part of a pixel cannot tell on which side of a
// surface it lies.
#pragma once

#include <cstdint>

#include <gnomon/shadows/shadow_system.hpp>

namespace gnomon::report::internal {

/// To what rasterisers round: 8 bits below a pixel.
inline constexpr double rounding_px = 1.0 / 256.0;

struct Pixel {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
};
struct PictureSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

/// Whether the middle of a pixel lies within rounding_px of all three lines that bound a side
/// triangle of some volume of this light. Volumes that the GPU makes have none here. Cost: linear
/// in the triangles.
[[nodiscard]] bool is_on_a_side_seen_edge_on(const shadows::DrawList& list, std::uint64_t light,
                                             const shadows::View& view, PictureSize size,
                                             Pixel pixel);

}  // namespace gnomon::report::internal
