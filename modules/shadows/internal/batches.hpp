// SPDX-License-Identifier: MIT
//
// Splits the volumes of one light into batches that can be counted one by one, where they could lay
// more layers over a point than the stencil counts.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/shadows/technique.hpp>

#include "pair.hpp"

namespace gnomon::shadows::internal {

/// A pair whose volume is drawn this frame.
struct DrawnPair {
    PairState* pair = nullptr;
    OrientedBounds bounds;
};

/// `draws` are the light's, one for each of `pairs`. Where more than `limit` layers cannot be ruled
/// out, volumes that alone could exceed min(limit, 127) are replaced by their parts, and draws get
/// batches of no more than that, ascending. Returns the number of batches. Cost: a sum over the
/// pairs when that is within the limit or nothing changed; else O(n log n), and layer_bound() for
/// the volumes that changed.
[[nodiscard]] std::uint32_t split_into_batches(LightState& light, std::uint32_t limit,
                                               std::span<const DrawnPair> pairs,
                                               std::vector<VolumeDraw>& draws);

}  // namespace gnomon::shadows::internal
