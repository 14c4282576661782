// SPDX-License-Identifier: MIT
//
// Skins and morph targets, evaluated on the CPU: one buffer of positions and normals for each
// instance, which drawing and shadows both read, so that they cannot disagree.
#pragma once

#include <gnomon/core/result.hpp>
#include <gnomon/scene/scene.hpp>

#pragma GCC visibility push(default)
namespace gnomon::scene {

/// Writes Deformed of every instance whose mesh has a deformation and that has a Skin or
/// MorphWeights; morph targets first, then joints, as glTF says. Reads LocalTransforms, so that
/// joints need no update_world_transforms() before.
///
/// Everything is double precision inside and rounded once. The same inputs give the same bits, on
/// every run; vertices of one identity (MeshDeformation::identities) have the same position.
/// Deformed::revision stays what it is unless a position or normal changed.
///
/// A skinned instance is posed in the space of its parent (of the world, where it has none): joints
/// are multiplied together up to there. So a model whose parent moves does not deform, and the node
/// of the mesh in its file has no say, as glTF says.
///
/// Fails with ErrorCode::InvalidInput, one sentence that names the node, when a weight or a joint
/// is missing or a vertex comes out not finite; such an instance keeps the Deformed it had. A cycle
/// of parents is a caller's bug. Cost: where weights and joints stand as they stood, their
/// comparison; else linear in vertices times what moves them.
[[nodiscard]] Status deform(Scene& scene);

}  // namespace gnomon::scene
#pragma GCC visibility pop
