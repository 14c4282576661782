// SPDX-License-Identifier: MIT
//
// Turns the nodes of one scene of a glTF file into entities.
#pragma once

#include <gnomon/scene/gltf.hpp>

#include "internal/gltf_model.hpp"

namespace gnomon::scene::internal {

/// Throws InputError.
[[nodiscard]] Scene build_scene(const GltfModel& model, const GltfOptions& options);

}  // namespace gnomon::scene::internal
