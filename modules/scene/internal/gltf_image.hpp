// SPDX-License-Identifier: MIT
//
// PNG and JPEG images of a glTF file, decoded by the decoder inside tinygltf.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gnomon/scene/mesh.hpp>

#include "internal/gltf_model.hpp"

namespace gnomon::scene::internal {

/// Null when the image is missing or cannot be decoded; the reason is then added to the messages.
[[nodiscard]] std::shared_ptr<const Image> load_image(const GltfModel& model, std::size_t image,
                                                      std::vector<std::string>& messages);

}  // namespace gnomon::scene::internal
