// SPDX-License-Identifier: MIT
//
// Normals from faces, for files that have none or bad ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/glm.hpp>

namespace gnomon::scene::internal {

/// Unit normal of a triangle, counter-clockwise; +Y where it has no area.
[[nodiscard]] glm::vec3 face_normal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Makes every normal a unit vector; one that is zero or not finite becomes the area-weighted mean
/// of its faces' normals. Returns how many were replaced so.
std::size_t repair_normals(std::span<glm::vec3> normals, std::span<const glm::vec3> positions,
                           std::span<const std::uint32_t> indices);

}  // namespace gnomon::scene::internal
