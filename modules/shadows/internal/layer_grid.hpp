// SPDX-License-Identifier: MIT
//
// A coarse answer, and one that is kept in step: whether a light's volumes can pile up too many
// layers in any direction. Its pictures (footprint.hpp) are divided into cells, and each cell sums
// up what touches it: at least what any direction in it sees.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/technique.hpp>

#include "footprint.hpp"

namespace gnomon::shadows::internal {

class LayerGrid {
public:
    /// For one light where it is, which `all` are seen from. Cost: linear.
    LayerGrid(const glm::dvec4& light_world, std::span<const Footprint> all, std::uint32_t limit);

    void add(const OrientedBounds& bounds, std::uint32_t layers) { change(bounds, layers, 1); }
    /// The same that were added, to the bit.
    void remove(const OrientedBounds& bounds, std::uint32_t layers) { change(bounds, layers, -1); }

    /// True: no direction has more layers than the limit. False: one may have.
    [[nodiscard]] bool within_limit() const { return cells_over_ == 0; }
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    void change(const OrientedBounds& bounds, std::uint32_t layers, std::int64_t sign);
    void change(const Footprint& footprint, std::int64_t sign);
    [[nodiscard]] glm::uvec2 cell_of(const glm::dvec2& place) const;

    glm::dvec4 light_;
    std::int64_t limit_;
    std::uint32_t cells_;  // a side
    // Places become cells by this; those outside are in the outermost.
    glm::dvec2 origin_{-1.0};
    glm::dvec2 cells_per_unit_{1.0};
    std::array<std::vector<std::uint32_t>, 6> pictures_;  // empty where nothing is
    std::uint64_t cells_over_ = 0;
    std::vector<Footprint> footprints_;
};

}  // namespace gnomon::shadows::internal
