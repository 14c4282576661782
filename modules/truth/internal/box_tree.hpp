// SPDX-License-Identifier: MIT
//
// BoxTree: a bounding volume hierarchy over numbered boxes as two flat arrays, and who builds one:
// Embree, where it is, and a builder of our own, which every build has (a browser has no Embree).
// Walking through a tree is TriangleTree's business and the same for both.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>

namespace gnomon::truth::internal {

/// What is to be found, rounded outwards.
struct NumberedBox {
    glm::vec3 min{0.0F};
    glm::vec3 max{0.0F};
    std::uint32_t number = 0;
};

struct BoxTree {
    /// A node's stack in a walk holds one place a level.
    static constexpr std::size_t max_depth = 256;
    static constexpr std::size_t max_leaf = 2;

    struct Node {
        glm::vec3 min{0.0F};
        glm::vec3 max{0.0F};
        std::uint32_t first = 0;  ///< of `order` if count > 0, else of the two children
        std::uint32_t count = 0;

        [[nodiscard]] glm::dvec3 center() const {
            return (glm::dvec3(min) + glm::dvec3(max)) * 0.5;
        }
        [[nodiscard]] glm::dvec3 half() const { return (glm::dvec3(max) - glm::dvec3(min)) * 0.5; }
    };

    std::vector<Node> nodes;  ///< the first is the root; none where there are no boxes
    std::vector<std::uint32_t> order;
};

/// By binned surface areas (Wald 2007), on one thread. Cost: n log n; about a second for a million
/// boxes.
[[nodiscard]] BoxTree build_plainly(std::vector<NumberedBox> boxes);

/// By rtcBuildBVH, on all cores. Fails with OutOfMemory or Internal when Embree does. Not there in
/// builds by Emscripten.
[[nodiscard]] Result<BoxTree> build_by_embree(const std::vector<NumberedBox>& boxes);

}  // namespace gnomon::truth::internal
