// SPDX-License-Identifier: MIT
//
// ScreenBounds: the part of a picture that something can cover, as a scissor wants it.
// Conservative: what it leaves out is provably not covered; what it holds may well be empty.
#pragma once

#include <algorithm>
#include <cstdint>

#include <glm/glm.hpp>

#include <gnomon/shadows/view.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// A rectangle in normalised device coordinates: x to the right, y up, -1 .. 1 is the picture.
struct ScreenBounds {
    glm::vec2 min{-1.0F};  ///< the lower left corner
    glm::vec2 max{1.0F};   ///< the upper right one

    /// Whether nothing is in it.
    [[nodiscard]] bool empty() const { return !(min.x < max.x && min.y < max.y); }
    /// Whether all of the picture is.
    [[nodiscard]] bool everything() const {
        return min.x <= -1.0F && min.y <= -1.0F && max.x >= 1.0F && max.y >= 1.0F;
    }
    bool operator==(const ScreenBounds&) const = default;

    /// Bounds that are empty.
    [[nodiscard]] static ScreenBounds nothing() { return {glm::vec2(1.0F), glm::vec2(-1.0F)}; }
};

/// What is in both; may be empty.
[[nodiscard]] inline ScreenBounds intersection(const ScreenBounds& a, const ScreenBounds& b) {
    return {glm::max(a.min, b.min), glm::min(a.max, b.max)};
}

/// The smallest that hold both.
[[nodiscard]] inline ScreenBounds united(const ScreenBounds& a, const ScreenBounds& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    return {glm::min(a.min, b.min), glm::max(a.max, b.max)};
}

/// Depths as the depth buffer stores them: 1 at the near plane, 0 far away.
struct DepthBounds {
    float min = 0.0F;  ///< the farthest
    float max = 1.0F;  ///< the nearest

    /// Whether no depth lies outside.
    [[nodiscard]] bool everything() const { return min <= 0.0F && max >= 1.0F; }
    bool operator==(const DepthBounds&) const = default;
};

/// Pixels of a target, row 0 on top.
struct PixelRect {
    std::uint32_t x = 0;       ///< of the left edge
    std::uint32_t y = 0;       ///< of the upper edge
    std::uint32_t width = 0;   ///< 0: empty
    std::uint32_t height = 0;  ///< 0: empty
    bool operator==(const PixelRect&) const = default;
};

/// The pixels that `bounds` touches in a target of this size, and two more on each side: a
/// rasteriser's vertices are rounded. Empty where the bounds are.
[[nodiscard]] PixelRect pixels_of(const ScreenBounds& bounds, std::uint32_t width,
                                  std::uint32_t height);

}  // namespace gnomon::shadows
#pragma GCC visibility pop
