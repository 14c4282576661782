// SPDX-License-Identifier: MIT
//
// What a report is written as. All of them take any names: they are escaped.
#pragma once

#include <string>

#include <gnomon/core/result.hpp>
#include <gnomon/report/report.hpp>

namespace gnomon::report {

/// A line a technique, scene and backend; RFC 4180.
[[nodiscard]] std::string to_csv(const Report& report);
/// Everything but the thumbnails. A displacement that is infinite is null.
[[nodiscard]] std::string to_json(const Report& report);
/// One page that needs nothing else: no script, no network.
[[nodiscard]] std::string to_html(const Report& report);

/// A cell with its thumbnails, to be kept.
[[nodiscard]] std::string cell_to_json(const Cell& cell);
/// Fails with InvalidInput for what cell_to_json() did not write.
[[nodiscard]] Result<Cell> cell_from_json(const std::string& text);

/// What a technique's frame takes beside those of "auto" that were measured with it: its ratio
/// times the median of "auto". Unlike its own median it does not tell when in the run it was
/// measured. The median where there is no "auto".
[[nodiscard]] double comparable_ms(const Cell& cell, const Row& row);

/// Techniques that nothing else is both faster and less wrong than, fastest first; what was skipped
/// is in none. Of equals the earlier row. What is as wrong as "auto" and not faster beyond the 95 %
/// interval counts as slower.
[[nodiscard]] std::vector<std::size_t> pareto_front(const Cell& cell);

/// Techniques with no more wrong pixels than "auto" that are faster by more than 5 % beyond their
/// 95 % interval.
[[nodiscard]] std::vector<std::size_t> better_than_auto(const Cell& cell);

}  // namespace gnomon::report
