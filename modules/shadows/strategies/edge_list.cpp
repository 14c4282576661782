// SPDX-License-Identifier: MIT
//
// The edge list: made once from the triangles alone in two passes, then one pass over it a light.
//
// Source: E. Lengyel, "Building an Edge List for an Arbitrary Mesh", Terathon Software (2003), and
// "The Mechanics of Robust Stencil Shadows", Gamasutra (2002), section "Silhouettes". The first
// pass makes an edge wherever a triangle runs from a smaller to a larger index and chains it to the
// smaller one; the second looks up the edges that run the other way. Lengyel's mesh is closed,
// with two triangles an edge; here what finds no partner is kept as well, and edges that are there
// several times are summed up, so that any mesh does. A partner leaves its chain when found, which
// keeps a fan of n triangles linear where its triangles come in order; else the second pass costs
// the square of the largest number of edges at a vertex.
#include <algorithm>
#include <limits>

#include "internal/facing_first.hpp"
#include "internal/paired_edges.hpp"

namespace gnomon::shadows::internal {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// low -> high is run by `forth`, high -> low by `back`; either may be none.
using ListedEdge = PairedEdge;

std::vector<ListedEdge> make_edge_list(const ShadowMesh& mesh) {
    struct Chain {
        std::uint32_t first = none;
        std::uint32_t last = none;
    };
    std::vector<ListedEdge> edges;
    std::vector<std::uint32_t> next;  // by edge
    std::vector<Chain> chains(mesh.positions().size());
    const auto faces = mesh.faces();
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        if (mesh.is_degenerate(f)) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = faces[f][i];
            const std::uint32_t to = faces[f][(i + 1) % 3];
            if (from > to) continue;
            const auto edge = static_cast<std::uint32_t>(edges.size());
            edges.push_back({from, to, f, none});
            next.push_back(none);
            Chain& chain = chains[from];
            (chain.first == none ? chain.first : next[chain.last]) = edge;
            chain.last = edge;
        }
    }
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        if (mesh.is_degenerate(f)) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = faces[f][i];
            const std::uint32_t to = faces[f][(i + 1) % 3];
            if (from < to) continue;
            std::uint32_t* link = &chains[to].first;
            while (*link != none && edges[*link].high != from) link = &next[*link];
            if (*link == none) {
                edges.push_back({to, from, none, f});
            } else {
                edges[*link].back = f;
                *link = next[*link];
            }
        }
    }
    return edges;
}

class EdgeList final : public FacingFirst {
protected:
    // Edges that are there once come first, then the rest, equal ones side by side.
    void prepare(const ShadowMesh& mesh) override {
        edges_ = make_edge_list(mesh);
        const auto ends = [](const ListedEdge& e) { return std::uint64_t{e.low} << 32U | e.high; };
        std::ranges::sort(edges_, {}, ends);
        std::vector<ListedEdge> repeated;
        std::size_t kept = 0;
        for (std::size_t begin = 0; begin < edges_.size();) {
            std::size_t end = begin + 1;
            while (end < edges_.size() && ends(edges_[end]) == ends(edges_[begin])) ++end;
            const ListedEdge& edge = edges_[begin];
            if (end == begin + 1 && edge.forth != none && edge.back != none) {
                edges_[kept++] = edge;
            } else {
                repeated.insert(repeated.end(), &edges_[begin], &edges_[begin] + (end - begin));
            }
            begin = end;
        }
        pairs_ = kept;
        edges_.resize(kept);
        edges_.insert(edges_.end(), repeated.begin(), repeated.end());
        edges_.shrink_to_fit();
    }

    void find_edges(const ShadowMesh& /*mesh*/, LightLocal /*light*/,
                    std::span<const std::int8_t> weights, std::vector<SilhouetteEdge>& silhouette,
                    DetectionStats& stats) override {
        const std::span<const ListedEdge> edges(edges_);
        for (const ListedEdge& edge : edges.first(pairs_)) append_edge(edge, weights, silhouette);
        for (std::size_t begin = pairs_; begin < edges.size();) {
            const ListedEdge& edge = edges[begin];
            std::int32_t sum = 0;
            for (; begin < edges.size() && edges[begin].low == edge.low &&
                   edges[begin].high == edge.high;
                 ++begin) {
                if (edges[begin].forth != none) sum += weights[edges[begin].forth];
                if (edges[begin].back != none) sum -= weights[edges[begin].back];
            }
            append_edge(edge.low, edge.high, sum, silhouette);
        }
        stats.edges_tested = edges.size();
        stats.bytes_touched += edges.size() * (sizeof(ListedEdge) + 2);
    }

    [[nodiscard]] std::size_t own_bytes() const override {
        return sizeof *this + edges_.capacity() * sizeof(ListedEdge);
    }

private:
    std::vector<ListedEdge> edges_;
    std::size_t pairs_ = 0;
};

}  // namespace

std::unique_ptr<SilhouetteDetector> edge_list_detector() { return std::make_unique<EdgeList>(); }

}  // namespace gnomon::shadows::internal
