// SPDX-License-Identifier: MIT
//
// BufferArena: one place for what many draws read: the indices of all volumes, or the vertices of
// all meshes. Memory comes in large buffers ("chunks"), so that draws seldom change the buffer;
// whoever uploads gets a run of one of them, first fit, and gives it back. A write is
// queue-ordered, so a run may be given out again while the GPU still draws what was there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <gnomon/gpu/device.hpp>

namespace gnomon::shadow_pass::internal {

struct ArenaRun {
    std::uint32_t chunk = 0;
    std::uint32_t first = 0;  ///< in elements
    std::uint32_t count = 0;
};

struct ArenaDesc {
    std::string label;  ///< of its buffers
    /// What a run is and what it is made of: "A shadow volume", "indices".
    std::string owner;
    std::string elements;
    gpu::BufferUsage usage = gpu::BufferUsage::Index;
    std::uint32_t element_bytes = 4;  ///< a multiple of 4
    std::uint32_t chunk_elements = 1U << 20U;
};

class BufferArena {
public:
    BufferArena(gpu::Device& device, ArenaDesc desc) : device_(&device), desc_(std::move(desc)) {}

    /// Finds room and says where; flush() writes it. No elements need no room: a run of none, in no
    /// buffer.
    Result<ArenaRun> upload(std::span<const std::byte> elements);
    /// Writes all that came since the last one, neighbours in one piece. Where it fails nobody
    /// knows what is where: clear().
    Status flush();
    void free(const ArenaRun& run);
    /// Everything is free, nothing waits to be written. Keeps the memory.
    void clear();

    [[nodiscard]] gpu::BufferId buffer(std::uint32_t chunk) const {
        return chunks_[chunk].buffer.id();
    }
    [[nodiscard]] std::uint64_t elements_in_use() const { return in_use_; }

private:
    struct Chunk {
        gpu::Buffer buffer;
        std::uint32_t size = 0;
        std::map<std::uint32_t, std::uint32_t> free_runs;  // first -> count; never adjacent
    };

    Status add_chunk(std::uint32_t at_least);
    bool find_room(std::uint32_t count, ArenaRun& run);
    bool find_room_from(std::uint32_t chunk, std::uint32_t first, std::uint32_t count,
                        ArenaRun& run);

    gpu::Device* device_;
    ArenaDesc desc_;
    std::vector<Chunk> chunks_;
    std::uint64_t in_use_ = 0;
    // Where the next run is looked for first: behind the last one since flush(), so that many come
    // to lie side by side, and none looks through the same small holes again.
    ArenaRun rover_;
    std::vector<ArenaRun> waiting_;  // to be written; neighbours joined
    std::vector<std::byte> staged_;  // in the order of waiting_
};

}  // namespace gnomon::shadow_pass::internal
