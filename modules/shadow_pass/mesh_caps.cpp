// SPDX-License-Identifier: MIT
#include "internal/mesh_caps.hpp"

#include <vector>

namespace gnomon::shadow_pass::internal {

Result<IndexRun> MeshCaps::get(IndexArena& arena, const shadows::ShadowMesh& mesh,
                               std::uint64_t generation, std::uint64_t& bytes) {
    if (const auto found = meshes_.find(mesh.id()); found != meshes_.end()) {
        found->second.used = generation;
        return found->second.run;
    }
    std::vector<std::uint32_t> indices;
    indices.reserve(3 * mesh.faces().size());
    for (const auto& [a, b, c] : mesh.faces()) {
        indices.insert(indices.end(), {2 * a, 2 * b, 2 * c});
    }
    auto run = arena.upload(indices);
    if (!run) return run;
    bytes += indices.size() * sizeof(std::uint32_t);
    meshes_.emplace(mesh.id(), Caps{*run, generation});
    return run;
}

void MeshCaps::free_unused(IndexArena& arena, std::uint64_t generation, std::uint64_t patience) {
    std::erase_if(meshes_, [&](const auto& entry) {
        const bool unused = entry.second.used + patience < generation;
        if (unused) arena.free(entry.second.run);
        return unused;
    });
}

}  // namespace gnomon::shadow_pass::internal
