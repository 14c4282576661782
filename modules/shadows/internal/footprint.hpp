// SPDX-License-Identifier: MIT
//
// Which directions from a light a caster's bounds cover, as rectangles in a few pictures, and the
// most layers that casters with so many layers each can pile up in one direction.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/technique.hpp>

namespace gnomon::shadows::internal {

/// A closed rectangle in one of the light's pictures.
struct Footprint {
    std::uint32_t picture = 0;  ///< the sides of a cube about a point light; one, if directional
    glm::dvec2 low{0.0};
    glm::dvec2 high{0.0};
    std::uint32_t layers = 0;
};

/// Appends the rectangles that hold everything in `bounds`, up to six. `light_world` must be the
/// same for footprints that are compared.
void append_footprints(const OrientedBounds& bounds, const glm::dvec4& light_world,
                       std::uint32_t layers, std::vector<Footprint>& out);

/// The largest sum of layers over rectangles with a point in common. Cost: O(n log n), a sweep
/// with a segment tree.
[[nodiscard]] std::uint64_t most_layers(std::span<const Footprint> footprints);

}  // namespace gnomon::shadows::internal
