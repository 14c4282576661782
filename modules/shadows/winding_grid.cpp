// SPDX-License-Identifier: MIT
#include "internal/winding_grid.hpp"

#include <algorithm>
#include <bit>

#include <gnomon/core/expects.hpp>

namespace gnomon::shadows::internal {

namespace {

std::int64_t floor_div(std::int64_t a, std::int64_t b) {  // b > 0
    return a >= 0 ? a / b : -((-a + b - 1) / b);
}

}  // namespace

WindingGrid::WindingGrid(std::int64_t cells)
    : cells_(cells),
      step_(width / cells),
      shift_(std::countr_zero(static_cast<std::uint64_t>(step_))),
      along_row_(static_cast<std::size_t>((cells + 1) * (cells + 1)), 0),
      up_first_column_(static_cast<std::size_t>(cells + 1), 0),
      gain_(static_cast<std::size_t>(cells * cells)) {
    GNOMON_EXPECTS(cells > 0 && std::has_single_bit(static_cast<std::uint64_t>(cells)) &&
                   width % cells == 0);
}

void WindingGrid::add_edge(GridPoint a, GridPoint b, std::int32_t count) {
    if (a == b) return;
    cross_rows(a, b, count);
    cross_first_column(a, b, count);
    touch_cells(a, b, count);
}

void WindingGrid::cross_rows(GridPoint a, GridPoint b, std::int32_t count) {
    // To the right across an edge that runs down is into a counter-clockwise curve.
    const std::int32_t change = b.y < a.y ? count : -count;
    if (b.y < a.y) std::swap(a, b);
    const std::int64_t first = std::max<std::int64_t>(0, ((a.y - 2) >> shift_) + 1);
    for (std::int64_t j = first; j <= cells_ && j * step_ + 1 < b.y; ++j) {
        // The edge crosses the row within [x, x + 1): nodes beyond it are those from x + 1 on.
        const std::int64_t x = a.x + floor_div((j * step_ + 1 - a.y) * (b.x - a.x), b.y - a.y);
        const std::int64_t i = -(-x >> shift_);
        if (i >= 1 && i <= cells_)
            along_row_[static_cast<std::size_t>(j * (cells_ + 1) + i)] += change;
    }
}

void WindingGrid::cross_first_column(GridPoint a, GridPoint b, std::int32_t count) {
    const std::int32_t change = b.x > a.x ? count : -count;
    if (b.x < a.x) std::swap(a, b);
    if (a.x > 1 || b.x < 1) return;
    const std::int64_t y = a.y + floor_div((1 - a.x) * (b.y - a.y), b.x - a.x);
    const std::int64_t j = -(-y >> shift_);
    if (j >= 1 && j <= cells_) up_first_column_[static_cast<std::size_t>(j)] += change;
}

void WindingGrid::touch_cells(GridPoint a, GridPoint b, std::int32_t count) {
    const GridPoint low = glm::min(a, b) - slack;
    const GridPoint high = glm::max(a, b) + slack;
    const auto cell_of = [&](std::int64_t x) { return (x - 1) >> shift_; };
    const std::int64_t first_row = std::max<std::int64_t>(0, cell_of(low.y));
    const std::int64_t last_row = std::min(cells_ - 1, cell_of(high.y));
    const GridPoint d = b - a;
    const double slope = d.y == 0 ? 0.0 : static_cast<double>(d.x) / static_cast<double>(d.y);
    for (std::int64_t j = first_row; j <= last_row; ++j) {
        std::int64_t left = low.x;
        std::int64_t right = high.x;
        if (d.y != 0) {
            // Where the edge is while it passes this row of cells. Two units are room enough for
            // double precision and for leaving out what is behind the point; the slack has them.
            const auto x_at = [&](std::int64_t y) {
                const std::int64_t inside = std::clamp(y, low.y + slack, high.y - slack);
                return a.x + static_cast<std::int64_t>(slope * static_cast<double>(inside - a.y));
            };
            const std::int64_t x0 = x_at(j * step_ + 1 - slack);
            const std::int64_t x1 = x_at((j + 1) * step_ + 1 + slack);
            left = std::min(x0, x1) - 2 * slack;
            right = std::max(x0, x1) + 2 * slack;
        }
        const std::int64_t first = std::max<std::int64_t>(0, cell_of(left));
        const std::int64_t last = std::min(cells_ - 1, cell_of(right));
        for (std::int64_t i = first; i <= last; ++i) {
            auto& gain = gain_[static_cast<std::size_t>(j * cells_ + i)];
            // A straight way from a corner crosses the edge at most once, and gains by it only when
            // it comes from the right-hand side.
            const std::int64_t base = d.x * (j * step_ + 1 - a.y) - d.y * (i * step_ + 1 - a.x);
            if (base <= 0) gain[0] += count;
            if (base - d.y * step_ <= 0) gain[1] += count;
            if (base + d.x * step_ <= 0) gain[2] += count;
            if (base + (d.x - d.y) * step_ <= 0) gain[3] += count;
        }
    }
}

std::int64_t WindingGrid::most(std::int64_t at_first_node) const {
    std::int64_t at_row_start = at_first_node;
    std::int64_t result = 0;
    std::vector<std::int64_t> below(static_cast<std::size_t>(cells_ + 1));
    std::vector<std::int64_t> here(static_cast<std::size_t>(cells_ + 1));
    for (std::int64_t j = 0; j <= cells_; ++j) {
        at_row_start += up_first_column_[static_cast<std::size_t>(j)];
        std::int64_t at_node = at_row_start;
        for (std::int64_t i = 0; i <= cells_; ++i) {
            at_node += along_row_[static_cast<std::size_t>(j * (cells_ + 1) + i)];
            here[static_cast<std::size_t>(i)] = at_node;
            result = std::max(result, at_node);
        }
        // In a cell that no edge is near, all points have what its corners have.
        for (std::int64_t i = 0; j > 0 && i < cells_; ++i) {
            const auto c = static_cast<std::size_t>(i);
            const Gain& gain = gain_[static_cast<std::size_t>((j - 1) * cells_ + i)];
            if ((gain[0] | gain[1] | gain[2] | gain[3]) == 0) continue;
            result = std::max(result, std::min({below[c] + gain[0], below[c + 1] + gain[1],
                                                here[c] + gain[2], here[c + 1] + gain[3]}));
        }
        std::swap(below, here);
    }
    return result;
}

void WindingGrid::clear() {
    std::fill(along_row_.begin(), along_row_.end(), 0);
    std::fill(up_first_column_.begin(), up_first_column_.end(), 0);
    std::fill(gain_.begin(), gain_.end(), Gain{});
}

}  // namespace gnomon::shadows::internal
