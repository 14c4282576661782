// SPDX-License-Identifier: MIT
//
// IndexArena: one place for the indices of all volumes. Memory comes in large buffers ("chunks"); a
// volume gets a run of one of them, first fit, and gives it back when its indices change. A write
// is queue-ordered, so a run may be given out again while the GPU still draws what was there.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include <gnomon/gpu/device.hpp>

namespace gnomon::shadow_pass::internal {

struct IndexRun {
    std::uint32_t chunk = 0;
    std::uint32_t first = 0;  ///< in indices
    std::uint32_t count = 0;
};

class IndexArena {
public:
    explicit IndexArena(gpu::Device& device) : device_(&device) {}

    /// Finds room, uploads, and says where. No indices need no room: a run of none, in no buffer.
    Result<IndexRun> upload(std::span<const std::uint32_t> indices);
    void free(const IndexRun& run);

    [[nodiscard]] gpu::BufferId buffer(std::uint32_t chunk) const {
        return chunks_[chunk].buffer.id();
    }
    [[nodiscard]] std::uint64_t indices_in_use() const { return in_use_; }

private:
    struct Chunk {
        gpu::Buffer buffer;
        std::map<std::uint32_t, std::uint32_t> free_runs;  // first -> count; never adjacent
    };

    Status add_chunk(std::uint32_t at_least);
    bool find_room(std::uint32_t count, IndexRun& run);

    gpu::Device* device_;
    std::vector<Chunk> chunks_;
    std::uint64_t in_use_ = 0;
};

}  // namespace gnomon::shadow_pass::internal
