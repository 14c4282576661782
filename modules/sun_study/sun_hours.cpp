// SPDX-License-Identifier: MIT
#include <gnomon/sun_study/sun_hours.hpp>

#include <algorithm>
#include <cmath>

#include <gnomon/core/expects.hpp>

namespace gnomon::sun_study {

void SunHours::add(std::span<const std::uint8_t> lit, const Step& step) {
    GNOMON_EXPECTS(lit.size() == half_seconds_.size());
    if (!step.counts) return;
    for (std::size_t i = 0; i < lit.size(); ++i) {
        if (lit[i] != 0) half_seconds_[i] += step.half_seconds;
    }
}

HoursSummary summarise(const SunHours& hours, std::span<const std::uint8_t> open) {
    const auto sums = hours.half_seconds();
    GNOMON_EXPECTS(open.size() == sums.size());
    HoursSummary summary;
    std::uint64_t sum = 0;
    std::uint32_t least = 0;
    std::uint32_t most = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        if (open[i] == 0) continue;
        least = summary.open_cells == 0 ? sums[i] : std::min(least, sums[i]);
        most = std::max(most, sums[i]);
        sum += sums[i];
        ++summary.open_cells;
    }
    if (summary.open_cells == 0) return summary;
    summary.min_h = least / half_seconds_an_hour;
    summary.max_h = most / half_seconds_an_hour;
    summary.mean_h =
        static_cast<double>(sum) / static_cast<double>(summary.open_cells) / half_seconds_an_hour;
    return summary;
}

double share_with(const SunHours& hours, std::span<const std::uint8_t> open, double at_least_h) {
    const auto sums = hours.half_seconds();
    GNOMON_EXPECTS(open.size() == sums.size());
    const auto needed = static_cast<std::uint64_t>(std::llround(at_least_h * half_seconds_an_hour));
    std::size_t cells = 0;
    std::size_t enough = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        if (open[i] == 0) continue;
        ++cells;
        enough += sums[i] >= needed ? 1 : 0;
    }
    return cells == 0 ? 0.0 : static_cast<double>(enough) / static_cast<double>(cells);
}

}  // namespace gnomon::sun_study
