// SPDX-License-Identifier: MIT
//
// A public hierarchy to compare with: meshoptimizer's clusters with normal cones, as renderers cull
// them by. A cluster whose cone says that all its faces are towards the light, or all averted, is
// done; its inner edges are never in the silhouette. The rest is looked at face by face.
#pragma once

#include <optional>

#include "contest.hpp"

namespace gnomon::bench {

/// Nothing where meshoptimizer was not found at build time. For meshes whose components are all
/// closed and not inside out, with a light outside their bounds; of others it is brute force.
[[nodiscard]] std::optional<Contestant> meshlets();

}  // namespace gnomon::bench
