// SPDX-License-Identifier: MIT
#include "internal/deadlines.hpp"

#include <array>

namespace gnomon::shadows::internal {

double Deadlines::least(std::span<const double> values) {
    // Four at a time, so that no comparison waits for the one before.
    std::array<double, 4> least;
    least.fill(std::numeric_limits<double>::infinity());
    std::size_t i = 0;
    for (; i + 4 <= values.size(); i += 4) {
        for (std::size_t k = 0; k < 4; ++k) {
            least[k] = values[i + k] < least[k] ? values[i + k] : least[k];
        }
    }
    for (; i < values.size(); ++i) least[0] = values[i] < least[0] ? values[i] : least[0];
    const double a = least[0] < least[1] ? least[0] : least[1];
    const double b = least[2] < least[3] ? least[2] : least[3];
    return a < b ? a : b;
}

void Deadlines::resize(std::size_t count) {
    levels_.resize(1);
    levels_[0].assign(count, 0.0);
    while (levels_.back().size() > fan) {
        levels_.emplace_back((levels_.back().size() + fan - 1) / fan, 0.0);
    }
    rebuild();
}

void Deadlines::rebuild() {
    for (std::size_t level = 1; level < levels_.size(); ++level) {
        for (std::size_t node = 0; node < levels_[level].size(); ++node) {
            levels_[level][node] = least(children(level - 1, node));
        }
    }
    next_ = least(levels_.back());
}

void Deadlines::renew(std::span<const std::uint32_t> things) {
    std::size_t size = fan;
    for (std::size_t level = 1; level < levels_.size(); ++level, size *= fan) {
        std::size_t last = levels_[level].size();
        for (const std::uint32_t thing : things) {
            const std::size_t node = thing / size;
            if (node == last) continue;
            levels_[level][node] = least(children(level - 1, node));
            last = node;
        }
    }
    next_ = least(levels_.back());
}

std::size_t Deadlines::memory_bytes() const {
    std::size_t bytes = 0;
    for (const auto& level : levels_) bytes += level.capacity() * sizeof(double);
    return bytes;
}

}  // namespace gnomon::shadows::internal
