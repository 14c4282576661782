// SPDX-License-Identifier: MIT
//
// Soup: every triangle of a scene, posed, in double precision and relative to the tracer's origin.
// Nothing is rounded to single precision: what looks the same at the world's origin looks the same
// a million metres away.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>

#include <gnomon/truth/truth.hpp>

namespace gnomon::truth::internal {

struct Triangle {
    std::array<glm::dvec3, 3> corners;
    glm::dvec3 normal{0.0};                     ///< unit
    std::array<std::uint32_t, 3> corner_ids{};  ///< equal where positions are, across instances
    std::uint32_t instance = 0;
    bool casts = false;
    bool receives = false;
};

struct Soup {
    std::vector<Triangle> triangles;  ///< without those that have no area
    std::vector<double> reach_m;      ///< per instance: how far it extends from its own origin
    double farthest_reach_m = 0.0;    ///< of all instances
    /// What double precision cannot tell apart in this scene, in metres: poses are products, so
    /// coincident surfaces of different instances are equal only within this.
    double noise_m = 0.0;
};

/// Fails with InvalidInput for a position that is not finite or absurdly far away, an index out of
/// range, or indices that are not whole triangles.
[[nodiscard]] Result<Soup> make_soup(std::span<const Instance> instances, const glm::dvec3& origin);

}  // namespace gnomon::truth::internal
