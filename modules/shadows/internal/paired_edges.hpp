// SPDX-License-Identifier: MIT
//
// A mesh's edges sorted into the regular ones, which two faces run along in opposite directions,
// and all the rest. The literature knows the regular ones alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <gnomon/shadows/shadow_mesh.hpp>
#include <gnomon/shadows/silhouette.hpp>

namespace gnomon::shadows::internal {

struct PairedEdge {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    std::uint32_t forth = 0;  ///< the face that runs low -> high
    std::uint32_t back = 0;   ///< the face that runs high -> low
};

struct PairedEdges {
    std::vector<PairedEdge> pairs;
    std::vector<std::uint32_t> others;  ///< of ShadowMesh::edges()

    [[nodiscard]] std::size_t bytes() const {
        return pairs.capacity() * sizeof(PairedEdge) + others.capacity() * sizeof(std::uint32_t);
    }
};

[[nodiscard]] PairedEdges pair_edges(const ShadowMesh& mesh);

/// Appends the edge where the sum of its signed weights is not 0.
inline void append_edge(std::uint32_t low, std::uint32_t high, std::int32_t sum,
                        std::vector<SilhouetteEdge>& silhouette) {
    if (sum > 0) silhouette.push_back({low, high, sum});
    if (sum < 0) silhouette.push_back({high, low, -sum});
}

inline void append_edge(const PairedEdge& edge, std::span<const std::int8_t> weights,
                        std::vector<SilhouetteEdge>& silhouette) {
    append_edge(edge.low, edge.high, weights[edge.forth] - weights[edge.back], silhouette);
}

/// The same for edges of the mesh with any uses, named by their places in ShadowMesh::edges().
void append_edges(const ShadowMesh& mesh, std::span<const std::uint32_t> edges,
                  std::span<const std::int8_t> weights, std::vector<SilhouetteEdge>& silhouette);

}  // namespace gnomon::shadows::internal
