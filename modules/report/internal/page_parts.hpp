// SPDX-License-Identifier: MIT
//
// Parts of the page, as HTML.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <gnomon/report/report.hpp>

namespace gnomon::report::internal {

/// What to use for which kind of place: the answer, with its figures and pictures.
[[nodiscard]] std::string advice_html(const Report& report);
/// A scene on a backend: its plot, its table, its pictures.
[[nodiscard]] std::string cell_html(const Cell& cell);

/// Some of a report's.
using Cells = std::vector<const Cell*>;

/// What to use for scenes of one kind, on one backend.
struct Recommendation {
    std::string technique;  ///< empty where nothing was measured in all of them
    std::string reason;     ///< sentences; HTML
};
/// Of what is general: the least wrong; of equals "auto", unless something is faster by more than 5
/// % beyond its 95 % interval in every one of the scenes. `cells` has at least one.
[[nodiscard]] Recommendation recommend(const Cells& cells);

/// Empty where the technique was not measured.
[[nodiscard]] const Row* find_row(const Cell& cell, std::string_view technique);
/// The family's least wrong, of equals the faster; null where there is none.
[[nodiscard]] const Row* least_wrong(const Cell& cell, std::string_view family);
/// Of all judged pixels: so few that hardly anybody would see them.
inline constexpr double hardly_wrong = 1e-3;
/// Places of what a scene's reader would ask for: "auto", the fastest approximation that is hardly
/// wrong, the fastest and the least wrong map, planar shadows, rays. What was not measured is left
/// out.
[[nodiscard]] std::vector<std::size_t> rivals_of_each_kind(const Cell& cell);
[[nodiscard]] std::string image_html(const Thumbnail& thumbnail, std::string_view alt);
/// 0.012 %.
[[nodiscard]] std::string percent(double share);
/// 1.23 [1.20, 1.26].
[[nodiscard]] std::string ratio_text(const Ratio& ratio);

}  // namespace gnomon::report::internal
