// SPDX-License-Identifier: MIT
//
// Chunks of the staging belt and the read-back buffer.
#include "internal/staging.hpp"

#include <algorithm>

#include "internal/error.hpp"

namespace gnomon::vk {

namespace {

constexpr std::uint64_t chunk_size = 1ULL << 20;
constexpr std::uint64_t full_at = 64ULL << 20;
constexpr std::uint64_t idle_bytes_kept = 16ULL << 20;

}  // namespace

Result<MappedBuffer> make_mapped_buffer(Device& device, Memory& memory, std::uint64_t size,
                                        MemoryKind kind, const char* name) {
    MappedBuffer buffer;
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = size;
    info.usage = kind == MemoryKind::Upload ? VK_BUFFER_USAGE_TRANSFER_SRC_BIT
                                            : VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    if (const VkResult result =
            device.fn.CreateBuffer(device.handle, &info, nullptr, &buffer.handle);
        result != VK_SUCCESS) {
        return failure(result, "vkCreateBuffer", name);
    }
    VkMemoryRequirements requirements{};
    device.fn.GetBufferMemoryRequirements(device.handle, buffer.handle, &requirements);
    const Result<Allocation> allocation = memory.allocate(requirements, kind, name);
    if (!allocation) {
        device.fn.DestroyBuffer(device.handle, buffer.handle, nullptr);
        return forward_error(allocation);
    }
    buffer.memory = *allocation;
    buffer.size = size;
    if (const VkResult result = device.fn.BindBufferMemory(
            device.handle, buffer.handle, buffer.memory.memory, buffer.memory.offset);
        result != VK_SUCCESS) {
        free_mapped_buffer(device, memory, buffer);
        return failure(result, "vkBindBufferMemory", name);
    }
    device.set_name(VK_OBJECT_TYPE_BUFFER, buffer.handle, name);
    return buffer;
}

void free_mapped_buffer(Device& device, Memory& memory, MappedBuffer& buffer) {
    device.fn.DestroyBuffer(device.handle, buffer.handle, nullptr);
    memory.free(buffer.memory);
    buffer = {};
}

StagingBelt::~StagingBelt() {
    for (Chunk& chunk : chunks_) {
        free_mapped_buffer(device_, memory_, chunk.buffer);
    }
}

Result<StagingBelt::Slice> StagingBelt::allocate(std::uint64_t size, std::uint64_t alignment) {
    const auto take = [&](Chunk& chunk, std::uint64_t offset) {
        chunk.used = offset + size;
        chunk.serial = queue_.recording_serial();
        return Slice{chunk.buffer.handle, offset, chunk.buffer.memory.mapped + offset};
    };
    recycle();
    for (Chunk& chunk : chunks_) {
        const std::uint64_t offset = (chunk.used + alignment - 1) & ~(alignment - 1);
        if (offset + size <= chunk.buffer.size) {
            return take(chunk, offset);
        }
    }
    const Result<MappedBuffer> buffer =
        make_mapped_buffer(device_, memory_, std::max(size, chunk_size), MemoryKind::Upload,
                           "the staging buffer of uploads");
    if (!buffer) {
        return forward_error(buffer);
    }
    chunks_.push_back({*buffer, 0, 0});
    return take(chunks_.back(), 0);
}

void StagingBelt::recycle() {
    std::uint64_t idle = 0;
    std::erase_if(chunks_, [&](Chunk& chunk) {
        if (chunk.serial > queue_.completed_serial()) {
            return false;
        }
        chunk.used = 0;
        idle += chunk.buffer.size;
        if (idle <= idle_bytes_kept) {
            return false;
        }
        free_mapped_buffer(device_, memory_, chunk.buffer);
        return true;
    });
}

bool StagingBelt::is_full() const {
    std::uint64_t waiting = 0;
    for (const Chunk& chunk : chunks_) {
        waiting += chunk.serial == queue_.recording_serial() ? chunk.used : 0;
    }
    return waiting >= full_at;
}

ReadbackBuffer::~ReadbackBuffer() { free_mapped_buffer(device_, memory_, buffer_); }

Result<MappedBuffer> ReadbackBuffer::reserve(std::uint64_t size) {
    if (buffer_.size < size) {
        free_mapped_buffer(device_, memory_, buffer_);
        const Result<MappedBuffer> buffer = make_mapped_buffer(
            device_, memory_, size, MemoryKind::Readback, "the buffer of read-backs");
        if (!buffer) {
            return forward_error(buffer);
        }
        buffer_ = *buffer;
    }
    return buffer_;
}

}  // namespace gnomon::vk
