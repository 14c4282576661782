// SPDX-License-Identifier: MIT
//
// Depth-pass or depth-fail, chosen for each pair of caster and light. Depth-pass counts the
// volume's faces in front of a surface and is wrong when the near plane cuts the volume; depth-fail
// counts those behind and needs caps. Both give the same count where both are valid, so they may
// mix in one stencil buffer.
#pragma once

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

#include <gnomon/shadows/view.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// How a volume is counted.
enum class Technique : std::uint8_t {
    DepthPass,  ///< its faces in front of a surface, after Heidmann (1991)
    DepthFail,  ///< its faces behind a surface, after Bilodeau and Songy (1999) and Carmack (2000)
};

/// A box with a pose: a caster's bounds in its own space.
struct OrientedBounds {
    glm::dmat4 world_from_local{1.0};  ///< affine
    glm::dvec3 min{0.0};               ///< in its own space, metres
    glm::dvec3 max{0.0};               ///< in its own space, metres
};

/// Its eight corners in world space; bit 0, 1, 2 of the place says max.x, max.y, max.z.
[[nodiscard]] std::array<glm::dvec3, 8> corners_of(const OrientedBounds& bounds);

/// True when no shadow of anything inside `bounds` can reach the view's near rectangle, so that
/// depth-pass counts right. Conservative: false when in doubt. The near-clip volume is the hull of
/// the light and the near rectangle, widened by a few per cent for the rasteriser's rounding. After
/// E. Lengyel, "The Mechanics of Robust Stencil Shadows" (2002), as a separating-axis test. Cost:
/// some hundred flops.
[[nodiscard]] bool depth_pass_is_valid(const OrientedBounds& bounds, const glm::dvec4& light_world,
                                       const View& view);

}  // namespace gnomon::shadows
#pragma GCC visibility pop
