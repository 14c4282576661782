// SPDX-License-Identifier: MIT
//
// Does the way from a point to a light cross a face? By signs of determinants alone: filtered in
// double precision, exact where the filter cannot decide. On the lines and corners that faces share
// the point counts as moved infinitely little (exact_side), always the same way, so that no
// neighbour is counted twice or missed.
//
// Source: J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
// Predicates" (1997), for the bound; docs/numerics.md, "Shadow queries".
#pragma once

#include <array>

#include <glm/glm.hpp>

#include "box_tree.hpp"

namespace gnomon::shadows::internal {

/// exact_orientation behind a filter.
int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                const glm::dvec4& light);

/// The straight way from a point to a light, or in a light's direction.
class Sight {
public:
    /// The light may be where it is told to be, or less than `slack` beside it.
    Sight(const glm::dvec3& point, const glm::dvec4& light, double slack = 0.0);

    [[nodiscard]] const glm::dvec3& point() const { return point_; }
    [[nodiscard]] const glm::dvec4& light() const { return light_; }

    /// False only when the way does not come as near as the slack to the box.
    [[nodiscard]] bool enters(const Box<double>& box) const;
    /// Whether the face lies strictly between point and light. A face whose plane contains either
    /// does not. Exact.
    [[nodiscard]] bool crosses(const std::array<glm::dvec3, 3>& face) const;

private:
    glm::dvec3 point_;
    glm::dvec4 light_;
    glm::dvec3 towards_;
    glm::dvec3 inverse_;
    double slack_;
    double end_;  // of the way, in units of towards_
};

}  // namespace gnomon::shadows::internal
