// SPDX-License-Identifier: MIT
//
// Collision in plan: a figure is a circle, and what stands in its way is boxes and circles. That is
// enough where nobody climbs.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace gnomon::game {

/// A box with a turn in plan, or a circle where `radius_m` is not zero.
struct Obstacle {
    glm::dvec2 at{0.0};
    glm::dvec2 half_m{0.0};
    double turn_rad = 0.0;  ///< plan angle (level.hpp)
    double radius_m = 0.0;
};

/// How far `point` is from the nearest obstacle; negative within one. Infinite without any.
[[nodiscard]] double clearance(const glm::dvec2& point, std::span<const Obstacle> obstacles);

/// `point` moved by the least that leaves it `radius_m` away from everything, as far as a few
/// rounds get; in a crack that is too narrow it stays between the two.
[[nodiscard]] glm::dvec2 pushed_out(glm::dvec2 point, double radius_m,
                                    std::span<const Obstacle> obstacles);

}  // namespace gnomon::game
