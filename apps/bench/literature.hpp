// SPDX-License-Identifier: MIT
//
// The comparisons that papers on silhouettes print: a frame's work on the CPU with one way to the
// silhouette or another, and with none at all.
#pragma once

#include <string_view>
#include <vector>

#include "contest.hpp"

namespace gnomon::bench {

/// Whether the strategy is one of the literature's that have no memory of the frame before, so that
/// nothing is learned from running them on every motion.
[[nodiscard]] bool is_of_the_literature(std::string_view strategy);

/// Whether its detector keeps nothing that depends on the lights it saw.
[[nodiscard]] bool is_memoryless(const shadows::SilhouetteStrategy& strategy);

/// Every strategy, with the volume built from what it finds.
[[nodiscard]] std::vector<Contestant> with_volumes();
/// "none": looks for no silhouette, but builds a volume that extrudes each edge of each face that
/// casts. The same shadow: what two faces extrude in opposite directions cancels in the counts.
[[nodiscard]] Contestant without_silhouette();

}  // namespace gnomon::bench
