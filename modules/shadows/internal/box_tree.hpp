// SPDX-License-Identifier: MIT
//
// BoxTree: a binary bounding volume hierarchy over numbered boxes, of faces or of casters. It knows
// boxes alone; what is in them, and what is looked for, is its users' business.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace gnomon::shadows::internal {

template <class Real>
struct Box {
    glm::vec<3, Real> min{std::numeric_limits<Real>::infinity()};
    glm::vec<3, Real> max{-std::numeric_limits<Real>::infinity()};

    void add(const glm::vec<3, Real>& p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
    void add(const Box& other) {
        min = glm::min(min, other.min);
        max = glm::max(max, other.max);
    }
    [[nodiscard]] glm::dvec3 center() const { return 0.5 * (glm::dvec3(min) + glm::dvec3(max)); }
    [[nodiscard]] glm::dvec3 half() const { return 0.5 * (glm::dvec3(max) - glm::dvec3(min)); }
};

template <class Real>
class BoxTree {
public:
    BoxTree() = default;
    /// Leaves hold at most `leaf_size` boxes. Split by the surface area heuristic in 16 bins (I.
    /// Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007). The same
    /// boxes, the same tree. Cost: O(n log n).
    BoxTree(std::span<const Box<Real>> boxes, std::uint32_t leaf_size);

    /// The same boxes at other places: the tree's shape stays. Cost: linear, without allocation.
    void refit(std::span<const Box<Real>> boxes);

    /// The boxes' numbers, leaf by leaf.
    [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }
    [[nodiscard]] bool empty() const { return nodes_.empty(); }
    /// Everything; not of an empty tree.
    [[nodiscard]] const Box<Real>& bounds() const { return nodes_.front().box; }
    /// The sum of all nodes' areas: what a search costs, up to a factor.
    [[nodiscard]] double area() const;

    /// Calls visit(place), a place in order(), for whatever lies in nodes that `enters(box)`, until
    /// it returns true; says whether it did. No allocation.
    template <class Enters, class Visit>
    bool walk(Enters&& enters, Visit&& visit) const {
        if (nodes_.empty()) return false;
        std::array<std::uint32_t, max_depth + 1> later;
        std::size_t waiting = 0;
        std::uint32_t at = 0;
        for (;;) {
            const Node& node = nodes_[at];
            if (enters(node.box)) {
                if (node.count == 0) {
                    later[waiting++] = node.next;
                    ++at;
                    continue;
                }
                for (std::uint32_t i = node.next; i < node.next + node.count; ++i) {
                    if (visit(i)) return true;
                }
            }
            if (waiting == 0) return false;
            at = later[--waiting];
        }
    }

private:
    struct Node {
        Box<Real> box;
        std::uint32_t next = 0;   // of a leaf: its first place; else the second child, for the
                                  // first one is the node that follows
        std::uint32_t count = 0;  // of a leaf: its boxes; else 0
    };
    struct Builder;
    // Beyond half of it, boxes are split by number; 2^27 of them need 27 levels more.
    static constexpr std::size_t max_depth = 96;

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
};

extern template class BoxTree<float>;
extern template class BoxTree<double>;

}  // namespace gnomon::shadows::internal
