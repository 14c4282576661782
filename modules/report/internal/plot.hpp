// SPDX-License-Identifier: MIT
//
// The plot of one cell as inline SVG, and how numbers and names are written in a page.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include <gnomon/report/report.hpp>

namespace gnomon::report::internal {

/// Milliseconds to the right, wrong pixels of the worst frame upwards, both logarithmic; those with
/// none have a place of their own at the bottom. The Pareto front is a line.
[[nodiscard]] std::string plot_svg(const Cell& cell);

/// In the order in which they are listed.
inline constexpr std::array<std::string_view, 7> families{
    "volumes", "projection", "silhouettes", "approximate", "shadow maps", "planar", "rays"};

/// What stands for a family in plots and tables: a small picture.
[[nodiscard]] std::string marker_svg(std::string_view family);
/// A colour a family, as #rrggbb.
[[nodiscard]] std::string_view family_color(std::string_view family);
/// For text and attributes in double quotes, of HTML and SVG alike.
[[nodiscard]] std::string escaped(std::string_view text);
/// Three digits.
[[nodiscard]] std::string three_digits(double value);
/// 12,345.
[[nodiscard]] std::string with_commas(std::uint64_t value);

}  // namespace gnomon::report::internal
