// SPDX-License-Identifier: MIT
#include <gnomon/shadows/silhouette.hpp>

namespace gnomon::shadows {

void find_silhouette(const ShadowMesh& mesh, std::span<const std::int8_t> weights,
                     std::vector<SilhouetteEdge>& out) {
    out.clear();
    const auto uses = mesh.uses();
    for (const Edge& edge : mesh.edges()) {
        std::int32_t sum = 0;
        for (std::uint32_t i = edge.first_use; i < edge.first_use + edge.use_count; ++i) {
            sum += uses[i].sign() * weights[uses[i].face];
        }
        if (sum > 0) out.push_back({edge.low, edge.high, sum});
        if (sum < 0) out.push_back({edge.high, edge.low, -sum});
    }
}

}  // namespace gnomon::shadows
