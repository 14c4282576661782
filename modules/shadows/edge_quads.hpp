// SPDX-License-Identifier: MIT
//
// Edge quads: a closed caster's shadow volume without its silhouette. Every edge has a side quad
// and every face a near and a far cap, all degenerate but where the two faces of an edge differ or
// the face casts; a vertex shader finds that out, so that the CPU has nothing to do for each light.
// After R. Surdulescu, "Cg Shadow Volumes" (2001-2003), and C. Brennan, "Shadow Volume Extrusion
// using a Vertex Shader" (2002), but for one thing: both decide by the normal of a vertex, which
// can split a face. Here a face is asked as a whole, and all vertices that ask for it get the same
// answer; so the volume is closed, whatever the answers are.
//
// This is the mesh, and what a shader makes of it, as plain functions; gnomon::shadow_pass draws
// it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <gnomon/shadows/detector.hpp>
#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>
#include <gnomon/shadows/volume.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// An edge between two positions, a the lexicographically smaller one, and its two faces.
struct EdgeQuad {
    std::uint32_t a = 0;      ///< a vertex of the mesh
    std::uint32_t b = 0;      ///< the other one
    std::uint32_t along = 0;  ///< the face that runs a -> b
    std::uint32_t back = 0;   ///< the face that runs b -> a
    auto operator<=>(const EdgeQuad&) const = default;
};

/// True where every edge has two faces that run along it in opposite directions and no component is
/// inside out: what edge quads can draw. Cost: linear in the components.
[[nodiscard]] bool fits_edge_quads(const ShadowMesh& mesh);

/// One for each edge of a mesh that fits_edge_quads(), in no order to rely on.
[[nodiscard]] std::vector<EdgeQuad> edge_quads(const ShadowMesh& mesh);

/// One bit a face: bit f % 32 of word f / 32 says whether face f casts.
using FaceBits = std::vector<std::uint32_t>;
/// Whether a face's bit is set.
[[nodiscard]] inline bool casts(std::span<const std::uint32_t> bits, std::uint32_t face) {
    return (bits[face / 32] >> (face % 32) & 1U) != 0;
}
/// Of Facing::weights: whether they are not 0.
[[nodiscard]] FaceBits face_bits(std::span<const std::int8_t> weights);

/// What the shader decides by itself: the sign of a dot product of the face's plane
/// (ShadowMesh::planes) with the light, in single precision, unfiltered: faces that are all but
/// edge-on may come out either way. What `near_caps` says casts.
[[nodiscard]] FaceBits face_bits_in_single_precision(const ShadowMesh& mesh, LightLocal light,
                                                     NearCaps near_caps);

/// What the shader multiplies a plane (normal, offset) with.
[[nodiscard]] glm::vec4 light_of_planes(const ShadowMesh& mesh, LightLocal light);

/// How the shader knows what casts.
struct QuadCasting {
    QuadFacing facing = QuadFacing::Uploaded;  ///< not None
    NearCaps near_caps = NearCaps::Facing;     ///< which side casts, and carries the near caps
    std::shared_ptr<const FaceBits> bits = nullptr;  ///< Uploaded; null else
    LightLocal light = {};                           ///< as the far vertices have it
};

/// For how far the light may move and every component still casts one-sided, which is what edge
/// quads take for granted: in metres, or without end for a directional light. nullopt where one
/// does not as it is, or the light is not finite. Cost: linear in the components.
[[nodiscard]] std::optional<double> one_sided_margin(const ShadowMesh& mesh, LightLocal light);

/// More layers than this the quads cannot lay over a point: a line that runs through a closed mesh
/// from outside meets as many faces that cast as faces that do not.
[[nodiscard]] std::uint32_t quad_layer_bound(const ShadowMesh& mesh, const QuadCasting& casting);

/// The vertices of the quads as the shader numbers them: `side_vertices` for each edge, three for
/// each near cap, three for each far cap.
struct QuadRanges {
    std::uint32_t side_vertices =
        6;                ///< of each edge: two triangles, or one where far vertices are one point
    IndexRange sides;     ///< of all edges
    IndexRange near_cap;  ///< of all faces
    IndexRange far_cap;   ///< empty where all far vertices are one point
};
/// `one_far_point`: the light is directional and the far vertices are at infinity.
[[nodiscard]] QuadRanges quad_ranges(const ShadowMesh& mesh, bool one_far_point);

/// What the shader does, vertex by vertex (shaders/quads.glsl says the same in other words). Gives
/// a vertex of the volume, as Volume::indices has them; nullopt: its triangle is degenerate.
/// Triangles and the order of their corners are those of build_volume() for the same weights.
[[nodiscard]] std::optional<std::uint32_t> quad_vertex(const ShadowMesh& mesh,
                                                       std::span<const EdgeQuad> quads,
                                                       const QuadRanges& ranges,
                                                       std::span<const std::uint32_t> bits,
                                                       NearCaps near_caps, std::uint32_t vertex);

/// All of it, without what is degenerate: for debug views, hosts whose vertex stage is not theirs,
/// and tests. Cost: linear in the mesh.
[[nodiscard]] Volume quad_volume(const ShadowMesh& mesh, std::span<const std::uint32_t> bits,
                                 NearCaps near_caps, bool one_far_point);

}  // namespace gnomon::shadows
#pragma GCC visibility pop
