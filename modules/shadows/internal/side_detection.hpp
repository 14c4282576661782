// SPDX-License-Identifier: MIT
//
// From the sides of faces to what casts and its silhouette: what the detectors that work on bits
// share.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include <gnomon/shadows/detector.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>

#include "casting.hpp"
#include "detection_tables.hpp"
#include "face_sides.hpp"

namespace gnomon::shadows::internal {

struct Sides {
    FaceSides faces;
    Castings castings;

    [[nodiscard]] int weight(const ShadowMesh& mesh, std::size_t face) const {
        const std::size_t component = castings.uniform ? 0 : mesh.face_components()[face];
        return castings.of_component[component][static_cast<std::size_t>(faces.side(face) + 1)];
    }
    [[nodiscard]] std::size_t memory_bytes() const {
        return faces.memory_bytes() + castings.of_component.capacity() * sizeof(Casting);
    }
    /// The signed sum over an edge's uses: > 0 where the casting faces run low -> high more often.
    [[nodiscard]] std::int32_t count(const ShadowMesh& mesh, std::size_t edge) const {
        std::int32_t sum = 0;
        for (const FaceUse& use : mesh.uses(mesh.edges()[edge])) {
            sum += use.sign() * weight(mesh, use.face);
        }
        return sum;
    }
};

inline SilhouetteEdge silhouette_edge(const Edge& edge, std::int32_t count) {
    return count > 0 ? SilhouetteEdge{edge.low, edge.high, count}
                     : SilhouetteEdge{edge.high, edge.low, -count};
}

/// Replaces `casting`. Cost: some steps for 64 faces.
void find_casting(const ShadowMesh& mesh, const Sides& sides, CastingFaces& casting);

/// Of the regular edges [first, first + count): those whose two faces have different bits, by place
/// in that range. `count` is 64 at most.
[[nodiscard]] std::uint64_t differing_edges(std::span<const FaceUse> uses, std::size_t first,
                                            std::size_t count,
                                            std::span<const std::uint64_t> facing);
/// The same one by one: what processors do that cannot gather.
[[nodiscard]] std::uint64_t differing_edges_plain(std::span<const FaceUse> uses, std::size_t first,
                                                  std::size_t count,
                                                  std::span<const std::uint64_t> facing);

/// Calls visit(edge, count) for the silhouette edges among the regular edges [first, first + count)
/// that have no edge-on face. Adds to `tested`.
template <class Visit>
void visit_regular(const ShadowMesh& mesh, const Sides& sides, std::size_t first, std::size_t count,
                   std::uint64_t& tested, const Visit& visit) {
    const auto uses = mesh.uses();
    tested += count;
    for (std::size_t end = first + count; first < end; first += 64) {
        std::uint64_t differing = differing_edges(
            uses, first, std::min<std::size_t>(64, end - first), sides.faces.facing());
        for (; differing != 0; differing &= differing - 1) {
            const std::size_t edge = first + static_cast<std::size_t>(std::countr_zero(differing));
            const std::uint32_t a = uses[2 * edge].face;
            const std::uint32_t b = uses[2 * edge + 1].face;
            if (sides.faces.side(a) == 0 || sides.faces.side(b) == 0) continue;
            const std::int32_t sum = sides.weight(mesh, a) - sides.weight(mesh, b);
            if (sum != 0) visit(edge, sum);
        }
    }
}

/// And for the others: the regular edges of edge-on faces, and edges that are not regular.
template <class Visit>
void visit_others(const ShadowMesh& mesh, const Sides& sides, std::uint64_t& tested,
                  const Visit& visit) {
    const auto uses = mesh.uses();
    const auto words = sides.faces.edge_on();
    for (std::size_t w = 0; w < words.size(); ++w) {
        for (std::uint64_t rest = words[w]; rest != 0; rest &= rest - 1) {
            const std::size_t face = 64 * w + static_cast<std::size_t>(std::countr_zero(rest));
            for (const std::uint32_t edge : mesh.face_edges()[face]) {
                if (edge >= mesh.regular_edges()) continue;  // no_edge as well
                const std::uint32_t a = uses[2 * std::size_t{edge}].face;
                const std::uint32_t b = uses[2 * std::size_t{edge} + 1].face;
                const std::uint32_t other = a == face ? b : a;
                if (other < face && sides.faces.side(other) == 0) continue;  // met before
                ++tested;
                const std::int32_t sum = sides.weight(mesh, a) - sides.weight(mesh, b);
                if (sum != 0) visit(std::size_t{edge}, sum);
            }
        }
    }
    tested += mesh.edges().size() - mesh.regular_edges();
    for (std::size_t edge = mesh.regular_edges(); edge < mesh.edges().size(); ++edge) {
        const std::int32_t sum = sides.count(mesh, edge);
        if (sum != 0) visit(edge, sum);
    }
}

// What DetectionStats::bytes_touched is made from.
inline constexpr std::uint64_t bytes_per_face_test = 5 * sizeof(float);
inline constexpr std::uint64_t bytes_per_edge_test = 2 * sizeof(FaceUse);

/// Decides all faces by the hierarchy of boxes. Calls settled(first_block, block_count, margin) for
/// pieces that together are all of them: no face of a piece changes its side while the light moves
/// no further than that (Facing::margin).
template <class Settled>
void search_faces(const ShadowMesh& mesh, const BlockClassifier& classifier, FaceSides& sides,
                  DetectionStats& stats, const Settled& settled) {
    std::size_t crossed = 0;
    const std::size_t nodes = tables_of(mesh).faces.visit(
        classifier.light(),
        [&](std::size_t first, std::size_t count, bool facing, float nearest) {
            sides.set_blocks(first, count, facing);
            settled(first, count, classifier.margin_of(nearest));
        },
        [&](std::size_t block) {
            const BlockClassifier::Block found = classifier.classify(block);
            sides.set_block(block, found.facing, found.edge_on);
            settled(block, 1, found.margin);
            ++crossed;
        });
    for (const std::uint32_t face : tables_of(mesh).degenerate_faces) sides.set_edge_on(face);
    stats.faces_tested += crossed * block_size;
    stats.bytes_touched += nodes * sizeof(BoxNode) + crossed * block_size * bytes_per_face_test;
}

/// Calls visit(edge, count) for every silhouette edge, once. `sides` are complete.
template <class Visit>
void search_edges(const ShadowMesh& mesh, const Sides& sides, const FilterLight& light,
                  DetectionStats& stats, const Visit& visit) {
    std::uint64_t tested = 0;
    const std::size_t nodes = tables_of(mesh).edges.visit(
        light, [](std::size_t, std::size_t, bool, float) {},
        [&](std::size_t block) {
            const std::size_t first = block * block_size;
            visit_regular(mesh, sides, first, std::min(block_size, mesh.regular_edges() - first),
                          tested, visit);
        });
    visit_others(mesh, sides, tested, visit);
    stats.edges_tested += tested;
    stats.bytes_touched += nodes * sizeof(BoxNode) + tested * bytes_per_edge_test;
}

}  // namespace gnomon::shadows::internal
