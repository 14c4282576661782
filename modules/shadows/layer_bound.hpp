// SPDX-License-Identifier: MIT
//
// How many layers of shadow one volume can lay over a point: what a stencil of eight bits has to
// count. A bound from above, never below the truth. Where it exceeds what can be counted, a volume
// is split into closed parts that do not (docs/conventions.md, "Wrap, never clamp"). The
// ShadowSystem does all that by itself.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/shadow_mesh.hpp>
#include <gnomon/shadows/volume.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// The space in which a caster is looked at from its light: its own, or, where its pose is singular
/// and it has no light of its own, the one that the pose leads to.
struct LayerSpace {
    glm::dmat4 space_from_local{1.0};      ///< from the caster's space to this one
    glm::dvec4 light{0.0, 1.0, 0.0, 0.0};  ///< w is 1 or 0, as in Light::position_world
};

/// True when all of the mesh's bounds lie in one half-space as seen from the light: always for a
/// directional light, for a point light when it is outside the bounds.
[[nodiscard]] bool seen_from_outside(const ShadowMesh& mesh, const LayerSpace& space);

/// A bound that costs nothing: no more layers than casting faces, and for a mesh
/// `seen_from_outside` fewer than half the silhouette's edges, because each of them is seen under
/// less than 180 degrees and a layer is one turn of the silhouette about the point.
[[nodiscard]] std::uint32_t quick_layer_bound(const Volume& volume, bool from_outside);

/// Near the true number for most meshes, and far cheaper than layer_bound(): a line across the
/// picture that the light sees, through a point under n layers, crosses the silhouette 2 n times or
/// more. So half the most crossings of all lines in one direction are a bound. Where single
/// precision says too little of them, or under a singular pose, two directions are looked at in
/// double precision, and the lesser counts. quick_layer_bound() where the light is among the faces.
/// Cost: some nanoseconds a silhouette edge; allocates nothing.
[[nodiscard]] std::uint32_t coarse_layer_bound(const ShadowMesh& mesh, const Volume& volume,
                                               const LayerSpace& space);

/// The bound proper. The number of casting faces between a point and the light is the winding
/// number of the silhouette about the point's direction, as seen from the light. It is computed
/// exactly on the nodes of a grid of directions; between them it grows at most by the edges that
/// are crossed. Vertices are rounded to 2^-28 of the grid's width before, less than their own
/// rounding in single precision. Where the projection is too ill-conditioned for that, the number
/// of casting faces is returned. `volume` as build_volume makes it, for a light at `space.light`.
/// Cost: O(silhouette edges), and the casting faces where the mesh is not seen from outside;
/// allocates a grid of at most 256 x 256 cells, and one of 4 times as many a side where it finds
/// more than 127 layers.
[[nodiscard]] std::uint32_t layer_bound(const ShadowMesh& mesh, const Volume& volume,
                                        const LayerSpace& space);

/// A closed volume of some of the casting faces.
struct LayerPart {
    Volume volume;             ///< as build_volume() makes them
    std::uint32_t layers = 0;  ///< its layer_bound()
};

/// Splits a volume into parts of at most `limit` layers each, limit >= 1. Each casting face is in
/// one part, so the parts' counts add up to the volume's, at any point. Cut first between patches,
/// the pieces that the silhouette divides the casting faces into: those cuts run along shadow edges
/// that are there anyway. A patch that overlaps itself too often is cut by distance from the light.
/// Parts are built with the options that `volume` was. Cost: linear in the mesh for each part.
[[nodiscard]] std::vector<LayerPart> split_volume(const ShadowMesh& mesh, const Volume& volume,
                                                  const LayerSpace& space, std::uint32_t limit);

}  // namespace gnomon::shadows
#pragma GCC visibility pop
