// SPDX-License-Identifier: MIT
//
// Buffers: device-local memory, filled through the staging belt, zero until written.
#pragma once

#include <string>

#include <gnomon/gpu/descriptors.hpp>

#include "internal/memory.hpp"
#include "internal/sync.hpp"

namespace gnomon::vk {

struct Buffer {
    std::string subject;  ///< "buffer 'indices'", for errors
    VkBuffer handle = VK_NULL_HANDLE;
    Allocation memory;
    std::uint64_t size = 0;
    Tracker tracker;
    /// Of the host's command buffer in which what reads it was recorded last (VulkanBackend).
    std::uint64_t read_by_host = 0;
    bool zeroed = false;  ///< contents are defined: zero or written
    // What copies have written since the last barrier: copies into disjoint ranges need no barrier
    // between them. Empty when begin == end.
    std::uint64_t copied_begin = 0;
    std::uint64_t copied_end = 0;
};

[[nodiscard]] Result<Buffer> make_buffer(Device& device, Memory& memory,
                                         const gpu::BufferDesc& desc);
void free_buffer(Device& device, Memory& memory, Buffer& buffer);

/// Gathers the barrier before a use that reads. The buffer must have defined contents.
void use_buffer(Buffer& buffer, Usage usage, BarrierBatch& barriers);
/// Records the barrier before a copy into the range.
void use_as_copy_destination(Device& device, VkCommandBuffer commands, Buffer& buffer,
                             std::uint64_t offset, std::uint64_t size);
/// Records the fill that makes contents zero where nothing was written yet.
void define_contents(Device& device, VkCommandBuffer commands, Buffer& buffer);

}  // namespace gnomon::vk
