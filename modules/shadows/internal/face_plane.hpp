// SPDX-License-Identifier: MIT
//
// Face planes in single precision, each with a bound on its error. docs/numerics.md, "Face planes",
// derives the bound; the names here are those of the derivation.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <glm/glm.hpp>

#include <gnomon/shadows/jobs.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>

namespace gnomon::shadows::internal {

/// Planes with a larger error have an infinite one instead, so that the single-precision filter
/// leaves them alone: slivers some 2^37 times as long as high.
inline constexpr float largest_face_error = 0x1p-12F;
/// What is left, at least, of a distance to a rounded plane for the exact one, whose normal may be
/// longer by largest_face_error.
inline constexpr double plane_shrink = 1.0 - 0x1p-10;

/// The smallest float that is not below `value`.
[[nodiscard]] float round_up(double value);

/// A face without area, exactly: it casts nothing.
inline bool is_degenerate(const FacePlanes& planes, std::size_t face) {
    return planes.error[face] == 0.0F;
}

/// One plane a face. Cost: linear; exact arithmetic for faces that are all but degenerate.
[[nodiscard]] FacePlanes make_face_planes(std::span<const glm::vec3> positions,
                                          std::span<const std::array<std::uint32_t, 3>> faces,
                                          const glm::vec3& bounds_min, const glm::vec3& bounds_max,
                                          const Jobs& jobs = {});

}  // namespace gnomon::shadows::internal
