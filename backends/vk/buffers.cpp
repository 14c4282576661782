// SPDX-License-Identifier: MIT
//
// Makes, frees and prepares buffers.
#include "internal/buffers.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "internal/device.hpp"
#include "internal/error.hpp"

namespace gnomon::vk {

namespace {

VkBufferUsageFlags usage_flags(gpu::BufferUsage usage) {
    // Every buffer starts as zero, which a transfer sees to.
    VkBufferUsageFlags flags = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const auto add = [&](gpu::BufferUsage bit, VkBufferUsageFlags flag) {
        flags |= gpu::has(usage, bit) ? flag : 0U;
    };
    add(gpu::BufferUsage::CopySrc, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    add(gpu::BufferUsage::Index, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    add(gpu::BufferUsage::Vertex, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    add(gpu::BufferUsage::Uniform, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    return flags;
}

}  // namespace

Result<Buffer> make_buffer(Device& device, Memory& memory, const gpu::BufferDesc& desc) {
    Buffer buffer;
    buffer.subject = fmt::format("buffer '{}'", desc.label);
    buffer.size = desc.size;
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = desc.size;
    info.usage = usage_flags(desc.usage);
    if (const VkResult result =
            device.fn.CreateBuffer(device.handle, &info, nullptr, &buffer.handle);
        result != VK_SUCCESS) {
        return failure(result, "vkCreateBuffer", buffer.subject);
    }
    VkMemoryRequirements requirements{};
    device.fn.GetBufferMemoryRequirements(device.handle, buffer.handle, &requirements);
    const Result<Allocation> allocation =
        memory.allocate(requirements, MemoryKind::Buffer, buffer.subject);
    if (!allocation) {
        free_buffer(device, memory, buffer);
        return forward_error(allocation);
    }
    buffer.memory = *allocation;
    if (const VkResult result = device.fn.BindBufferMemory(device.handle, buffer.handle,
                                                           allocation->memory, allocation->offset);
        result != VK_SUCCESS) {
        free_buffer(device, memory, buffer);
        return failure(result, "vkBindBufferMemory", buffer.subject);
    }
    device.set_name(VK_OBJECT_TYPE_BUFFER, buffer.handle, desc.label);
    return buffer;
}

void free_buffer(Device& device, Memory& memory, Buffer& buffer) {
    device.fn.DestroyBuffer(device.handle, buffer.handle, nullptr);
    memory.free(buffer.memory);
}

void use_buffer(Buffer& buffer, Usage usage, BarrierBatch& barriers) {
    Dependency dependency;
    if (buffer.tracker.use_buffer(usage, dependency)) {
        barriers.add_memory(dependency);
    }
    buffer.copied_begin = buffer.copied_end = 0;
}

void use_as_copy_destination(Device& device, VkCommandBuffer commands, Buffer& buffer,
                             std::uint64_t offset, std::uint64_t size) {
    const std::uint64_t end = offset + size;
    const bool copied_before = buffer.copied_begin != buffer.copied_end;
    if (copied_before && (end <= buffer.copied_begin || buffer.copied_end <= offset)) {
        buffer.copied_begin = std::min(buffer.copied_begin, offset);
        buffer.copied_end = std::max(buffer.copied_end, end);
        return;
    }
    Dependency dependency;
    if (buffer.tracker.use_buffer(Usage::CopyDestination, dependency)) {
        BarrierBatch barriers;
        barriers.add_memory(dependency);
        barriers.flush(device.fn, commands);
    }
    buffer.copied_begin = offset;
    buffer.copied_end = end;
}

void define_contents(Device& device, VkCommandBuffer commands, Buffer& buffer) {
    if (buffer.zeroed) {
        return;
    }
    use_as_copy_destination(device, commands, buffer, 0, buffer.size);
    device.fn.CmdFillBuffer(commands, buffer.handle, 0, VK_WHOLE_SIZE, 0);
    buffer.zeroed = true;
}

}  // namespace gnomon::vk
