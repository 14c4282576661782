// SPDX-License-Identifier: MIT
//
// Shadow volumes as index ranges. A volume has two vertices per welded vertex v of its mesh: 2v,
// the near one, where it is, and 2v + 1, the far one, pushed away from the light, in the vertex
// shader or by extrude(). So a moving light costs indices alone, and the near vertices are the
// mesh's own, bit for bit.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>
#include <gnomon/shadows/silhouette.hpp>

namespace gnomon::shadows {

struct IndexRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// Triangles wound counter-clockwise from outside the volume, except near_cap_flipped, which keeps
/// the mesh's own order (docs/conventions.md, "Caps keep their order") and is drawn with front and
/// back exchanged. In `indices` the ranges follow each other: sides, near_cap, far_cap,
/// near_cap_flipped.
struct Volume {
    std::vector<std::uint32_t> indices;
    IndexRange sides;
    IndexRange near_cap;
    IndexRange far_cap;  ///< empty for a directional light with the far vertices at infinity: they
                         ///< all coincide
    IndexRange near_cap_flipped;
    /// The last part of near_cap_flipped: the caps of solids that cast with their averted faces
    /// (NearCaps::Averted). Every other near cap lies on a surface that light may reach.
    IndexRange near_cap_averted;
    std::uint32_t silhouette_edges = 0;
};

/// Where far vertices go. At infinity they are directions (w = 0), which an infinite perspective
/// draws exactly at depth 0; a finite far plane or an orthographic camera needs them at finite
/// places.
enum class FarVertices : std::uint8_t { AtInfinity, Finite };

/// Builds the volume of weighted faces. Works for any weights; closed whatever they are. Side quads
/// are split along the diagonal that starts at the lexicographically smaller position, so that
/// casters which share an edge agree. `solid_averted` is Facing's, by component; it is what
/// near_cap_averted is made from, and empty means none. Cost: linear in the faces with weight and
/// the silhouette.
void build_volume(const ShadowMesh& mesh, std::span<const std::int8_t> weights,
                  std::span<const SilhouetteEdge> silhouette, bool directional,
                  FarVertices far_vertices, Volume& out,
                  std::span<const std::uint8_t> solid_averted = {});

/// True when the volume has no boundary, as integers: every directed edge is used as often as its
/// opposite. For tests, fuzzers and tools. `directional_at_infinity`: all far vertices are one
/// point.
[[nodiscard]] bool is_closed(const Volume& volume, bool directional_at_infinity);

/// The far vertex of position p is (p * scale + offset.xyz, offset.w), in the caster's space.
struct Extrusion {
    float scale = 1.0F;
    glm::vec4 offset{0.0F};
};

/// Far vertices at infinity: (p * L.w - L.xyz, 0).
[[nodiscard]] Extrusion infinite_extrusion(LightLocal light);
/// Far vertices at L + reach * (p - L) for a point light, p - reach * L for a directional one.
[[nodiscard]] Extrusion finite_extrusion(LightLocal light, double reach);

/// The far vertices on the CPU, by the very operations of the shader: the second path, for hosts
/// that cannot run it.
void extrude(std::span<const glm::vec3> positions, const Extrusion& extrusion,
             std::vector<glm::vec4>& far_vertices);

}  // namespace gnomon::shadows
