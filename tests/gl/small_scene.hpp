// SPDX-License-Identifier: MIT
//
// The smallest picture that uses every kind of object: one triangle, orange on blue, with a stencil
// count beside it.
#pragma once

#include <cstdint>
#include <vector>

#include <gnomon/gpu/device.hpp>

namespace gnomon::gl_tests {

struct SmallScene {
    gpu::Texture color;
    gpu::Texture depth_stencil;
};

inline constexpr std::uint32_t scene_side = 16;

/// Draws it; the stencil counts front faces up and back faces down. A device's refusal is an
/// exception.
SmallScene draw_small_scene(gpu::Device& device);

}  // namespace gnomon::gl_tests
