// SPDX-License-Identifier: MIT
//
// Shadow volumes as index ranges. A volume has two vertices per welded vertex v of its mesh: 2v,
// the near one, where it is, and 2v + 1, the far one, pushed away from the light, in the vertex
// shader or by extrude(). So a moving light costs indices alone, and the near vertices are the
// mesh's own, bit for bit.
//
// Caps are faces of the mesh, and most of them come in long runs. Those are not written out: they
// are ranges of one list that a mesh has for good, the triples of its near vertices in its own
// order. Far caps are near caps whose indices are all one higher.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/detector.hpp>
#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>
#include <gnomon/shadows/silhouette.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// A piece of a list of indices.
struct IndexRange {
    std::uint32_t first = 0;  ///< its begin
    std::uint32_t count = 0;  ///< its length
};

/// Faces [first, first + count) of the mesh.
struct FaceRange {
    std::uint32_t first = 0;  ///< the first face
    std::uint32_t count = 0;  ///< how many
    auto operator<=>(const FaceRange&) const = default;
};

/// Where far vertices go. At infinity they are directions (w = 0), which an infinite perspective
/// draws exactly at depth 0; a finite far plane or an orthographic camera needs them at finite
/// places. On a plane (FillOptions::clamp) they are finite, and a far cap is flat.
enum class FarVertices : std::uint8_t {
    AtInfinity,  ///< directions
    Finite,      ///< at places behind all that is seen
    OnPlane,     ///< on a plane behind the last receiver
};

/// What closes a volume at its far vertices.
enum class FarCap : std::uint8_t {
    Faces,  ///< the casting faces: right for any light
    /// A fan over the silhouette, one triangle an edge. It equals the faces where all directions
    /// from the light to the caster lie in a half-space, and is wrong by whole layers where the
    /// light is within the caster's bounds: fan_is_exact(). On a plane it always equals them: there
    /// is nothing in a plane that has no boundary.
    Fan,
};

/// How caps are put together. The counts are the same whatever is chosen.
struct CapOptions {
    FarCap far_cap = FarCap::Faces;  ///< what closes the volume
    /// A range, which is a draw call or two, is taken to cost as much as the indices of so many
    /// faces. Ranges are chosen so that the sum is least.
    std::uint32_t draw_worth_faces = 512;
    /// No volume has more ranges: where it would, those that save most are taken, or others that
    /// are joined and save more.
    std::uint32_t max_ranges = 64;
    /// ShadowSystem makes volumes of which no cap is drawn with ranges_alone(), and puts their caps
    /// together by the other options once one is.
    bool when_drawn = true;

    /// All triangles are written out, in `Volume::indices`.
    [[nodiscard]] static constexpr CapOptions plain() {
        return {.draw_worth_faces = std::numeric_limits<std::uint32_t>::max(),
                .max_ranges = 0,
                .when_drawn = false};
    }
    /// No cap is written out, a fan neither: all are ranges, far caps copies of near ones. As right
    /// as any, made in no time, and many draw calls where caps are drawn.
    [[nodiscard]] static constexpr CapOptions ranges_alone(FarCap far_cap = FarCap::Faces) {
        return {.far_cap = far_cap,
                .draw_worth_faces = 0,
                .max_ranges = std::numeric_limits<std::uint32_t>::max()};
    }
    /// Whether these are ranges_alone().
    [[nodiscard]] constexpr bool are_ranges_alone() const {
        return draw_worth_faces == 0 && max_ranges == std::numeric_limits<std::uint32_t>::max();
    }
};

/// What else decides which triangles a volume has.
struct VolumeOptions {
    bool directional = false;                            ///< the light is
    FarVertices far_vertices = FarVertices::AtInfinity;  ///< where they go
    CapOptions caps = {};                                ///< how caps are put together

    /// All far vertices are one point: a side is one triangle and there is no far cap.
    [[nodiscard]] bool one_far_point() const {
        return directional && far_vertices == FarVertices::AtInfinity;
    }
};

/// The near caps of the faces of one kind, in the mesh's own order of corners (docs/conventions.md,
/// "Caps keep their order").
struct CapList {
    IndexRange triples;  ///< in Volume::indices, in the mesh's order of faces
    IndexRange ranges;   ///< in Volume::ranges, ascending
    /// In Volume::indices: those faces of `ranges` that do not cast, in order. They are drawn once
    /// more with front and back the other way round, which undoes them exactly, pixel by pixel.
    IndexRange undone;
    std::uint32_t faces = 0;  ///< that cast, each as often as it does
};

/// Near caps that are drawn once more as far caps, with 1 added to each index and front and back
/// the other way round. What is undone counts as written out.
enum class FarCopies : std::uint8_t {
    None,      ///< none is
    OfRanges,  ///< what lies in ranges is
    OfAll,     ///< all are
};

/// Triangles, counter-clockwise from outside the volume where nothing else is said. `indices` has
/// far_cap, sides, the triples of near_cap, near_cap_flipped and near_cap_averted, and what is
/// undone of each of them, one after the other. for_each_triangle() has all of it put together.
struct Volume {
    std::vector<std::uint32_t> indices;  ///< 2v: vertex v of the mesh; 2v + 1: its far vertex
    std::vector<FaceRange> ranges;       ///< of all near caps, list by list
    /// The part of the far cap that is written out: a fan, or the far caps of all that is written
    /// out where that is little. The rest is in `far_copies`.
    IndexRange far_cap;
    FarCopies far_copies = FarCopies::None;  ///< near caps that are far caps as well
    IndexRange sides;          ///< in `indices`: side quads, two triangles each, or one
    CapList near_cap;          ///< of positive weight
    CapList near_cap_flipped;  ///< of negative weight: drawn with front and back exchanged
    /// As near_cap_flipped, of solids that cast with their averted faces (NearCaps::Averted). Every
    /// other near cap lies on a surface that light may reach.
    CapList near_cap_averted;
    std::uint32_t silhouette_edges = 0;  ///< each once
    VolumeOptions made_with;             ///< what it was made with

    /// Nothing casts.
    [[nodiscard]] bool empty() const { return indices.empty() && ranges.empty(); }
    /// All three lists.
    [[nodiscard]] std::array<CapList, 3> near_caps() const {
        return {near_cap, near_cap_flipped, near_cap_averted};
    }
    /// Written out or copied.
    [[nodiscard]] bool has_far_cap() const {
        return far_cap.count > 0 || far_copies != FarCopies::None;
    }
    /// Near caps in all, each as often as it casts.
    [[nodiscard]] std::uint32_t cap_faces() const {
        return near_cap.faces + near_cap_flipped.faces + near_cap_averted.faces;
    }
};

/// Builds the volume of weighted faces. Works for any weights; closed whatever they are. Side quads
/// are split along the diagonal that starts at the lexicographically smaller position, so that
/// casters which share an edge agree. `casting` and `solid_averted` are Detection's; the latter is
/// what near_cap_averted is made from, and empty means none. The caller sees to it that a fan is
/// exact. Cost: linear in the silhouette, the runs and the faces that are written out; with solids
/// that cast averted beside components that do not, in the faces of negative weight.
void build_volume(const ShadowMesh& mesh, std::span<const FaceRun> casting,
                  std::span<const SilhouetteEdge> silhouette, const VolumeOptions& options,
                  Volume& out, std::span<const std::uint8_t> solid_averted = {});

/// A volume of ranges alone with its caps put together by other options: what build_volume() makes
/// of the same faces and silhouette by `caps`, but for the far cap, which is what `volume` was made
/// with. Cost: linear in the volume, and what build_volume() costs.
[[nodiscard]] Volume with_caps(const ShadowMesh& mesh, const Volume& volume,
                               const CapOptions& caps);

/// The plain way (CapOptions::plain), from weights by face: all triangles are in `indices`. Cost:
/// linear in the faces as well.
void build_volume(const ShadowMesh& mesh, std::span<const std::int8_t> weights,
                  std::span<const SilhouetteEdge> silhouette, bool directional,
                  FarVertices far_vertices, Volume& out,
                  std::span<const std::uint8_t> solid_averted = {});

/// Whether FarCap::Fan closes the volume as FarCap::Faces does: for far vertices on a plane, and
/// for a point light outside the mesh's bounds with far vertices at infinity.
[[nodiscard]] bool fan_is_exact(const ShadowMesh& mesh, LightLocal light, FarVertices far_vertices);

/// Calls visit(std::uint32_t) for each face of `ranges` that casts: without the `undone` ones,
/// triples of near vertices in the same order.
template <class Visit>
void for_each_face_of_ranges(const ShadowMesh& mesh, std::span<const FaceRange> ranges,
                             std::span<const std::uint32_t> undone, Visit&& visit) {
    const auto faces = mesh.faces();
    for (const FaceRange& range : ranges) {
        for (std::uint32_t f = range.first; f < range.first + range.count; ++f) {
            // Of neighbours that are equal it does not matter which one is undone.
            if (undone.size() >= 3 && undone[0] == 2 * faces[f][0] &&
                undone[1] == 2 * faces[f][1] && undone[2] == 2 * faces[f][2]) {
                undone = undone.subspan(3);
            } else {
                visit(f);
            }
        }
    }
}

/// Calls visit(std::array<std::uint32_t, 3>) with the welded vertices of each face of a list that
/// casts, in the mesh's order of corners.
template <class Visit>
void for_each_cap_face(const ShadowMesh& mesh, const Volume& volume, const CapList& list,
                       Visit&& visit) {
    const std::span<const std::uint32_t> indices(volume.indices);
    const auto triples = indices.subspan(list.triples.first, list.triples.count);
    for (std::size_t i = 0; i < triples.size(); i += 3) {
        visit(std::array{triples[i] / 2, triples[i + 1] / 2, triples[i + 2] / 2});
    }
    for_each_face_of_ranges(mesh,
                            std::span(volume.ranges).subspan(list.ranges.first, list.ranges.count),
                            indices.subspan(list.undone.first, list.undone.count),
                            [&](std::uint32_t f) { visit(mesh.faces()[f]); });
}

/// Calls visit(std::array<std::uint32_t, 3>, bool exchanged) for every triangle of the volume, as
/// it is drawn: counter-clockwise from outside where it is not `exchanged`, clockwise where it is.
template <class Visit>
void for_each_triangle(const ShadowMesh& mesh, const Volume& volume, Visit&& visit) {
    for (const IndexRange& range : {volume.far_cap, volume.sides}) {
        for (std::uint32_t i = range.first; i < range.first + range.count; i += 3) {
            visit(std::array{volume.indices[i], volume.indices[i + 1], volume.indices[i + 2]},
                  false);
        }
    }
    const auto visit_triples = [&](const IndexRange& triples, std::uint32_t far, bool exchanged) {
        for (std::uint32_t i = triples.first; i < triples.first + triples.count; i += 3) {
            visit(std::array{volume.indices[i] + far, volume.indices[i + 1] + far,
                             volume.indices[i + 2] + far},
                  exchanged);
        }
    };
    const auto visit_list = [&](const CapList& list, std::uint32_t far, bool exchanged) {
        const bool written = far == 0 || volume.far_copies == FarCopies::OfAll;
        if (written) visit_triples(list.triples, far, exchanged);
        if (written) visit_triples(list.undone, far, !exchanged);
        if (far != 0 && volume.far_copies == FarCopies::None) return;
        for (const FaceRange& range :
             std::span(volume.ranges).subspan(list.ranges.first, list.ranges.count)) {
            for (const auto& [a, b, c] : mesh.faces().subspan(range.first, range.count)) {
                visit(std::array{2 * a + far, 2 * b + far, 2 * c + far}, exchanged);
            }
        }
    };
    bool exchanged = false;  // of the first list alone it is not
    for (const CapList& list : volume.near_caps()) {
        visit_list(list, 0, exchanged);
        visit_list(list, 1, !exchanged);
        exchanged = true;
    }
}

/// True when the volume has no boundary, as integers: every directed edge is used as often as its
/// opposite. For tests, fuzzers and tools.
[[nodiscard]] bool is_closed(const ShadowMesh& mesh, const Volume& volume);

/// The far vertex of position p is (p * scale + offset.xyz, offset.w), in the caster's space.
struct Extrusion {
    float scale = 1.0F;      ///< of the position
    glm::vec4 offset{0.0F};  ///< added to it; w is the far vertex's
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
#pragma GCC visibility pop
