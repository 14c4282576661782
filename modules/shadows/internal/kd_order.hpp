// SPDX-License-Identifier: MIT
//
// An order in which neighbours in a four-dimensional space are neighbours in memory: that of the
// leaves of a k-d tree (J. L. Bentley, "Multidimensional Binary Search Trees Used for Associative
// Searching", 1975) which is split in the middle of its widest side.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <gnomon/shadows/jobs.hpp>

namespace gnomon::shadows::internal {

struct KdItem {
    std::array<float, 4> key{};  ///< finite
    std::uint32_t id = 0;        ///< unique; decides between equal keys
};

/// Sorts in place. Whatever lies in blocks of 16 items from the start, and in blocks of 16 * 2^k,
/// is close together. Deterministic. Cost: O(n log n), some 60 ns an item for a million.
void kd_order(std::span<KdItem> items);
/// Sorts each of the lists, with the same result whoever runs the tasks.
void kd_order(std::vector<std::span<KdItem>> lists, const Jobs& jobs);

}  // namespace gnomon::shadows::internal
