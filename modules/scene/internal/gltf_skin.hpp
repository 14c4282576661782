// SPDX-License-Identifier: MIT
//
// What of a skin is in the bytes of a glTF file.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "internal/gltf_model.hpp"

namespace gnomon::scene::internal {

/// The skin's inverse bind matrices, identity where the file has none.
[[nodiscard]] std::vector<glm::dmat4> inverse_bind_matrices(const GltfModel& model,
                                                            const tinygltf::Skin& skin);

}  // namespace gnomon::scene::internal
