// SPDX-License-Identifier: MIT
//
// Silhouettes: the boundary of the weighted faces, edge by edge. This is the plain way;
// detector.hpp has those that find the same edges faster.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <gnomon/shadows/shadow_mesh.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// `count` > 0: the weighted faces run from -> to that many times more than back. Always > 0.
struct SilhouetteEdge {
    std::uint32_t from = 0;  ///< a vertex of the mesh
    std::uint32_t to = 0;    ///< the other one
    std::int32_t count = 0;  ///< how often
    auto operator<=>(const SilhouetteEdge&) const = default;
};

/// Appends nothing: replaces `out`. Works for any weights on any mesh. Cost: linear in the edges.
void find_silhouette(const ShadowMesh& mesh, std::span<const std::int8_t> weights,
                     std::vector<SilhouetteEdge>& out);

}  // namespace gnomon::shadows
#pragma GCC visibility pop
