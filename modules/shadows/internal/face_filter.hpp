// SPDX-License-Identifier: MIT
//
// The single-precision stage of the facing test: the sides of all faces of which it can be certain,
// in two forms that do the same operations on the same numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/glm.hpp>

#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>

namespace gnomon::shadows::internal {

/// A light relative to the planes' origin, rounded to single precision.
struct FilterLight {
    glm::vec3 towards{0.0F};  ///< from the origin to a point light; a directional one as it is
    float w = 0.0F;
    float reach = 0.0F;  ///< times a plane's error: the bound on the error of the test's value
};
[[nodiscard]] FilterLight filter_light(const FacePlanes& planes, LightLocal light);

/// For each face +1 (facing the light) or -1 (averted) where that is certain, else 0. Returns how
/// far the light is from the nearest plane among the certain ones, less the bound on the error:
/// times plane_shrink, it is a lower bound for the exact planes. Infinity where none is certain.
/// `sides` has a place for each face.
float filter_scalar(const FacePlanes& planes, const FilterLight& light,
                    std::span<std::int8_t> sides);
/// The same, several faces at a time, where the compiler has vectors.
float filter_simd(const FacePlanes& planes, const FilterLight& light, std::span<std::int8_t> sides);

/// What the filter says of 16 faces, one bit each.
struct FilteredBlock {
    std::uint16_t decided = 0;  ///< it is certain
    std::uint16_t facing = 0;   ///< and the face is towards the light
    float nearest = 0.0F;       ///< as filter_scalar() returns it, of this block
};
/// Blocks first_block .. of 16 faces each, padding included, about which nothing is certain; as
/// many as `out` has places. The same operations on the same numbers as above, by the widest
/// vectors that the processor has.
void filter_blocks(const FacePlanes& planes, const FilterLight& light, std::size_t first_block,
                   std::span<FilteredBlock> out);
/// The same face by face: what processors do that have no such vectors.
void filter_blocks_plain(const FacePlanes& planes, const FilterLight& light,
                         std::size_t first_block, std::span<FilteredBlock> out);

}  // namespace gnomon::shadows::internal
