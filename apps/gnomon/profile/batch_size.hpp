// SPDX-License-Identifier: MIT
//
// BatchSize: how many masks are drawn before they are written. What is drawn and not written is
// lost where a run is cut off, so that a batch takes some two seconds; but no fewer are drawn than
// keep what draws busy.
#pragma once

#include <algorithm>
#include <cstddef>

namespace gnomon::cli {

class BatchSize {
public:
    /// `least` at a time: as many as are drawn side by side.
    explicit BatchSize(std::size_t least = 1) : least_(least) {}

    /// A multiple of `least`, 64 or less but for that. Before anything was measured, that.
    [[nodiscard]] std::size_t next() const {
        const double fit = seconds_a_mask_ > 0.0 ? seconds / seconds_a_mask_ : 0.0;
        const auto whole = static_cast<std::size_t>(std::min(fit, static_cast<double>(most)));
        return std::max(whole / least_ * least_, least_);
    }

    /// So long the last batch took. One of fewer than `least` says nothing.
    void took(std::size_t masks, double batch_seconds) {
        if (masks >= least_)
            seconds_a_mask_ = std::max(batch_seconds, 1e-9) / static_cast<double>(masks);
    }

private:
    static constexpr double seconds = 2.0;
    static constexpr std::size_t most = 64;
    std::size_t least_;
    double seconds_a_mask_ = 0.0;
};

}  // namespace gnomon::cli
