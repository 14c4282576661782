// SPDX-License-Identifier: MIT
//
// Jobs: how a host lends its threads. A function that runs N independent tasks and returns when all
// are done; the host's own scheduler in a line or two, or thread_jobs() where there is none.
//
//     SystemOptions options{.jobs = [&](std::size_t count, const auto& task) {
//         scheduler.parallel_for(count, task);
//     }};
//
// What is computed never depends on who ran which task, nor on how many threads there are.
#pragma once

#include <cstddef>
#include <functional>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// Runs task(0) … task(count - 1), each once, in any order and on any threads, the caller's
/// included, and returns when all are done; what tasks wrote is visible to the caller then. It is
/// called by one thread of a ShadowSystem or of ShadowMesh::build() at a time, never from within a
/// task, and a task neither blocks nor calls it. Tasks throw nothing but std::bad_alloc; where that
/// cannot pass through a scheduler, the program may as well end. Empty: one after the other, on the
/// calling thread.
using Jobs = std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;

/// A runner on threads of its own, the caller's and `threads` - 1 more, which are started here,
/// sleep between calls, and end when the last copy is gone. 0: as many as the machine runs at a
/// time. Calls from several threads take turns, so that systems may share one. The first exception
/// of a task is thrown to the caller once all are done.
[[nodiscard]] Jobs thread_jobs(unsigned threads = 0);

}  // namespace gnomon::shadows
#pragma GCC visibility pop
