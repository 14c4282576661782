// SPDX-License-Identifier: MIT
//
// Covers: which triangles close a beam off for certain. A set of triangles covers the whole beam
// when it has no boundary inside it: every edge that enters the beam has, in the set, a triangle on
// either side as seen from the apex. That is decided from shared corners, not from areas, so a
// T-junction or an unwelded seam is never taken for closed, however thin the crack.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::truth::internal {

/// A triangle's part in a beam.
struct Tile {
    std::array<std::uint32_t, 3> corners{};  ///< ids; equal where positions are
    bool towards = false;                    ///< seen from the apex it runs counter-clockwise
    bool usable = false;  ///< it may belong to a cover: not edge-on, not cut by the beam's ends
    std::uint8_t edges_inside = 0;  ///< bit k: its edge from corner k enters the beam
};

inline constexpr int no_cover = -1;

/// Writes which cover each tile belongs to (0, 1, …, or no_cover) and returns how many there are.
/// Covers are as large as they can be and share no edge. Cost: n log n, but n * n for long open
/// strips.
int find_covers(std::span<const Tile> tiles, std::vector<int>& cover_of);

}  // namespace gnomon::truth::internal
