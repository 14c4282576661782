// SPDX-License-Identifier: MIT
//
// TriangleTree: a bounding volume hierarchy that beams walk through. Others build it (BoxTree), but
// traverse none: their traversals are for rays, in single precision.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/truth/truth.hpp>

#include "internal/beam.hpp"
#include "internal/box_tree.hpp"
#include "internal/soup.hpp"

namespace gnomon::truth::internal {

class TriangleTree {
public:
    /// `chosen`: indices into `triangles`, which the tree refers to by number alone.
    [[nodiscard]] static Result<TriangleTree> build(std::span<const Triangle> triangles,
                                                    std::span<const std::uint32_t> chosen,
                                                    TreeBuilder builder);

    /// Calls visit(index) for every triangle whose neighbourhood the beam enters, roughly from low
    /// to high along beam.height, until it returns false. `beam` may be narrowed meanwhile.
    template <class Visit>
    void walk(const Beam& beam, double slack, Visit&& visit) const;

private:
    BoxTree tree_;
};

template <class Visit>
void TriangleTree::walk(const Beam& beam, double slack, Visit&& visit) const {
    if (tree_.nodes.empty()) return;
    std::array<std::uint32_t, BoxTree::max_depth + 2> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
        const BoxTree::Node& node = tree_.nodes[stack[--size]];
        if (beam.misses(node.center(), node.half(), slack)) continue;
        for (std::uint32_t i = 0; i < node.count; ++i) {
            if (!visit(tree_.order[node.first + i])) return;
        }
        if (node.count > 0) continue;
        const bool left_first = beam.height.at(tree_.nodes[node.first].center()) <=
                                beam.height.at(tree_.nodes[node.first + 1].center());
        stack[size++] = left_first ? node.first + 1 : node.first;
        stack[size++] = left_first ? node.first : node.first + 1;
    }
}

}  // namespace gnomon::truth::internal
