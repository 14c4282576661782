// SPDX-License-Identifier: MIT
//
// MeshRuns: what a mesh has in an arena, whichever lights there are: the near caps of all its
// faces, or its vertices. Uploaded when a volume first draws it, and never again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>

#include "buffer_arena.hpp"

namespace gnomon::shadow_pass::internal {

/// Three indices a face, in the mesh's order.
void append_near_caps(const shadows::ShadowMesh& mesh, std::vector<std::byte>& out);
/// Each position twice: near vertex and far vertex. Two of them are one element of the arena.
void append_doubled_positions(const shadows::ShadowMesh& mesh, std::vector<std::byte>& out);

class MeshRuns {
public:
    using Contents = void (*)(const shadows::ShadowMesh&, std::vector<std::byte>&);
    explicit MeshRuns(Contents contents) : contents_(contents) {}

    struct Kept {
        ArenaRun run;
        std::uint64_t used = 0;  ///< the generation
    };
    /// `arena` is handed to each call, always the same one. Adds what it uploads to `bytes`. The
    /// entry stays where it is until it is freed.
    Result<Kept*> get(BufferArena& arena, const shadows::ShadowMesh& mesh, std::uint64_t generation,
                      std::uint64_t& bytes);
    /// Frees those that were not asked for in `patience` generations before this one.
    void free_unused(BufferArena& arena, std::uint64_t generation, std::uint64_t patience);
    /// After BufferArena::clear().
    void clear() { meshes_.clear(); }

private:
    Contents contents_;
    std::unordered_map<std::uint64_t, Kept> meshes_;  // by ShadowMesh::id
};

}  // namespace gnomon::shadow_pass::internal
