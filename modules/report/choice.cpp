// SPDX-License-Identifier: MIT
//
// Which of many techniques a reader is shown by name.
#include <algorithm>
#include <vector>

#include <gnomon/report/writers.hpp>

#include "internal/page_parts.hpp"
#include "internal/plot.hpp"

namespace gnomon::report::internal {

namespace {

/// Rows without one twice.
class Choice {
public:
    explicit Choice(const Cell& cell) : cell_(cell) {}
    void add(const Row* row) {
        if (row == nullptr) return;
        const auto at = static_cast<std::size_t>(row - cell_.rows.data());
        if (std::ranges::find(rows, at) == rows.end()) rows.push_back(at);
    }
    std::vector<std::size_t> rows;

private:
    const Cell& cell_;
};

const Row* fastest_of(const Cell& cell, std::string_view family, double most_wrong_share) {
    const Row* fastest = nullptr;
    for (const Row& row : cell.rows) {
        if (row.family != family || !row.skipped.empty() ||
            row.errors.wrong_share_worst > most_wrong_share) {
            continue;
        }
        if (fastest == nullptr || comparable_ms(cell, row) < comparable_ms(cell, *fastest)) {
            fastest = &row;
        }
    }
    return fastest;
}

}  // namespace

const Row* find_row(const Cell& cell, std::string_view technique) {
    const auto found = std::ranges::find(cell.rows, technique, &Row::technique);
    return found != cell.rows.end() && found->skipped.empty() ? &*found : nullptr;
}

const Row* least_wrong(const Cell& cell, std::string_view family) {
    const Row* best = nullptr;
    const auto cost = [&](const Row& row) {
        return std::pair(row.errors.wrong_worst, comparable_ms(cell, row));
    };
    for (const Row& row : cell.rows) {
        if (row.family != family || !row.skipped.empty()) continue;
        if (best == nullptr || cost(row) < cost(*best)) best = &row;
    }
    return best;
}

std::vector<std::size_t> rivals_of_each_kind(const Cell& cell) {
    Choice choice(cell);
    choice.add(find_row(cell, "auto"));
    choice.add(fastest_of(cell, "approximate", hardly_wrong));
    choice.add(fastest_of(cell, "shadow maps", 1.0));
    choice.add(least_wrong(cell, "shadow maps"));
    choice.add(find_row(cell, "planar"));
    choice.add(find_row(cell, "ray casting"));
    return choice.rows;
}

std::vector<std::size_t> worth_a_name(const Cell& cell) {
    Choice choice(cell);
    choice.add(find_row(cell, "auto"));
    for (const std::size_t row : pareto_front(cell)) choice.add(&cell.rows[row]);
    for (const std::size_t row : rivals_of_each_kind(cell)) choice.add(&cell.rows[row]);
    choice.add(fastest_of(cell, "projection", 1.0));
    choice.add(find_row(cell, "depth-pass"));
    choice.add(find_row(cell, "depth-fail"));
    return choice.rows;
}

}  // namespace gnomon::report::internal
