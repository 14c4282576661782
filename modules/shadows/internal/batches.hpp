// SPDX-License-Identifier: MIT
//
// Splits the volumes of one light into batches that can be counted one by one, where they could lay
// more layers over a point than the stencil counts.
#pragma once

#include <cstdint>
#include <span>

#include <gnomon/shadows/volume.hpp>

#include "pair.hpp"

namespace gnomon::shadows::internal {

/// A pair that has a volume, of the light at hand.
struct DrawnPair {
    std::uint32_t slot = 0;  ///< the caster's
    const CasterState* caster = nullptr;
    const Volume* volume = nullptr;
    std::uint64_t revision = 0;
    bool quads = false;  ///< the GPU makes its volume
};

/// Whether no more layers than `limit` lie over any point, by the pairs' layers as they are. Cost:
/// O(n log n).
[[nodiscard]] bool fit_together(LightState& light, std::uint32_t limit,
                                std::span<const DrawnPair> pairs);

/// The light's pairs with volumes of the CPU's, by caster key. Where more layers than `limit`
/// cannot be ruled out, the light's pieces become draws in batches of no more than min(limit, 127)
/// each, ascending, volumes that alone exceed that in parts; else it has none. Returns the number
/// of batches. Cost: a comparison where nothing changed since the last call; else O(n log n), and
/// layer_bound() for the volumes that changed.
std::uint32_t split_into_batches(LightState& light, std::uint32_t limit,
                                 std::span<const DrawnPair> pairs);

}  // namespace gnomon::shadows::internal
