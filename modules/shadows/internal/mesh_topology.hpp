// SPDX-License-Identifier: MIT
//
// What of a ShadowMesh does not change when its vertices move: faces, edges, who uses whom, and the
// order that they are kept in.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/jobs.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>

namespace gnomon::shadows::internal {

/// Faces that follow each other: of one large component, or of several small ones that are open, or
/// of several small ones that are closed.
struct FaceGroup {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    bool one_component = false;
};

struct MeshTopology {
    std::size_t input_vertices = 0;
    std::vector<std::uint32_t> sources;  ///< by welded vertex: an input vertex that it came from
    std::vector<std::array<std::uint32_t, 3>> faces;
    std::vector<std::uint32_t> input_faces;
    std::vector<std::uint32_t> face_components;  ///< numbered by their first input face
    std::size_t components = 0;
    std::vector<Edge> edges;
    std::vector<FaceUse> uses;
    std::size_t regular_edges = 0;
    std::vector<std::array<std::uint32_t, 3>> face_edges;
    std::vector<FaceGroup> groups;

    [[nodiscard]] std::size_t memory_bytes() const;
};

/// Faces and edges in the order of the input and of their vertices; no groups yet. `faces` are
/// triples of welded vertices.
[[nodiscard]] MeshTopology connect(std::vector<std::array<std::uint32_t, 3>> faces,
                                   std::size_t vertices, const Jobs& jobs = {});

/// Brings faces and edges into an order in which neighbours have similar planes, which the tables
/// of detection are made from, and makes face_edges and groups. `planes`: of the faces as they are,
/// and brought into their order; `closed`: by component. Cost: O(n log n).
void order_by_planes(MeshTopology& topology, FacePlanes& planes,
                     std::span<const std::uint8_t> closed, const Jobs& jobs = {});

}  // namespace gnomon::shadows::internal
