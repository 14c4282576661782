// SPDX-License-Identifier: MIT
//
// Convex outlines of a few points on the picture, and how much of a rectangle they cover.
#pragma once

#include <span>

#include <glm/glm.hpp>

namespace gnomon::shadows::internal {

/// The area of what the convex hull of `points`, which are sorted, has within a rectangle. Cost:
/// n log n, some hundred flops for a dozen points. The hull after A. M. Andrew, "Another Efficient
/// Algorithm for Convex Hulls in Two Dimensions" (1979).
[[nodiscard]] double hull_area_within(std::span<glm::dvec2> points, const glm::dvec2& low,
                                      const glm::dvec2& high);

}  // namespace gnomon::shadows::internal
