// SPDX-License-Identifier: MIT
//
// What layer_bound() and split_volume() share: a set of casting faces with its boundary, bounded.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <gnomon/shadows/layer_bound.hpp>
#include <gnomon/shadows/silhouette.hpp>

namespace gnomon::shadows::internal {

/// Triples of a volume's near vertices, in any corner order: its caps.
using Caps = std::array<std::span<const std::uint32_t>, 2>;

/// No more layers than this for `sides` side quads and `faces` casting faces.
[[nodiscard]] std::uint32_t quick_bound(std::uint64_t faces, std::uint64_t sides,
                                        bool from_outside);

/// As layer_bound, of casting faces and their boundary.
[[nodiscard]] std::uint32_t bound_layers(const ShadowMesh& mesh, const Caps& casting,
                                         std::span<const SilhouetteEdge> boundary,
                                         const LayerSpace& space);

}  // namespace gnomon::shadows::internal
