// SPDX-License-Identifier: MIT
//
// Skinned meshes in their rest pose. Evaluating poses over time is not done here.
#pragma once

#include <memory>
#include <vector>

#include "internal/gltf_mesh.hpp"

namespace gnomon::scene::internal {

/// The skin's inverse bind matrices, identity where the file has none.
[[nodiscard]] std::vector<glm::dmat4> inverse_bind_matrices(const GltfModel& model,
                                                            const tinygltf::Skin& skin);

/// The mesh with every vertex moved by the weighted mean of its joints' matrices
/// (world_from_joint * inverse bind): in the space of the scene, since glTF ignores the transform
/// of a skinned mesh's own node. A vertex without weights moves with the first joint. Throws
/// InputError for a joint that the skin has not; `place` names the node.
[[nodiscard]] std::shared_ptr<const Mesh> pose_mesh(const BuiltMesh& built,
                                                    const std::vector<glm::dmat4>& joint_matrices,
                                                    const GltfModel& model,
                                                    const std::string& place);

}  // namespace gnomon::scene::internal
