// SPDX-License-Identifier: MIT
//
// What layer_bound() and split_volume() share: a set of casting faces with its boundary, bounded.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <gnomon/shadows/layer_bound.hpp>
#include <gnomon/shadows/silhouette.hpp>
#include <gnomon/shadows/volume.hpp>

namespace gnomon::shadows::internal {

/// Triples of near vertices, and faces of ranges without those that are undone.
struct CastingFaces {
    std::span<const std::uint32_t> triples;
    std::span<const FaceRange> ranges = {};
    std::span<const std::uint32_t> undone = {};

    [[nodiscard]] std::uint64_t count() const {
        std::uint64_t faces = triples.size() / 3;
        for (const FaceRange& range : ranges) faces += range.count;
        return faces - undone.size() / 3;
    }
};

/// What the sides of a volume were made from, in their order. Replaces `silhouette`.
void silhouette_of(const Volume& volume, std::vector<SilhouetteEdge>& silhouette);

/// No more layers than this for `sides` side quads and `faces` casting faces.
[[nodiscard]] std::uint32_t quick_bound(std::uint64_t faces, std::uint64_t sides,
                                        bool from_outside);

/// What layers are bounded on: each grid has twice as many cells a side as the one before it, Fine
/// four times as many, and takes as many times as long where edges are few. Best is Full, and Fine
/// as well where that finds many: that costs less than a volume that is split for nothing. For a
/// light among the faces it is Full alone.
enum class Grid : std::uint8_t { Half, Full, Fine, Best };

inline constexpr std::uint32_t many_layers = 127;

/// As layer_bound, of casting faces and their boundary.
[[nodiscard]] std::uint32_t bound_layers(const ShadowMesh& mesh, const CastingFaces& casting,
                                         std::span<const SilhouetteEdge> boundary,
                                         const LayerSpace& space, Grid grid = Grid::Best);

/// As layer_bound, which is on the best grid.
[[nodiscard]] std::uint32_t layer_bound_on(Grid grid, const ShadowMesh& mesh, const Volume& volume,
                                           const LayerSpace& space);

}  // namespace gnomon::shadows::internal
