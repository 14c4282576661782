// SPDX-License-Identifier: MIT
//
// MeshCaps: the near caps of all faces of a mesh, three indices each, in the mesh's order. Uploaded
// when a volume first draws a range of them, and never again.
#pragma once

#include <cstdint>
#include <unordered_map>

#include <gnomon/core/result.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>

#include "index_arena.hpp"

namespace gnomon::shadow_pass::internal {

class MeshCaps {
public:
    /// `arena` is handed to each call, always the same one. Adds what it uploads to `bytes`.
    Result<IndexRun> get(IndexArena& arena, const shadows::ShadowMesh& mesh,
                         std::uint64_t generation, std::uint64_t& bytes);
    /// Frees those that were not asked for in `patience` generations before this one.
    void free_unused(IndexArena& arena, std::uint64_t generation, std::uint64_t patience);

private:
    struct Caps {
        IndexRun run;
        std::uint64_t used = 0;
    };
    std::unordered_map<std::uint64_t, Caps> meshes_;  // by ShadowMesh::id
};

}  // namespace gnomon::shadow_pass::internal
