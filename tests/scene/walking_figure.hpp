// SPDX-License-Identifier: MIT
//
// A small figure that walks, as a glTF file made by hand: one skinned mesh of limbs with knees and
// elbows that bend, a morph target (its chest), and one animation of all four paths that lasts a
// second.
#pragma once

#include "tests/scene/gltf_builder.hpp"

namespace gnomon::scene::test {

/// About 1.7 m tall, feet at y = 0, walking along +Z. Its limbs are closed, though seams of their
/// normals run along them. Named joints: "hips", "left knee", ….
[[nodiscard]] GltfBuilder walking_figure();

}  // namespace gnomon::scene::test
