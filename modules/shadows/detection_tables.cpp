// SPDX-License-Identifier: MIT
#include "internal/detection_tables.hpp"

#include "internal/run_jobs.hpp"

namespace gnomon::shadows::internal {

namespace {

std::size_t blocks_for(std::size_t items) { return (items + block_size - 1) / block_size; }

}  // namespace

DetectionTables make_tables(const ShadowMesh& mesh, const Jobs& jobs) {
    const FacePlanes& planes = mesh.planes();
    const auto uses = mesh.uses();
    std::vector<DualBounds> faces(blocks_for(mesh.faces().size()));
    run_pieces(jobs, mesh.faces().size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) faces[f / block_size].include(planes, f);
    });
    std::vector<DualBounds> edges(blocks_for(mesh.regular_edges()));
    run_pieces(jobs, mesh.regular_edges(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t u = 2 * begin; u < 2 * end; ++u) {
            edges[u / (2 * block_size)].include(planes, uses[u].face);
        }
    });
    return {DualBoxes(std::move(faces)), DualBoxes(std::move(edges))};
}

}  // namespace gnomon::shadows::internal
