// SPDX-License-Identifier: MIT
//
// TriangleTree: a bounding volume hierarchy that beams walk through. Embree builds it (rtcBuildBVH)
// but does not traverse it: its own traversals are for rays, in single precision.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>

#include "internal/beam.hpp"
#include "internal/soup.hpp"

namespace gnomon::truth::internal {

class TriangleTree {
public:
    /// `chosen`: indices into `triangles`, which the tree refers to by number alone.
    [[nodiscard]] static Result<TriangleTree> build(std::span<const Triangle> triangles,
                                                    std::vector<std::uint32_t> chosen);

    /// Calls visit(index) for every triangle whose neighbourhood the beam enters, roughly from low
    /// to high along beam.height, until it returns false. `beam` may be narrowed meanwhile.
    template <class Visit>
    void walk(const Beam& beam, double slack, Visit&& visit) const;

private:
    struct Node {
        glm::vec3 min{0.0F};  // rounded outwards
        glm::vec3 max{0.0F};
        std::uint32_t first = 0;  // of the triangles if count > 0, else of the two children
        std::uint32_t count = 0;

        [[nodiscard]] glm::dvec3 center() const {
            return (glm::dvec3(min) + glm::dvec3(max)) * 0.5;
        }
        [[nodiscard]] glm::dvec3 half() const { return (glm::dvec3(max) - glm::dvec3(min)) * 0.5; }
    };
    struct Flattener;
    static constexpr std::size_t max_depth = 256;

    std::vector<Node> nodes_;  // the first is the root
    std::vector<std::uint32_t> order_;
};

template <class Visit>
void TriangleTree::walk(const Beam& beam, double slack, Visit&& visit) const {
    if (nodes_.empty()) return;
    std::array<std::uint32_t, max_depth + 2> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
        const Node& node = nodes_[stack[--size]];
        if (beam.misses(node.center(), node.half(), slack)) continue;
        for (std::uint32_t i = 0; i < node.count; ++i) {
            if (!visit(order_[node.first + i])) return;
        }
        if (node.count > 0) continue;
        const bool left_first = beam.height.at(nodes_[node.first].center()) <=
                                beam.height.at(nodes_[node.first + 1].center());
        stack[size++] = left_first ? node.first + 1 : node.first;
        stack[size++] = left_first ? node.first : node.first + 1;
    }
}

}  // namespace gnomon::truth::internal
