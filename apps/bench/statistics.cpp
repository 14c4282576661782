// SPDX-License-Identifier: MIT
#include "statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace gnomon::bench {

namespace {

// The largest rank r, from 0, of which P(B < r + 1) <= 0.025 for B binomial with n and 1/2: the
// interval from value r to value n - 1 - r holds the median with 95 %. 0 where there is none.
std::size_t rank_of_95_percent(std::size_t n) {
    const auto count = static_cast<double>(n);
    double below = 0.0;
    std::size_t rank = 0;
    for (std::size_t k = 0; 2 * k < n; ++k) {
        const auto i = static_cast<double>(k);
        below += std::exp(std::lgamma(count + 1.0) - std::lgamma(i + 1.0) -
                          std::lgamma(count - i + 1.0) - count * std::log(2.0));
        if (below > 0.025) break;
        rank = k;
    }
    return rank;
}

}  // namespace

Spread spread_of(std::span<const double> values) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (values.empty()) return {nan, nan, nan, nan, nan};
    std::vector<double> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    const auto quantile = [&](double share) {
        const double place = share * static_cast<double>(sorted.size() - 1);
        const auto below = static_cast<std::size_t>(place);
        const std::size_t above = std::min(below + 1, sorted.size() - 1);
        return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
    };
    const std::size_t rank = rank_of_95_percent(sorted.size());
    return {quantile(0.5), quantile(0.25), quantile(0.75), sorted[rank],
            sorted[sorted.size() - 1 - rank]};
}

}  // namespace gnomon::bench
