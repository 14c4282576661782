// SPDX-License-Identifier: MIT
//
// PlanGrid: square cells on a horizontal plane, seen from above. It is where sun hours are counted,
// and its cells are the pixels of every plan picture.
//
// Plan coordinates are the user's own, in metres and double precision, however far from zero: x to
// the right, y up the plan, height towards the zenith. In gnomon's world, which is +Y up, that is
// (x, height, -y).
#pragma once

#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>

namespace gnomon::sun_study {

struct PlanGrid {
    glm::dvec2 min_m{0.0};  ///< the lower left corner of the lower left cell
    double cell_m = 1.0;
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;  ///< row 0 is the uppermost, as in every picture
    double height_m = 0.0;

    [[nodiscard]] std::size_t cell_count() const { return std::size_t{columns} * rows; }
    [[nodiscard]] glm::dvec2 size_m() const { return glm::dvec2(columns, rows) * cell_m; }
    [[nodiscard]] glm::dvec2 max_m() const { return min_m + size_m(); }
    /// Where a cell is asked about.
    [[nodiscard]] glm::dvec2 center_m(std::uint32_t column, std::uint32_t row) const {
        return {min_m.x + (column + 0.5) * cell_m, min_m.y + (rows - row - 0.5) * cell_m};
    }
};

/// The cells that cover an area: whole cells, from its lower left corner on. Fails with
/// ErrorCode::InvalidInput, and one sentence, for an area or a cell without a size, for what is not
/// finite, for more than `most_cells_a_side` or `most_cells` in all, and for cells so far from zero
/// that double precision does not tell their edges apart.
[[nodiscard]] Result<PlanGrid> make_grid(const glm::dvec2& min_m, const glm::dvec2& max_m,
                                         double cell_m, double height_m,
                                         std::uint32_t most_cells_a_side,
                                         std::uint64_t most_cells = ~std::uint64_t{0});

/// gnomon's world from plan coordinates, and back.
[[nodiscard]] inline glm::dvec3 world_from_plan(const glm::dvec3& plan) {
    return {plan.x, plan.z, -plan.y};
}
[[nodiscard]] inline glm::dvec3 plan_from_world(const glm::dvec3& world) {
    return {world.x, -world.z, world.y};
}

}  // namespace gnomon::sun_study
