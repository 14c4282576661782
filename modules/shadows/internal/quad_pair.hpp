// SPDX-License-Identifier: MIT
//
// Pairs whose silhouette a vertex shader finds (edge_quads.hpp): what the CPU finds out for them,
// and what it can say of a volume that it never makes.
#pragma once

#include <memory>
#include <optional>

#include <gnomon/shadows/edge_quads.hpp>
#include <gnomon/shadows/volume.hpp>

namespace gnomon::shadows::internal {

struct QuadMargin {
    QuadCasting casting;
    double margin = 0.0;  ///< as Facing::margin: the light may go so far, and `casting` holds
};

/// What edge quads draw the mesh with; nullopt where they cannot: a mesh that is not closed, or a
/// light that it casts two-sided for. Nor are they for deformed meshes, whose textures would be new
/// in each frame, and larger than what the CPU uploads. `scratch` is filled in for
/// QuadFacing::Uploaded alone; the other kind looks at no face.
[[nodiscard]] std::optional<QuadMargin> cast_by_quads(const ShadowMesh& mesh, LightLocal light,
                                                      NearCaps near_caps, QuadFacing facing,
                                                      Facing& scratch);

/// What stands in VolumeDraw::volume beside quads: an empty one, the same for all.
[[nodiscard]] std::shared_ptr<const Volume> volume_of_quads();

/// Near caps alone, of all faces that may cast: for nearest_face().
[[nodiscard]] Volume casting_faces(const ShadowMesh& mesh, const QuadCasting& casting);

}  // namespace gnomon::shadows::internal
