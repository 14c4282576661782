// SPDX-License-Identifier: MIT
//
// PlanTile: the piece of a plan grid that is drawn at a time, where the grid is larger than what a
// device draws into.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gnomon/sun_study/plan_grid.hpp>

namespace gnomon::sun_study::internal {

/// So many cells a side, unless a device's textures are smaller still: what is drawn into takes
/// some 130 MB then.
inline constexpr std::uint32_t usual_tile_side = 4096;

struct PlanTile {
    std::uint32_t column = 0;  ///< of its upper left cell
    std::uint32_t row = 0;
    std::uint32_t columns = 0;  ///< that are in the grid
    std::uint32_t rows = 0;
};

/// Row by row. All but the last of a row and of a column have the same size.
[[nodiscard]] inline std::vector<PlanTile> tiles_of(const PlanGrid& grid, std::uint32_t side) {
    std::vector<PlanTile> tiles;
    for (std::uint32_t row = 0; row < grid.rows; row += side) {
        for (std::uint32_t column = 0; column < grid.columns; column += side) {
            tiles.push_back({column, row, std::min(side, grid.columns - column),
                             std::min(side, grid.rows - row)});
        }
    }
    return tiles;
}

/// The middle of a tile of columns x rows cells, the grid's or beyond it, from the grid's own
/// middle, in metres of the plan.
[[nodiscard]] inline glm::dvec2 middle_of(const PlanTile& tile, std::uint32_t columns,
                                          std::uint32_t rows, const PlanGrid& grid) {
    return glm::dvec2(tile.column + (columns - grid.columns * 1.0) * 0.5,
                      -(tile.row + (rows - grid.rows * 1.0) * 0.5)) *
           grid.cell_m;
}

}  // namespace gnomon::sun_study::internal
