// SPDX-License-Identifier: MIT
//
// The colour bar of a heat map of hours.
#pragma once

#include <array>

#include "profile/canvas.hpp"

namespace gnomon::cli {

/// From no sun to most: matplotlib's inferno, in nine places.
inline constexpr std::array<Color, 9> heat_colors{{{0.0, 0.0, 0.016},
                                                   {0.122, 0.047, 0.282},
                                                   {0.333, 0.059, 0.427},
                                                   {0.533, 0.133, 0.416},
                                                   {0.729, 0.212, 0.333},
                                                   {0.890, 0.349, 0.200},
                                                   {0.976, 0.549, 0.039},
                                                   {0.976, 0.788, 0.196},
                                                   {0.988, 1.000, 0.643}}};

/// Whole hours between ticks, for so many hours in all.
[[nodiscard]] double hour_tick(double hours);

/// Of so many hours of `most_h`, which may be none.
[[nodiscard]] Color heat_color(double hours, double most_h);

/// The colours from `least_h` at the bottom to `most_h` on top, with ticks at whole hours. Nothing
/// where they are the same.
void color_bar(Canvas& canvas, const glm::dvec2& at, double height, std::span<const Color> colors,
               double least_h, double most_h);

}  // namespace gnomon::cli
