// SPDX-License-Identifier: MIT
//
// Silhouettes: the boundary of the weighted faces, edge by edge. Strategies that find the same
// edges faster take their place beside brute_force, behind the same name table.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <gnomon/shadows/shadow_mesh.hpp>

namespace gnomon::shadows {

/// `count` > 0: the weighted faces run from -> to that many times more than back. Always > 0.
struct SilhouetteEdge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::int32_t count = 0;
    auto operator<=>(const SilhouetteEdge&) const = default;
};

/// Appends nothing: replaces `out`. Works for any weights on any mesh. Cost: linear in the edges.
void find_silhouette(const ShadowMesh& mesh, std::span<const std::int8_t> weights,
                     std::vector<SilhouetteEdge>& out);

struct SilhouetteStrategy {
    std::string_view name;
    std::string_view summary;
    void (*find)(const ShadowMesh&, std::span<const std::int8_t>, std::vector<SilhouetteEdge>&);
};

/// All strategies, by name; "auto" is not among them: it is the choice between them.
[[nodiscard]] std::span<const SilhouetteStrategy> silhouette_strategies();

}  // namespace gnomon::shadows
