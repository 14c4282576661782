// SPDX-License-Identifier: MIT
#include "internal/index_arena.hpp"

#include <algorithm>
#include <string>

namespace gnomon::shadow_pass::internal {

namespace {
constexpr std::uint32_t chunk_indices =
    1U << 20U;  // 4 MiB: a few hundred thousand triangles' worth of silhouettes
}

Result<IndexRun> IndexArena::upload(std::span<const std::uint32_t> indices) {
    const std::uint64_t limit = device_->caps().limits.max_buffer_size / sizeof(std::uint32_t);
    if (indices.size() > limit) {
        return fail(ErrorCode::OutOfMemory, "A shadow volume has " +
                                                std::to_string(indices.size()) +
                                                " indices; the adapter's largest buffer holds " +
                                                std::to_string(limit) + ".");
    }
    const auto count = static_cast<std::uint32_t>(indices.size());
    IndexRun run;
    if (count == 0) return run;
    if (!find_room(count, run)) {
        if (const Status added = add_chunk(count); !added) return forward_error(added);
        find_room(count, run);
    }
    const Status written = device_->write_buffer(
        chunks_[run.chunk].buffer, std::uint64_t{run.first} * 4, std::as_bytes(indices));
    if (!written) {
        free(run);
        return forward_error(written);
    }
    return run;
}

void IndexArena::free(const IndexRun& run) {
    if (run.count == 0) return;
    auto& runs = chunks_[run.chunk].free_runs;
    in_use_ -= run.count;
    std::uint32_t first = run.first;
    std::uint32_t count = run.count;
    auto next = runs.lower_bound(first);
    if (next != runs.end() && first + count == next->first) {
        count += next->second;
        next = runs.erase(next);
    }
    if (next != runs.begin()) {
        const auto previous = std::prev(next);
        if (previous->first + previous->second == first) {
            previous->second += count;
            return;
        }
    }
    runs.emplace(first, count);
}

bool IndexArena::find_room(std::uint32_t count, IndexRun& run) {
    for (std::uint32_t c = 0; c < chunks_.size(); ++c) {
        auto& runs = chunks_[c].free_runs;
        const auto fit = std::find_if(runs.begin(), runs.end(),
                                      [&](const auto& r) { return r.second >= count; });
        if (fit == runs.end()) continue;
        run = {c, fit->first, count};
        const std::uint32_t left = fit->second - count;
        runs.erase(fit);
        if (left > 0) runs.emplace(run.first + count, left);
        in_use_ += count;
        return true;
    }
    return false;
}

Status IndexArena::add_chunk(std::uint32_t at_least) {
    const std::uint32_t size = std::max(chunk_indices, at_least);
    auto buffer = device_->create_buffer(
        {.label = "shadow volume indices",
         .size = std::uint64_t{size} * sizeof(std::uint32_t),
         .usage = gpu::BufferUsage::Index | gpu::BufferUsage::CopyDst | gpu::BufferUsage::CopySrc});
    if (!buffer) return forward_error(buffer);
    chunks_.push_back({std::move(*buffer), {{0U, size}}});
    return {};
}

}  // namespace gnomon::shadow_pass::internal
