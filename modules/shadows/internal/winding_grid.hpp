// SPDX-License-Identifier: MIT
//
// The most that a closed curve winds about any point of the plane: bounded cell by cell of a grid,
// with winding numbers that are exact on its nodes. Integer coordinates, so that nothing rounds.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace gnomon::shadows::internal {

using GridPoint = glm::vec<2, std::int64_t>;

class WindingGrid {
public:
    /// Nodes lie on odd coordinates, 1 + i * width / cells; vertices on even ones, so that no
    /// vertex lies on a line of nodes.
    static constexpr std::int64_t width = std::int64_t{1} << 28U;
    /// How far vertices may be from where they should be; edges count for the cells this near.
    static constexpr std::int64_t slack = 16;

    /// `cells` a side, a power of two up to 2^16.
    explicit WindingGrid(std::int64_t cells);

    /// One straight piece of the curve, passed `count` times from a to b; coordinates within
    /// +-2^29. Pieces outside the grid may be left out, but those left of it or below are needed
    /// where the winding about the first node is not given.
    void add_edge(GridPoint a, GridPoint b, std::int32_t count);

    /// At least the winding number about every point of the grid (counter-clockwise is positive)
    /// when that about the first node (1, 1) is `at_first_node`.
    [[nodiscard]] std::int64_t most(std::int64_t at_first_node) const;

    /// As it was at first: without a piece.
    void clear();

private:
    void cross_rows(GridPoint a, GridPoint b, std::int32_t count);
    void cross_first_column(GridPoint a, GridPoint b, std::int32_t count);
    void touch_cells(GridPoint a, GridPoint b, std::int32_t count);

    std::int64_t cells_;
    std::int64_t step_;
    int shift_;  // step_ is two to this
    // What the winding number changes by on the way to a node: along its row from the node before,
    // and up the first column.
    std::vector<std::int32_t> along_row_;
    std::vector<std::int32_t> up_first_column_;
    // For each cell and each of its corners: how much more a point of the cell may have.
    using Gain = std::array<std::int32_t, 4>;
    std::vector<Gain> gain_;
};

}  // namespace gnomon::shadows::internal
