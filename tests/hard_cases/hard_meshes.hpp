// SPDX-License-Identifier: MIT
//
// Meshes that exporters make and shadow code dreads, and clean ones to make them from. Coordinates
// are multiples of a power of two wherever a case needs a light exactly on something.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <gnomon/scene/mesh.hpp>

namespace gnomon::test {

/// With smooth normals made from the faces; they are for pictures alone.
[[nodiscard]] scene::Mesh mesh_of(std::string name, std::vector<glm::vec3> positions,
                                  std::vector<std::uint32_t> indices);

/// The cube from -1 to 1, each side a grid of cells * cells squares of two triangles; the sides do
/// not share vertices. Exact where `cells` is a power of two.
[[nodiscard]] scene::Mesh grid_cube(std::uint32_t cells);

/// The cube from -1 to 1 with a vertex of its own for every corner, eight in all.
[[nodiscard]] scene::Mesh welded_cube();

/// The cube from -1 to 1 without its top.
[[nodiscard]] scene::Mesh open_cube();

/// Every triangle gets three vertices of its own.
[[nodiscard]] scene::Mesh taken_apart(const scene::Mesh& mesh);

/// Positions rounded to multiples of `step`.
[[nodiscard]] scene::Mesh snapped(scene::Mesh mesh, float step);

/// Other faces on the same vertices: `choose` appends triples to `out` for face number `f`, whose
/// corners are `corners[0]` to `corners[2]`.
using ChooseFaces = std::function<void(std::size_t f, const std::uint32_t* corners,
                                       std::vector<std::uint32_t>& out)>;
[[nodiscard]] scene::Mesh with_faces(const scene::Mesh& mesh, const ChooseFaces& choose);

/// The two meshes as one; their vertices are not shared.
[[nodiscard]] scene::Mesh joined(const scene::Mesh& a, const scene::Mesh& b);

}  // namespace gnomon::test
