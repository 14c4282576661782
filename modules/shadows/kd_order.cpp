// SPDX-License-Identifier: MIT
#include "internal/kd_order.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>

#include "internal/run_jobs.hpp"

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

// Brings the items of the left child to the front and returns how many they are.
std::size_t split(std::span<KdItem> items) {
    const std::size_t side = widest_side(items);
    // Blocks of 16 * 2^k on the left, so that they stay aligned all the way down.
    const std::size_t middle = std::max(smallest_block, std::bit_ceil(items.size()) / 2);
    std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(middle),
                     items.end(), [side](const KdItem& a, const KdItem& b) {
                         if (a.key[side] != b.key[side]) return a.key[side] < b.key[side];
                         return a.id < b.id;
                     });
    return middle;
}

}  // namespace

void kd_order(std::span<KdItem> items) {
    while (items.size() > smallest_block) {
        const std::size_t middle = split(items);
        kd_order(items.first(middle));
        items = items.subspan(middle);
    }
}

void kd_order(std::vector<std::span<KdItem>> lists, const Jobs& jobs) {
    // Of lists that are not alike in length, several threads have about as much each after that.
    constexpr int rounds = 3;
    constexpr std::size_t worth_a_task = 1U << 14U;
    for (int round = 0; jobs && round < rounds; ++round) {
        std::vector<std::size_t> middles(lists.size());
        run_jobs(jobs, lists.size(), [&](std::size_t i) {
            if (lists[i].size() > worth_a_task) middles[i] = split(lists[i]);
        });
        for (std::size_t i = middles.size(); i-- > 0;) {
            if (middles[i] == 0) continue;
            lists.push_back(lists[i].subspan(middles[i]));
            lists[i] = lists[i].first(middles[i]);
        }
    }
    // Those that take longest first.
    std::ranges::sort(lists, std::greater<>(), [](const auto& list) { return list.size(); });
    run_jobs(jobs, lists.size(), [&](std::size_t i) { kd_order(lists[i]); });
}

}  // namespace gnomon::shadows::internal
