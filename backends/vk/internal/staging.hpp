// SPDX-License-Identifier: MIT
//
// Host-visible buffers between the host and the device: a belt of chunks for uploads, which a
// submission returns when it is done, and one buffer, as large as was ever needed, for read-backs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "internal/memory.hpp"
#include "internal/queue.hpp"

namespace gnomon::vk {

struct MappedBuffer {
    VkBuffer handle = VK_NULL_HANDLE;
    Allocation memory;
    std::uint64_t size = 0;
};

[[nodiscard]] Result<MappedBuffer> make_mapped_buffer(Device& device, Memory& memory,
                                                      std::uint64_t size, MemoryKind kind,
                                                      const char* name);
void free_mapped_buffer(Device& device, Memory& memory, MappedBuffer& buffer);

class StagingBelt {
public:
    StagingBelt(Device& device, Memory& memory, Queue& queue)
        : device_(device), memory_(memory), queue_(queue) {}
    ~StagingBelt();
    StagingBelt(const StagingBelt&) = delete;
    StagingBelt& operator=(const StagingBelt&) = delete;

    struct Slice {
        VkBuffer buffer = VK_NULL_HANDLE;
        std::uint64_t offset = 0;
        std::byte* mapped = nullptr;
    };
    /// Memory that belongs to the submission being recorded. `size` is at least 1.
    [[nodiscard]] Result<Slice> allocate(std::uint64_t size, std::uint64_t alignment);

    /// True when so much waits for a submission that one should be made now.
    [[nodiscard]] bool is_full() const;

private:
    struct Chunk {
        MappedBuffer buffer;
        std::uint64_t used = 0;
        std::uint64_t serial = 0;  // of the last submission that reads from it
    };

    void recycle();

    Device& device_;
    Memory& memory_;
    Queue& queue_;
    std::vector<Chunk> chunks_;
};

class ReadbackBuffer {
public:
    ReadbackBuffer(Device& device, Memory& memory) : device_(device), memory_(memory) {}
    ~ReadbackBuffer();
    ReadbackBuffer(const ReadbackBuffer&) = delete;
    ReadbackBuffer& operator=(const ReadbackBuffer&) = delete;

    /// The buffer, at least `size` bytes large. Only while the device is idle: read-backs block.
    [[nodiscard]] Result<MappedBuffer> reserve(std::uint64_t size);

private:
    Device& device_;
    Memory& memory_;
    MappedBuffer buffer_;
};

}  // namespace gnomon::vk
