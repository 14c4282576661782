// SPDX-License-Identifier: MIT
#include "internal/mesh_normals.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace gnomon::scene::internal {
namespace {

glm::vec3 unit_or_up(const glm::dvec3& v) {
    const double length = glm::length(v);
    if (!(length > 0.0) || !std::isfinite(length)) return {0.0F, 1.0F, 0.0F};
    return v / length;
}

/// Twice the area, along the normal. In double: products of floats can neither overflow nor vanish.
glm::dvec3 area_vector(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return glm::cross(b - a, c - a);
}

}  // namespace

glm::vec3 face_normal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return unit_or_up(area_vector(a, b, c));
}

std::size_t repair_normals(std::span<glm::vec3> normals, std::span<const glm::vec3> positions,
                           std::span<const std::uint32_t> indices) {
    std::vector<bool> bad(normals.size(), false);
    std::size_t bad_count = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const glm::dvec3 normal = normals[i];
        const double length = glm::length(normal);
        if (length > 1e-20 && std::isfinite(length)) {
            normals[i] = normal / length;
        } else {
            bad[i] = true;
            ++bad_count;
        }
    }
    if (bad_count == 0) return 0;

    std::vector<glm::dvec3> sums(normals.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const std::array<std::uint32_t, 3> corners{indices[i], indices[i + 1], indices[i + 2]};
        const glm::dvec3 area =
            area_vector(positions[corners[0]], positions[corners[1]], positions[corners[2]]);
        for (const std::uint32_t corner : corners) sums[corner] += area;
    }
    for (std::size_t i = 0; i < normals.size(); ++i) {
        if (bad[i]) normals[i] = unit_or_up(sums[i]);
    }
    return bad_count;
}

}  // namespace gnomon::scene::internal
