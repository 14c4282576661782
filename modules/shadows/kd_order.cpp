// SPDX-License-Identifier: MIT
#include "internal/kd_order.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace gnomon::shadows::internal {

namespace {

constexpr std::size_t smallest_block = 16;

std::size_t widest_side(std::span<const KdItem> items) {
    std::array<float, 4> low;
    std::array<float, 4> high;
    low.fill(std::numeric_limits<float>::max());
    high.fill(std::numeric_limits<float>::lowest());
    for (const KdItem& item : items) {
        for (std::size_t d = 0; d < 4; ++d) {
            low[d] = std::min(low[d], item.key[d]);
            high[d] = std::max(high[d], item.key[d]);
        }
    }
    std::size_t widest = 0;
    for (std::size_t d = 1; d < 4; ++d) {
        if (high[d] - low[d] > high[widest] - low[widest]) widest = d;
    }
    return widest;
}

}  // namespace

void kd_order(std::span<KdItem> items) {
    while (items.size() > smallest_block) {
        const std::size_t side = widest_side(items);
        // Blocks of 16 * 2^k on the left, so that they stay aligned all the way down.
        const std::size_t middle = std::max(smallest_block, std::bit_ceil(items.size()) / 2);
        const auto cut = static_cast<std::ptrdiff_t>(middle);
        std::nth_element(items.begin(), items.begin() + cut, items.end(),
                         [side](const KdItem& a, const KdItem& b) {
                             if (a.key[side] != b.key[side]) return a.key[side] < b.key[side];
                             return a.id < b.id;
                         });
        kd_order(items.first(middle));
        items = items.subspan(middle);
    }
}

}  // namespace gnomon::shadows::internal
