// SPDX-License-Identifier: MIT
//
// Builders of closed (and one open) meshes. All are centred on the origin, wound counter-clockwise
// from outside, with smooth normals where the surface is smooth; vertices along seams have
// bit-equal positions.
#pragma once

#include <cstdint>

#include <gnomon/scene/mesh.hpp>

#pragma GCC visibility push(default)
namespace gnomon::scene {

/// A box about the origin, edges in metres; closed, with the normals of its sides.
[[nodiscard]] Mesh make_box(const glm::vec3& size, std::uint32_t material = 0);
/// A UV sphere; slices >= 3 round the axis (+Y), stacks >= 2 from pole to pole.
[[nodiscard]] Mesh make_sphere(float radius, std::uint32_t slices, std::uint32_t stacks,
                               std::uint32_t material = 0);
/// A torus round +Y; closed.
[[nodiscard]] Mesh make_torus(float ring_radius, float tube_radius, std::uint32_t ring_segments,
                              std::uint32_t tube_segments, std::uint32_t material = 0);
/// A (p, q) torus knot round +Y; closed.
[[nodiscard]] Mesh make_torus_knot(float ring_radius, float tube_radius, std::uint32_t p,
                                   std::uint32_t q, std::uint32_t ring_segments,
                                   std::uint32_t tube_segments, std::uint32_t material = 0);
/// A flat square sheet in the XZ plane facing +Y: open, two triangles a cell.
[[nodiscard]] Mesh make_plane(float size_x, float size_z, std::uint32_t cells = 1,
                              std::uint32_t material = 0);
/// A capped cylinder along +Y; closed.
[[nodiscard]] Mesh make_cylinder(float radius, float height, std::uint32_t slices,
                                 std::uint32_t material = 0);

}  // namespace gnomon::scene
#pragma GCC visibility pop
