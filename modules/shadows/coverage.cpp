// SPDX-License-Identifier: MIT
#include "internal/coverage.hpp"

#include <algorithm>

namespace gnomon::shadows::internal {

void Coverage::add(const Interval& interval) {
    std::size_t at = 0;
    while (at < count_ && covered_[at].high < interval.low) ++at;
    std::size_t end = at;
    while (end < count_ && covered_[end].low <= interval.high) ++end;
    if (end > at) {
        covered_[at].low = std::min(covered_[at].low, interval.low);
        covered_[end - 1].high = std::max(covered_[end - 1].high, interval.high);
        join(at, end - 1);
        return;
    }
    std::copy_backward(covered_.begin() + static_cast<std::ptrdiff_t>(at),
                       covered_.begin() + static_cast<std::ptrdiff_t>(count_),
                       covered_.begin() + static_cast<std::ptrdiff_t>(count_ + 1));
    covered_[at] = interval;
    ++count_;
    if (count_ <= most) return;
    std::size_t closest = 1;
    for (std::size_t i = 2; i < count_; ++i) {
        const double gap = covered_[i].low - covered_[i - 1].high;
        if (gap < covered_[closest].low - covered_[closest - 1].high) closest = i;
    }
    join(closest - 1, closest);
}

void Coverage::join(std::size_t first, std::size_t last) {
    covered_[first].high = covered_[last].high;
    std::copy(covered_.begin() + static_cast<std::ptrdiff_t>(last + 1),
              covered_.begin() + static_cast<std::ptrdiff_t>(count_),
              covered_.begin() + static_cast<std::ptrdiff_t>(first + 1));
    count_ -= last - first;
}

bool Coverage::holds(const Interval& interval) const {
    return std::ranges::any_of(covered(), [&](const Interval& c) {
        return c.low <= interval.low && interval.high <= c.high;
    });
}

}  // namespace gnomon::shadows::internal
