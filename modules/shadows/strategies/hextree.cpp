// SPDX-License-Identifier: MIT
//
// The hextree: in the space of planes (n, d) a light is a hyperplane, an edge is the segment
// between the duals of its two faces' planes, and the silhouette is what crosses the hyperplane. A
// tree of 16 children a node, four deep, leaves out what is far from it.
//
// Source: "Geometry of Real Time Shadows", chapter on silhouettes in dual space, which takes it
// from A. Hertzmann and D. Zorin, "Illustrating smooth surfaces", SIGGRAPH 2000, section 4. The
// former prints the dual of a vertex as (v, -v.n); it has to be that of its tangent plane, (n,
// -n.v). A shadow volume is that of the faces, not of a smooth surface through the vertices, so
// that the duals here are the face planes'.
//
// Each node has a box round its segments and the largest error of its faces' planes, so that a node
// is left out only where all its faces provably lie on one side of the light. What is not left out
// is decided by the faces' weights, which are exact. Edges of other than two opposite faces, and
// those of faces whose planes single precision does not know, are looked at every time.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "internal/face_filter.hpp"
#include "internal/facing_first.hpp"
#include "internal/paired_edges.hpp"

namespace gnomon::shadows::internal {

namespace {

constexpr unsigned depth = 4;
constexpr std::uint32_t few = 16;  // edges that are looked at rather than divided
using Dual = glm::vec4;            // (n, d)

struct DualBox {
    Dual low{std::numeric_limits<float>::infinity()};
    Dual high{-std::numeric_limits<float>::infinity()};

    void add(const Dual& dual) {
        low = glm::min(low, dual);
        high = glm::max(high, dual);
    }
};

// Edges [first, first + count), children [children, children + child_count).
struct HexNode {
    DualBox box = {};
    float error = 0.0F;  // the largest of FacePlanes::error
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t children = 0;
    std::uint32_t child_count = 0;
};

Dual dual_point(const FacePlanes& planes, std::uint32_t face) {
    return {planes.normal_x[face], planes.normal_y[face], planes.normal_z[face],
            planes.offset[face]};
}

// Four bits a level, from the top: in which half of each axis the middle of the segment lies. So
// edges sorted by it have each node's side by side.
std::uint32_t path_of(const Dual& middle, const DualBox& world) {
    // In double: the difference of two floats can be more than a float holds, their quotient no
    // number.
    const glm::dvec4 low(world.low);
    const glm::dvec4 size =
        glm::max(glm::dvec4(world.high) - low, glm::dvec4(std::numeric_limits<float>::min()));
    const glm::dvec4 place =
        glm::clamp((glm::dvec4(middle) - low) / size * 16.0, glm::dvec4(0.0), glm::dvec4(15.0));
    std::uint32_t path = 0;
    for (unsigned level = 0; level < depth; ++level) {
        for (int axis = 0; axis < 4; ++axis) {
            const auto cell = static_cast<std::uint32_t>(place[axis]);
            path = path << 1U | (cell >> (depth - 1 - level) & 1U);
        }
    }
    return path;
}

class HexTree final : public FacingFirst {
protected:
    void prepare(const ShadowMesh& mesh) override {
        PairedEdges all = pair_edges(mesh);
        nodes_.clear();
        others_ = std::move(all.others);
        special_.clear();
        edges_.clear();
        const FacePlanes& planes = mesh.planes();
        const auto known = [&](std::uint32_t face) {
            return planes.error[face] > 0.0F && std::isfinite(planes.error[face]);
        };
        DualBox world;
        for (const PairedEdge& edge : all.pairs) {
            const bool regular = known(edge.forth) && known(edge.back);
            (regular ? edges_ : special_).push_back(edge);
            if (!regular) continue;
            world.add(dual_point(planes, edge.forth));
            world.add(dual_point(planes, edge.back));
        }
        if (edges_.empty()) return;
        struct Placed {
            std::uint32_t path;
            std::uint32_t edge;
        };
        std::vector<Placed> placed;
        placed.reserve(edges_.size());
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            const Dual middle = 0.5F * dual_point(planes, edges_[e].forth) +
                                0.5F * dual_point(planes, edges_[e].back);
            placed.push_back({path_of(middle, world), e});
        }
        std::ranges::stable_sort(placed, {}, &Placed::path);
        std::vector<std::uint32_t> paths;
        std::vector<PairedEdge> sorted;
        paths.reserve(placed.size());
        sorted.reserve(placed.size());
        for (const auto& [path, edge] : placed) {
            paths.push_back(path);
            sorted.push_back(edges_[edge]);
        }
        edges_ = std::move(sorted);
        nodes_.push_back({.first = 0, .count = static_cast<std::uint32_t>(edges_.size())});
        divide(0, 0, paths);
        bound(planes);
    }

    void find_edges(const ShadowMesh& mesh, LightLocal light, std::span<const std::int8_t> weights,
                    std::vector<SilhouetteEdge>& silhouette, DetectionStats& stats) override {
        const FilterLight hyperplane = filter_light(mesh.planes(), light);
        std::uint64_t tested = others_.size() + special_.size();
        std::uint64_t visited = 0;
        open_.clear();
        if (!nodes_.empty()) open_.push_back(0);
        while (!open_.empty()) {
            const HexNode& node = nodes_[open_.back()];
            open_.pop_back();
            ++visited;
            if (is_on_one_side(node, hyperplane)) continue;
            for (std::uint32_t i = 0; i < node.child_count; ++i) {
                open_.push_back(node.children + i);
            }
            if (node.child_count > 0) continue;
            for (std::uint32_t e = node.first; e < node.first + node.count; ++e) {
                append_edge(edges_[e], weights, silhouette);
            }
            tested += node.count;
        }
        for (const PairedEdge& edge : special_) append_edge(edge, weights, silhouette);
        append_edges(mesh, others_, weights, silhouette);
        stats.edges_tested = tested;
        stats.bytes_touched += visited * sizeof(HexNode) + tested * (sizeof(PairedEdge) + 2);
    }

    [[nodiscard]] std::size_t own_bytes() const override {
        return sizeof *this + (edges_.capacity() + special_.capacity()) * sizeof(PairedEdge) +
               (others_.capacity() + open_.capacity()) * sizeof(std::uint32_t) +
               nodes_.capacity() * sizeof(HexNode);
    }

private:
    void divide(std::uint32_t index, unsigned level, std::span<const std::uint32_t> paths) {
        if (level == depth || nodes_[index].count <= few) return;
        const unsigned shift = 4 * (depth - 1 - level);
        const auto children = static_cast<std::uint32_t>(nodes_.size());
        const std::uint32_t end = nodes_[index].first + nodes_[index].count;
        for (std::uint32_t first = nodes_[index].first; first < end;) {
            std::uint32_t last = first + 1;
            while (last < end && paths[last] >> shift == paths[first] >> shift) ++last;
            nodes_.push_back({.first = first, .count = last - first});
            first = last;
        }
        const auto count = static_cast<std::uint32_t>(nodes_.size()) - children;
        nodes_[index].children = children;
        nodes_[index].child_count = count;
        for (std::uint32_t i = 0; i < count; ++i) divide(children + i, level + 1, paths);
    }

    // Children come after their parents.
    void bound(const FacePlanes& planes) {
        for (std::size_t i = nodes_.size(); i-- > 0;) {
            HexNode& node = nodes_[i];
            for (std::uint32_t c = 0; c < node.child_count; ++c) {
                const HexNode& child = nodes_[node.children + c];
                node.box.add(child.box.low);
                node.box.add(child.box.high);
                node.error = std::max(node.error, child.error);
            }
            if (node.child_count > 0) continue;
            for (std::uint32_t e = node.first; e < node.first + node.count; ++e) {
                for (const std::uint32_t face : {edges_[e].forth, edges_[e].back}) {
                    node.box.add(dual_point(planes, face));
                    node.error = std::max(node.error, planes.error[face]);
                }
            }
        }
    }

    // The value of the facing test over the whole box: its middle and how far it reaches to either
    // side. Double precision rounds by less than the planes' error leaves for the arithmetic of
    // single precision (docs/numerics.md, "Face planes"). False where anything is not a number.
    static bool is_on_one_side(const HexNode& node, const FilterLight& light) {
        const glm::dvec4 p(glm::vec4(light.towards, light.w));
        const glm::dvec4 low(node.box.low);
        const glm::dvec4 high(node.box.high);
        const double middle = glm::dot(0.5 * (low + high), p);
        const double reach = glm::dot(0.5 * (high - low), glm::abs(p));
        const double error = static_cast<double>(node.error) * static_cast<double>(light.reach);
        return std::abs(middle) - reach > error;
    }

    std::vector<PairedEdge> edges_;      // leaf by leaf
    std::vector<PairedEdge> special_;    // of faces without a plane
    std::vector<std::uint32_t> others_;  // of ShadowMesh::edges()
    std::vector<HexNode> nodes_;
    std::vector<std::uint32_t> open_;
};

}  // namespace

std::unique_ptr<SilhouetteDetector> hextree_detector() { return std::make_unique<HexTree>(); }

}  // namespace gnomon::shadows::internal
