// SPDX-License-Identifier: MIT
//
// CasterEdges: which edges are silhouette edges of the casters for a light. Shadow volumes begin
// there, so where such an edge is an outline of what is seen, the very edge of a shadow lies on it,
// lit as both sides of it may be.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "internal/soup.hpp"

namespace gnomon::truth::internal {

class CasterEdges {
public:
    explicit CasterEdges(const Soup& soup);

    /// The edge between two corner ids. `light`: as the soup's corners, relative to its origin.
    /// Cost: logarithmic.
    [[nodiscard]] bool is_silhouette(const Soup& soup, std::uint32_t a, std::uint32_t b,
                                     const glm::dvec4& light) const;

private:
    struct Use {
        std::uint64_t edge = 0;  // the smaller corner id, then the larger
        std::uint32_t triangle = 0;
        std::int32_t sign = 0;  // +1: the triangle runs from the smaller id to the larger
    };
    std::vector<Use> uses_;  // sorted by edge
};

}  // namespace gnomon::truth::internal
