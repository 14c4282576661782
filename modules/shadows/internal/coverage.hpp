// SPDX-License-Identifier: MIT
//
// Coverage: which part of a line intervals cover. Of few numbers: where the intervals are many,
// neighbours are taken for one, so that less is found open than is.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace gnomon::shadows::internal {

struct Interval {
    double low = 0.0;
    double high = 0.0;
    bool operator==(const Interval&) const = default;
};

class Coverage {
public:
    /// Infinite ends are fine. Cost: some dozen flops.
    void add(const Interval& interval);
    [[nodiscard]] bool holds(const Interval& interval) const;
    /// Disjoint and ascending.
    [[nodiscard]] std::span<const Interval> covered() const {
        return std::span(covered_).first(count_);
    }

private:
    void join(std::size_t first, std::size_t last);

    static constexpr std::size_t most = 8;
    std::array<Interval, most + 1> covered_{};
    std::size_t count_ = 0;
};

}  // namespace gnomon::shadows::internal
