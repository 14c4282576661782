// SPDX-License-Identifier: MIT
#include "internal/detection_tables.hpp"

namespace gnomon::shadows::internal {

DetectionTables make_tables(const ShadowMesh& mesh) {
    const FacePlanes& planes = mesh.planes();
    const std::size_t faces = mesh.faces().size();
    DetectionTables tables;
    std::vector<DualBounds> blocks((faces + block_size - 1) / block_size);
    for (std::size_t f = 0; f < faces; ++f) blocks[f / block_size].include(planes, f);
    tables.faces = DualBoxes(std::move(blocks));
    blocks.assign((mesh.regular_edges() + block_size - 1) / block_size, {});
    const auto uses = mesh.uses();
    for (std::size_t u = 0; u < 2 * mesh.regular_edges(); ++u) {
        blocks[u / (2 * block_size)].include(planes, uses[u].face);
    }
    tables.edges = DualBoxes(std::move(blocks));
    return tables;
}

}  // namespace gnomon::shadows::internal
