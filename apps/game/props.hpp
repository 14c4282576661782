// SPDX-License-Identifier: MIT
//
// Props: meshes that are put together from gnomon's primitives. Lattices and spoked wheels are what
// exact shadows are for: every bar is there.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include <gnomon/scene/mesh.hpp>

namespace gnomon::game {

/// Adds a copy of `part` with a pose; one material for all of it.
void add_part(scene::Mesh& whole, const scene::Mesh& part, const glm::dmat4& whole_from_part);

/// Posts, rungs and diagonals of a square mast that stands on the origin.
[[nodiscard]] scene::Mesh make_lattice(double height_m, double width_m, std::uint32_t material);

/// A rim, a hub and spokes about the origin's Z axis.
[[nodiscard]] scene::Mesh make_spoked_wheel(double radius_m, std::uint32_t spokes,
                                            std::uint32_t material);

/// A crate: a box with bars along its edges, about its centre. No side may be 0.08 m or less: bars
/// are 0.04 m thick at least, and those along an edge lie between those across it.
[[nodiscard]] scene::Mesh make_crate(const glm::dvec3& size_m, std::uint32_t material);

}  // namespace gnomon::game
