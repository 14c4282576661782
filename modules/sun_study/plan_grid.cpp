// SPDX-License-Identifier: MIT
#include <gnomon/sun_study/plan_grid.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace gnomon::sun_study {

Result<PlanGrid> make_grid(const glm::dvec2& min_m, const glm::dvec2& max_m, double cell_m,
                           double height_m, std::uint32_t most_cells_a_side,
                           std::uint64_t most_cells) {
    const glm::dvec2 size = max_m - min_m;
    if (!std::isfinite(size.x + size.y + cell_m + height_m)) {
        return fail(ErrorCode::InvalidInput, "The grid's area, height or cell size is not finite.");
    }
    if (!(cell_m > 0.0)) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("The grid's cells of {} m have no size.", cell_m));
    }
    if (!(size.x > 0.0) || !(size.y > 0.0)) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("The grid's area of {} x {} m is empty.", size.x, size.y));
    }
    const double farthest =
        std::max({std::abs(min_m.x), std::abs(min_m.y), std::abs(max_m.x), std::abs(max_m.y)});
    if (farthest * 1e-12 > cell_m) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("The grid's cells of {} m are too small for coordinates of {} m: "
                                "double precision has no digits left between them.",
                                cell_m, farthest));
    }
    // A hair less, so that what is a whole number of cells but for rounding stays one.
    const glm::dvec2 cells = glm::ceil(size / cell_m * (1.0 - 1e-9));
    if (cells.x > most_cells_a_side || cells.y > most_cells_a_side) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("The grid of {:.0f} x {:.0f} cells is larger than {} a side, the "
                                "most at a time; larger cells or a smaller area fit.",
                                cells.x, cells.y, most_cells_a_side));
    }
    if (cells.x * cells.y > static_cast<double>(most_cells)) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("The grid of {:.0f} x {:.0f} cells has more than {}, the most at a "
                                "time; larger cells or a smaller area fit.",
                                cells.x, cells.y, most_cells));
    }
    PlanGrid grid;
    grid.min_m = min_m;
    grid.cell_m = cell_m;
    grid.columns = static_cast<std::uint32_t>(std::max(cells.x, 1.0));
    grid.rows = static_cast<std::uint32_t>(std::max(cells.y, 1.0));
    grid.height_m = height_m;
    return grid;
}

}  // namespace gnomon::sun_study
