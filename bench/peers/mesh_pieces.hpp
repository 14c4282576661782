// SPDX-License-Identifier: MIT
//
// A mesh in pieces that 16-bit indices can name.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "scenes.hpp"

namespace gnomon::peers {

struct MeshPiece {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<std::uint16_t> indices;
};

/// The triangles in their order, in pieces of at most `max_vertices` (3 .. 65,536) vertices each;
/// vertices on the border between pieces are in both.
[[nodiscard]] inline std::vector<MeshPiece> split_mesh(const PeerMesh& mesh,
                                                       std::size_t max_vertices) {
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<MeshPiece> pieces(1);
    std::vector<std::uint32_t> place(mesh.positions.size(), none);  // in the last piece
    std::vector<std::uint32_t> placed;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        if (pieces.back().positions.size() + 3 > max_vertices) {
            pieces.emplace_back();
            for (const std::uint32_t vertex : placed) place[vertex] = none;
            placed.clear();
        }
        MeshPiece& piece = pieces.back();
        for (std::size_t corner = i; corner < i + 3; ++corner) {
            const std::uint32_t vertex = mesh.indices[corner];
            if (place[vertex] == none) {
                place[vertex] = static_cast<std::uint32_t>(piece.positions.size());
                placed.push_back(vertex);
                piece.positions.push_back(mesh.positions[vertex]);
                piece.normals.push_back(mesh.normals[vertex]);
            }
            piece.indices.push_back(static_cast<std::uint16_t>(place[vertex]));
        }
    }
    return pieces;
}

}  // namespace gnomon::peers
