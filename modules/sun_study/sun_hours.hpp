// SPDX-License-Identifier: MIT
//
// SunHours: how long the sun reaches each cell of a grid, summed over the steps of a day. The sums
// are whole numbers of half seconds: exact, and the same in whatever order steps are added.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <gnomon/sun_study/steps.hpp>

namespace gnomon::sun_study {

class SunHours {
public:
    explicit SunHours(std::size_t cells) : half_seconds_(cells, 0) {}

    /// `lit`: one byte a cell, 0 in shadow.
    void add(std::span<const std::uint8_t> lit, const Step& step);

    [[nodiscard]] double hours(std::size_t cell) const {
        return half_seconds_[cell] / half_seconds_an_hour;
    }
    [[nodiscard]] std::span<const std::uint32_t> half_seconds() const { return half_seconds_; }

private:
    std::vector<std::uint32_t> half_seconds_;
};

/// Over the cells that are open: those that nothing lies above.
struct HoursSummary {
    std::size_t open_cells = 0;
    double min_h = 0.0;
    double mean_h = 0.0;
    double max_h = 0.0;
};

/// `open`: one byte a cell, 0 where something lies above. All zeros where no cell is open.
[[nodiscard]] HoursSummary summarise(const SunHours& hours, std::span<const std::uint8_t> open);

/// The share of the open cells that have at least so many hours; 0 where none is open.
[[nodiscard]] double share_with(const SunHours& hours, std::span<const std::uint8_t> open,
                                double at_least_h);

}  // namespace gnomon::sun_study
