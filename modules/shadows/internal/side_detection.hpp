// SPDX-License-Identifier: MIT
//
// From the sides of faces to what casts and its silhouette: what the detectors that work on bits
// share.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
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

/// Of the regular edges [first, first + count): writes those whose two faces have different bits to
/// `out`, ascending, and returns how many. `out` has room for eight more than `count`.
[[nodiscard]] std::size_t differing_edges(std::span<const FaceUse> uses, std::size_t first,
                                          std::size_t count, std::span<const std::uint64_t> facing,
                                          std::uint32_t* out);
/// The same one by one: what processors do that cannot gather.
[[nodiscard]] std::size_t differing_edges_plain(std::span<const FaceUse> uses, std::size_t first,
                                                std::size_t count,
                                                std::span<const std::uint64_t> facing,
                                                std::uint32_t* out);

/// Finds the silhouette edges among regular ones that have no edge-on face, some at a time: first
/// which edges differ, then what they count, so that neither loop waits for the other.
template <class Visit>
class RegularEdges {
public:
    RegularEdges(const ShadowMesh& mesh, const Sides& sides, const Visit& visit)
        : uses_(mesh.uses()), mesh_(mesh), sides_(sides), visit_(visit) {
        const Castings& castings = sides.castings;
        plain_ = castings.uniform && !sides.faces.any_edge_on();
        if (plain_ && !castings.of_component.empty()) {
            step_ = castings.of_component[0][2] - castings.of_component[0][0];
        }
    }
    /// Edges [first, first + count), of which there are no more than `most`. visit(edge, count) is
    /// called for them now or by finish().
    static constexpr std::size_t most = 1024;
    void add(std::size_t first, std::size_t count) {
        if (found_ + count > most) flush();
        tested_ += count;
        found_ += differing_edges(uses_, first, count, sides_.faces.facing(), ids_.data() + found_);
    }
    /// Returns how many edges were looked at.
    std::uint64_t finish() {
        flush();
        return tested_;
    }

private:
    void flush() {
        for (std::size_t i = 0; i < found_; ++i) {
            const std::size_t edge = ids_[i];
            const std::uint32_t a = uses_[2 * edge].face;
            if (plain_) {
                visit_(edge, sides_.faces.is_facing(a) ? step_ : -step_);
                continue;
            }
            const std::uint32_t b = uses_[2 * edge + 1].face;
            if (sides_.faces.side(a) == 0 || sides_.faces.side(b) == 0) continue;
            const std::int32_t sum = sides_.weight(mesh_, a) - sides_.weight(mesh_, b);
            if (sum != 0) visit_(edge, sum);
        }
        found_ = 0;
    }

    std::span<const FaceUse> uses_;
    const ShadowMesh& mesh_;
    const Sides& sides_;
    const Visit& visit_;
    bool plain_ = false;
    std::int32_t step_ = 0;
    std::uint64_t tested_ = 0;
    std::size_t found_ = 0;
    std::array<std::uint32_t, most + 8> ids_;
};

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

inline constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

/// Decides all faces by the hierarchy of boxes. Calls settled(first_block, block_count, margin) for
/// pieces that together are all of them: no face of a piece changes its side while the light moves
/// no further than that (Facing::margin). `crossed`: room for a list, afterwards that of the blocks
/// that no box settled. Returns the number of nodes that were tested; nothing as soon as such
/// blocks are more than `most`: nothing is decided then.
template <class Settled>
std::optional<std::size_t> search_faces(const ShadowMesh& mesh, const BlockClassifier& classifier,
                                        FaceSides& sides, std::vector<std::uint32_t>& crossed,
                                        DetectionStats& stats, std::size_t most,
                                        const Settled& settled) {
    crossed.clear();
    const std::size_t nodes = tables_of(mesh).faces.visit(
        classifier.light(),
        [&](std::size_t first, std::size_t count, bool facing, float nearest) {
            sides.set_blocks(first, count, facing);
            settled(first, count, classifier.margin_of(nearest));
        },
        [&](std::size_t block) {
            classifier.prefetch_block(block);
            crossed.push_back(static_cast<std::uint32_t>(block));
            return crossed.size() <= most;
        });
    stats.bytes_touched += nodes * sizeof(BoxNode);
    if (crossed.size() > most) return std::nullopt;
    for (const std::uint32_t block : crossed) {
        const BlockClassifier::Block found = classifier.classify(block);
        sides.set_block(block, found.facing, found.edge_on);
        settled(block, 1, found.margin);
    }
    for (const std::uint32_t face : mesh.degenerate_faces()) sides.set_edge_on(face);
    stats.faces_tested += crossed.size() * block_size;
    stats.bytes_touched += crossed.size() * block_size * bytes_per_face_test;
    return nodes;
}

/// Decides all faces in turn. Returns the smallest margin.
inline double test_all_faces(const ShadowMesh& mesh, const BlockClassifier& classifier,
                             FaceSides& sides, DetectionStats& stats) {
    stats.faces_tested += mesh.faces().size();
    stats.bytes_touched += mesh.faces().size() * bytes_per_face_test;
    return classifier.classify_all(sides);
}

/// Calls visit(edge, count) for every silhouette edge, once. `sides` are complete. `crossed` and
/// `most`: as above, of edges; where it returns nothing, there were no calls.
template <class Visit>
std::optional<std::size_t> search_edges(const ShadowMesh& mesh, const Sides& sides,
                                        const FilterLight& light,
                                        std::vector<std::uint32_t>& crossed, DetectionStats& stats,
                                        std::size_t most, const Visit& visit) {
    crossed.clear();
    const std::size_t nodes = tables_of(mesh).edges.visit(
        light, [](std::size_t, std::size_t, bool, float) {},
        [&](std::size_t block) {
            const FaceUse* uses = mesh.uses().data() + 2 * block_size * block;
            prefetch(uses);
            prefetch(uses + block_size);
            crossed.push_back(static_cast<std::uint32_t>(block));
            return crossed.size() <= most;
        });
    stats.bytes_touched += nodes * sizeof(BoxNode);
    if (crossed.size() > most) return std::nullopt;
    RegularEdges regular(mesh, sides, visit);
    for (const std::uint32_t block : crossed) {
        const std::size_t first = block * block_size;
        regular.add(first, std::min(block_size, mesh.regular_edges() - first));
    }
    std::uint64_t tested = regular.finish();
    visit_others(mesh, sides, tested, visit);
    stats.edges_tested += tested;
    stats.bytes_touched += tested * bytes_per_edge_test;
    return nodes;
}

/// The same by looking at every edge in turn.
template <class Visit>
void test_all_edges(const ShadowMesh& mesh, const Sides& sides, DetectionStats& stats,
                    const Visit& visit) {
    RegularEdges regular(mesh, sides, visit);
    for (std::size_t first = 0; first < mesh.regular_edges(); first += regular.most) {
        regular.add(first, std::min(regular.most, mesh.regular_edges() - first));
    }
    std::uint64_t tested = regular.finish();
    visit_others(mesh, sides, tested, visit);
    stats.edges_tested += tested;
    stats.bytes_touched += tested * bytes_per_edge_test;
}

}  // namespace gnomon::shadows::internal
