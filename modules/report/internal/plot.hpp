// SPDX-License-Identifier: MIT
//
// The plot of one cell as inline SVG, and how names, numbers and families are written in a page.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <gnomon/report/report.hpp>

namespace gnomon::report::internal {

/// Milliseconds to the right, wrong pixels of the worst frame upwards, both logarithmic; below,
/// those without a wrong pixel, a lane a family. The Pareto front is a dashed line, what "auto"
/// takes a line through all.
[[nodiscard]] std::string plot_svg(const Cell& cell);

/// In the order in which they are listed.
inline constexpr std::array<std::string_view, 7> families{
    "volumes", "projection", "silhouettes", "approximate", "shadow maps", "planar", "rays"};

/// Places of rows whose names a plot shows, the ones that matter most first: "auto", what nothing
/// beats, and what the page's advice speaks of.
[[nodiscard]] std::vector<std::size_t> worth_a_name(const Cell& cell);

/// A shape a family, so that colours are not needed to tell them apart: an SVG path without its
/// end, about 2 `r` wide around x, y.
[[nodiscard]] std::string marker_shape(std::string_view family, double x, double y, double r);
/// What stands for a family in plots and tables: a small picture.
[[nodiscard]] std::string marker_svg(std::string_view family);
/// A colour a family, as #rrggbb.
[[nodiscard]] std::string_view family_color(std::string_view family);
/// For text and attributes in double quotes, of HTML and SVG alike.
[[nodiscard]] std::string escaped(std::string_view text);
/// Three digits, five decimals at most; 0 below 0.000005. Not for negative values.
[[nodiscard]] std::string three_digits(double value);
/// 12,345.
[[nodiscard]] std::string with_commas(std::uint64_t value);

}  // namespace gnomon::report::internal
