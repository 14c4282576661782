// SPDX-License-Identifier: MIT
#include "internal/caster_edges.hpp"

#include <algorithm>

namespace gnomon::truth::internal {

namespace {

std::uint64_t edge_of(std::uint32_t a, std::uint32_t b) {
    return (std::uint64_t{std::min(a, b)} << 32U) | std::max(a, b);
}

}  // namespace

CasterEdges::CasterEdges(const Soup& soup) {
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        const Triangle& triangle = soup.triangles[t];
        if (!triangle.casts) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = triangle.corner_ids[k];
            const std::uint32_t to = triangle.corner_ids[(k + 1) % 3];
            uses_.push_back({edge_of(from, to), t, from < to ? 1 : -1});
        }
    }
    std::sort(uses_.begin(), uses_.end(),
              [](const Use& a, const Use& b) { return a.edge < b.edge; });
}

bool CasterEdges::is_silhouette(const Soup& soup, std::uint32_t a, std::uint32_t b,
                                const glm::dvec4& light) const {
    const std::uint64_t edge = edge_of(a, b);
    auto use = std::lower_bound(uses_.begin(), uses_.end(), edge,
                                [](const Use& u, std::uint64_t e) { return u.edge < e; });
    int sum = 0;
    for (; use != uses_.end() && use->edge == edge; ++use) {
        const Triangle& triangle = soup.triangles[use->triangle];
        const double facing =
            glm::dot(triangle.normal, glm::dvec3(light) - light.w * triangle.corners[0]);
        sum += facing > 0.0 ? use->sign : -use->sign;
    }
    return sum != 0;
}

}  // namespace gnomon::truth::internal
