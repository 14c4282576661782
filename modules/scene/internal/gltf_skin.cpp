// SPDX-License-Identifier: MIT
#include "internal/gltf_skin.hpp"

#include <cmath>

#include <fmt/format.h>

#include "internal/json_place.hpp"

namespace gnomon::scene::internal {

std::vector<glm::dmat4> inverse_bind_matrices(const GltfModel& model, const tinygltf::Skin& skin) {
    std::vector<glm::dmat4> matrices(skin.joints.size(), glm::dmat4(1.0));
    if (skin.inverseBindMatrices < 0) return matrices;
    const AccessorView view(model, skin.inverseBindMatrices);
    for (std::size_t i = 0; i < matrices.size(); ++i) {
        for (std::size_t c = 0; c < 16; ++c) {
            const double value = view.get(i, c);
            if (!std::isfinite(value)) {
                refuse_input(model.file, fmt::format("accessors[{}]: inverse bind matrix {} is not "
                                                     "finite",
                                                     skin.inverseBindMatrices, i));
            }
            matrices[i][static_cast<int>(c / 4)][static_cast<int>(c % 4)] = value;
        }
    }
    return matrices;
}

}  // namespace gnomon::scene::internal
