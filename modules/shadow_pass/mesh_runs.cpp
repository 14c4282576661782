// SPDX-License-Identifier: MIT
#include "internal/mesh_runs.hpp"

#include <array>
#include <span>

#include <glm/glm.hpp>

namespace gnomon::shadow_pass::internal {

namespace {

template <class T, std::size_t N>
void append_bytes(const std::array<T, N>& values, std::vector<std::byte>& out) {
    const auto bytes = std::as_bytes(std::span(values));
    out.insert(out.end(), bytes.begin(), bytes.end());
}

}  // namespace

void append_near_caps(const shadows::ShadowMesh& mesh, std::vector<std::byte>& out) {
    out.reserve(out.size() + 12 * mesh.faces().size());
    for (const auto& [a, b, c] : mesh.faces()) {
        append_bytes(std::array<std::uint32_t, 3>{2 * a, 2 * b, 2 * c}, out);
    }
}

void append_doubled_positions(const shadows::ShadowMesh& mesh, std::vector<std::byte>& out) {
    out.reserve(out.size() + 24 * mesh.positions().size());
    for (const glm::vec3& p : mesh.positions()) append_bytes(std::array<glm::vec3, 2>{p, p}, out);
}

Result<MeshRuns::Kept*> MeshRuns::get(BufferArena& arena, const shadows::ShadowMesh& mesh,
                                      std::uint64_t generation, std::uint64_t& bytes) {
    if (const auto found = meshes_.find(mesh.id()); found != meshes_.end()) {
        found->second.used = generation;
        return &found->second;
    }
    std::vector<std::byte> contents;
    contents_(mesh, contents);
    const auto run = arena.upload(contents);
    if (!run) return forward_error(run);
    bytes += contents.size();
    return &meshes_.emplace(mesh.id(), Kept{*run, generation}).first->second;
}

void MeshRuns::free_unused(BufferArena& arena, std::uint64_t generation, std::uint64_t patience) {
    std::erase_if(meshes_, [&](const auto& entry) {
        const bool unused = entry.second.used + patience < generation;
        if (unused) arena.free(entry.second.run);
        return unused;
    });
}

}  // namespace gnomon::shadow_pass::internal
