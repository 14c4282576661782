// SPDX-License-Identifier: MIT
#include "internal/buffer_arena.hpp"

#include <algorithm>
#include <string>

namespace gnomon::shadow_pass::internal {

Result<ArenaRun> BufferArena::upload(std::span<const std::byte> elements) {
    const std::uint64_t limit = device_->caps().limits.max_buffer_size / desc_.element_bytes;
    const std::uint64_t wanted = elements.size() / desc_.element_bytes;
    if (wanted > limit) {
        return fail(ErrorCode::OutOfMemory,
                    desc_.owner + " has " + std::to_string(wanted) + " " + desc_.elements +
                        "; the adapter's largest buffer holds " + std::to_string(limit) + ".");
    }
    const auto count = static_cast<std::uint32_t>(wanted);
    ArenaRun run;
    if (count == 0) return run;
    if (!find_room(count, run)) {
        if (const Status added = add_chunk(count); !added) return forward_error(added);
        find_room(count, run);
    }
    rover_ = {run.chunk, run.first + count, 0};
    staged_.insert(staged_.end(), elements.begin(), elements.end());
    const bool goes_on = !waiting_.empty() && waiting_.back().chunk == run.chunk &&
                         waiting_.back().first + waiting_.back().count == run.first;
    if (goes_on) {
        waiting_.back().count += count;
    } else {
        waiting_.push_back(run);
    }
    return run;
}

Status BufferArena::flush() {
    std::span<const std::byte> rest = staged_;
    Status status;
    for (const ArenaRun& run : waiting_) {
        const std::size_t bytes = std::size_t{run.count} * desc_.element_bytes;
        status = device_->write_buffer(chunks_[run.chunk].buffer,
                                       std::uint64_t{run.first} * desc_.element_bytes,
                                       rest.first(bytes));
        if (!status) break;
        rest = rest.subspan(bytes);
    }
    waiting_.clear();
    staged_.clear();
    // What a first upload took is not kept for what frames upload.
    if (staged_.capacity() > std::size_t{desc_.chunk_elements} * desc_.element_bytes) {
        staged_.shrink_to_fit();
    }
    rover_ = {};
    return status;
}

void BufferArena::free(const ArenaRun& run) {
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
    runs.emplace_hint(next, first, count);
}

void BufferArena::clear() {
    for (Chunk& chunk : chunks_) chunk.free_runs = {{0U, chunk.size}};
    waiting_.clear();
    staged_.clear();
    rover_ = {};
    in_use_ = 0;
}

bool BufferArena::find_room(std::uint32_t count, ArenaRun& run) {
    const auto chunk_count = static_cast<std::uint32_t>(chunks_.size());
    for (std::uint32_t c = rover_.chunk; c < chunk_count; ++c) {
        if (find_room_from(c, c == rover_.chunk ? rover_.first : 0, count, run)) return true;
    }
    for (std::uint32_t c = 0; c < chunk_count && c <= rover_.chunk; ++c) {
        if (find_room_from(c, 0, count, run)) return true;
    }
    return false;
}

bool BufferArena::find_room_from(std::uint32_t chunk, std::uint32_t first, std::uint32_t count,
                                 ArenaRun& run) {
    auto& runs = chunks_[chunk].free_runs;
    const auto fit = std::find_if(runs.lower_bound(first), runs.end(),
                                  [&](const auto& r) { return r.second >= count; });
    if (fit == runs.end()) return false;
    run = {chunk, fit->first, count};
    const std::uint32_t left = fit->second - count;
    const auto behind = runs.erase(fit);
    if (left > 0) runs.emplace_hint(behind, run.first + count, left);
    in_use_ += count;
    return true;
}

Status BufferArena::add_chunk(std::uint32_t at_least) {
    const std::uint32_t size = std::max(desc_.chunk_elements, at_least);
    auto buffer = device_->create_buffer(
        {.label = desc_.label,
         .size = std::uint64_t{size} * desc_.element_bytes,
         .usage = desc_.usage | gpu::BufferUsage::CopyDst | gpu::BufferUsage::CopySrc});
    if (!buffer) return forward_error(buffer);
    chunks_.push_back({std::move(*buffer), size, {{0U, size}}});
    return {};
}

}  // namespace gnomon::shadow_pass::internal
