// SPDX-License-Identifier: MIT
#include "paired_edges.hpp"

namespace gnomon::shadows::internal {

PairedEdges pair_edges(const ShadowMesh& mesh) {
    PairedEdges result;
    const std::size_t regular = mesh.regular_edges();
    result.pairs.reserve(regular);
    for (std::size_t e = 0; e < regular; ++e) {
        const Edge& edge = mesh.edges()[e];
        result.pairs.push_back(
            {edge.low, edge.high, mesh.uses()[2 * e].face, mesh.uses()[2 * e + 1].face});
    }
    for (std::size_t e = regular; e < mesh.edges().size(); ++e) {
        result.others.push_back(static_cast<std::uint32_t>(e));
    }
    return result;
}

void append_edges(const ShadowMesh& mesh, std::span<const std::uint32_t> edges,
                  std::span<const std::int8_t> weights, std::vector<SilhouetteEdge>& silhouette) {
    for (const std::uint32_t e : edges) {
        const Edge& edge = mesh.edges()[e];
        std::int32_t sum = 0;
        for (const FaceUse& use : mesh.uses(edge)) sum += use.sign() * weights[use.face];
        append_edge(edge.low, edge.high, sum, silhouette);
    }
}

}  // namespace gnomon::shadows::internal
