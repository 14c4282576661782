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

#include "tests/rows/stage.hpp"

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

/// Half of a roof, a sheet: both halves have the ridge, from (0, 0.75, -1) to (0, 0.75, 1), and
/// list it in opposite order.
[[nodiscard]] scene::Mesh left_wing();
[[nodiscard]] scene::Mesh right_wing();

/// A wall of 25 rows of 40 bricks, each a caster of its own, 10 m wide, 3.125 m high and 0.125 m
/// thick about z = 0. Every other row begins `shift_m` farther to the right: 0.125 is half a brick.
void lay_bricks(Stage& stage, double shift_m, bool drawn);

}  // namespace gnomon::test
