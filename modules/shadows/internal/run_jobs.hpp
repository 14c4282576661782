// SPDX-License-Identifier: MIT
//
// Tasks by the host's runner where there is one, else one after the other.
#pragma once

#include <algorithm>
#include <cstddef>

#include <gnomon/shadows/jobs.hpp>

namespace gnomon::shadows::internal {

template <class Task>
void run_jobs(const Jobs& jobs, std::size_t count, const Task& task) {
    if (jobs && count > 1) {
        jobs(count, task);
        return;
    }
    for (std::size_t i = 0; i < count; ++i) task(i);
}

/// task(begin, end) for pieces of [0, count), of which none is so small that handing it out costs
/// more than doing it.
template <class Task>
void run_pieces(const Jobs& jobs, std::size_t count, const Task& task) {
    constexpr std::size_t piece = 1U << 16U;
    run_jobs(jobs, (count + piece - 1) / piece,
             [&](std::size_t i) { task(i * piece, std::min(count, (i + 1) * piece)); });
}

}  // namespace gnomon::shadows::internal
