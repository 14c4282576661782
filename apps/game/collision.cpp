// SPDX-License-Identifier: MIT
#include "collision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::game {

namespace {

struct Nearest {
    double distance_m = 0.0;    // negative within
    glm::dvec2 away{1.0, 0.0};  // unit, out of the obstacle
};

Nearest nearest(const glm::dvec2& point, const Obstacle& obstacle) {
    const glm::dvec2 offset = point - obstacle.at;
    if (obstacle.radius_m > 0.0) {
        const double length = glm::length(offset);
        return {length - obstacle.radius_m, length > 0.0 ? offset / length : glm::dvec2(1.0, 0.0)};
    }
    // The box's own axes in plan: x, and z as turned about +Y.
    const double c = std::cos(obstacle.turn_rad);
    const double s = std::sin(obstacle.turn_rad);
    const glm::dvec2 x_axis(c, -s);
    const glm::dvec2 z_axis(s, c);
    const glm::dvec2 local(glm::dot(offset, x_axis), glm::dot(offset, z_axis));
    const glm::dvec2 beyond = glm::abs(local) - obstacle.half_m;
    const glm::dvec2 side(local.x < 0.0 ? -1.0 : 1.0, local.y < 0.0 ? -1.0 : 1.0);
    const auto to_plan = [&](const glm::dvec2& v) { return x_axis * v.x + z_axis * v.y; };
    if (beyond.x <= 0.0 && beyond.y <= 0.0) {
        return beyond.x > beyond.y ? Nearest{beyond.x, to_plan({side.x, 0.0})}
                                   : Nearest{beyond.y, to_plan({0.0, side.y})};
    }
    const glm::dvec2 outside = glm::max(beyond, glm::dvec2(0.0)) * side;
    const double length = glm::length(outside);
    return {length, to_plan(outside / length)};
}

}  // namespace

double clearance(const glm::dvec2& point, std::span<const Obstacle> obstacles) {
    double least = std::numeric_limits<double>::infinity();
    for (const Obstacle& obstacle : obstacles) {
        least = std::min(least, nearest(point, obstacle).distance_m);
    }
    return least;
}

glm::dvec2 pushed_out(glm::dvec2 point, double radius_m, std::span<const Obstacle> obstacles) {
    constexpr int rounds = 4;
    for (int round = 0; round < rounds; ++round) {
        bool moved = false;
        for (const Obstacle& obstacle : obstacles) {
            const Nearest near = nearest(point, obstacle);
            if (near.distance_m >= radius_m) continue;
            point += near.away * (radius_m - near.distance_m);
            moved = true;
        }
        if (!moved) break;
    }
    return point;
}

}  // namespace gnomon::game
