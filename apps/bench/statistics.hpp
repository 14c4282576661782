// SPDX-License-Identifier: MIT
//
// Order statistics: what can be said of timings without assuming how they are distributed.
#pragma once

#include <span>

namespace gnomon::bench {

/// All of no values at all are not a number.
struct Spread {
    double median = 0.0;
    double lower_quartile = 0.0;
    double upper_quartile = 0.0;
    /// Holds the median of what the values were drawn from in at least 95 of 100 cases, by the
    /// binomial distribution of ranks; the extremes where there are fewer than six values.
    double low = 0.0;
    double high = 0.0;
};

/// Quartiles are interpolated between ranks. Cost: a sort.
[[nodiscard]] Spread spread_of(std::span<const double> values);

}  // namespace gnomon::bench
