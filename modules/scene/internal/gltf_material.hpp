// SPDX-License-Identifier: MIT
//
// Materials of a glTF file, as far as gnomon's renderer uses them.
#pragma once

#include <string>
#include <vector>

#include <gnomon/scene/mesh.hpp>

#include "internal/gltf_model.hpp"

namespace gnomon::scene::internal {

/// Element 0 is the default material; the file's material i is element i + 1.
[[nodiscard]] std::vector<Material> read_materials(const GltfModel& model,
                                                   std::vector<std::string>& messages);

}  // namespace gnomon::scene::internal
