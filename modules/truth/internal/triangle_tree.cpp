// SPDX-License-Identifier: MIT
#include "internal/triangle_tree.hpp"

#include <cmath>
#include <limits>

namespace gnomon::truth::internal {

namespace {

float below(double value) {
    const auto rounded = static_cast<float>(value);
    return static_cast<double>(rounded) <= value
               ? rounded
               : std::nextafter(rounded, -std::numeric_limits<float>::infinity());
}
float above(double value) { return -below(-value); }

NumberedBox box_of(const Triangle& triangle, std::uint32_t number) {
    const auto& c = triangle.corners;
    const glm::dvec3 min = glm::min(glm::min(c[0], c[1]), c[2]);
    const glm::dvec3 max = glm::max(glm::max(c[0], c[1]), c[2]);
    return {.min = {below(min.x), below(min.y), below(min.z)},
            .max = {above(max.x), above(max.y), above(max.z)},
            .number = number};
}

}  // namespace

Result<TriangleTree> TriangleTree::build(std::span<const Triangle> triangles,
                                         std::span<const std::uint32_t> chosen,
                                         TreeBuilder builder) {
    std::vector<NumberedBox> boxes;
    boxes.reserve(chosen.size());
    for (const std::uint32_t i : chosen) boxes.push_back(box_of(triangles[i], i));
    TriangleTree result;
#ifdef GNOMON_TRUTH_EMBREE
    if (builder == TreeBuilder::Best) {
        auto built = build_by_embree(boxes);
        if (!built) return forward_error(built);
        result.tree_ = std::move(*built);
        return result;
    }
#else
    static_cast<void>(builder);
#endif
    result.tree_ = build_plainly(std::move(boxes));
    return result;
}

}  // namespace gnomon::truth::internal
