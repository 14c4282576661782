// SPDX-License-Identifier: MIT
//
// Uploads and read-backs.
#include "internal/transfers.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "internal/conv.hpp"
#include "internal/error.hpp"

namespace gnomon::vk {

namespace {

VkBufferImageCopy whole_level(const Texture& texture, std::uint32_t mip_level,
                              VkImageAspectFlags aspect, std::uint64_t buffer_offset) {
    VkBufferImageCopy region{};
    region.bufferOffset = buffer_offset;
    region.imageSubresource = {aspect, mip_level, 0, 1};
    region.imageExtent = {std::max(texture.width >> mip_level, 1U),
                          std::max(texture.height >> mip_level, 1U), 1};
    return region;
}

/// X8_D24_UNORM_PACK32, as Vulkan copies the depth of D24_UNORM_S8_UINT, to floats.
void convert_depth24(const std::byte* packed, std::span<std::byte> floats) {
    for (std::size_t i = 0; i < floats.size(); i += sizeof(float)) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, packed + i, sizeof bits);
        const float depth = static_cast<float>((bits & 0xFFFFFFU) / 16777215.0);
        std::memcpy(floats.data() + i, &depth, sizeof depth);
    }
}

}  // namespace

Result<StagingBelt::Slice> Transfers::stage(std::span<const std::byte> bytes,
                                            std::uint64_t alignment) {
    const Result<StagingBelt::Slice> slice = belt_.allocate(bytes.size(), alignment);
    if (slice) {
        std::memcpy(slice->mapped, bytes.data(), bytes.size());
    }
    return slice;
}

Status Transfers::submit_if_full() { return belt_.is_full() ? queue_.submit() : Status{}; }

Status Transfers::write(Buffer& buffer, std::uint64_t offset, std::span<const std::byte> bytes) {
    if (bytes.empty()) {
        return {};
    }
    const Result<VkCommandBuffer> commands = queue_.commands();
    if (!commands) {
        return forward_error(commands);
    }
    const Result<StagingBelt::Slice> slice = stage(bytes, 4);
    if (!slice) {
        return forward_error(slice);
    }
    if (bytes.size() == buffer.size) {
        buffer.zeroed = true;
    }
    define_contents(device_, *commands, buffer);
    use_as_copy_destination(device_, *commands, buffer, offset, bytes.size());
    const VkBufferCopy region{slice->offset, offset, bytes.size()};
    device_.fn.CmdCopyBuffer(*commands, slice->buffer, buffer.handle, 1, &region);
    return submit_if_full();
}

Status Transfers::write(Texture& texture, std::uint32_t mip_level,
                        std::span<const std::byte> bytes) {
    const Result<VkCommandBuffer> commands = queue_.commands();
    if (!commands) {
        return forward_error(commands);
    }
    // Copies to images start at multiples of 4 and of the texel; 16 is both for every format.
    const Result<StagingBelt::Slice> slice = stage(bytes, 16);
    if (!slice) {
        return forward_error(slice);
    }
    if (texture.mip_level_count == 1) {
        texture.undefined = 0;
    }
    define_contents(device_, *commands, texture);
    BarrierBatch barriers;
    use_texture(texture, Usage::CopyDestination, barriers);
    barriers.flush(device_.fn, *commands);
    const VkBufferImageCopy region =
        whole_level(texture, mip_level, VK_IMAGE_ASPECT_COLOR_BIT, slice->offset);
    device_.fn.CmdCopyBufferToImage(*commands, slice->buffer, texture.handle,
                                    layout_of(Usage::CopyDestination, texture.aspects), 1, &region);
    return submit_if_full();
}

Status Transfers::finish_reading(VkCommandBuffer commands) {
    Dependency dependency;
    dependency.source_stages = VK_PIPELINE_STAGE_TRANSFER_BIT;
    dependency.source_access = VK_ACCESS_TRANSFER_WRITE_BIT;
    dependency.destination_stages = VK_PIPELINE_STAGE_HOST_BIT;
    dependency.destination_access = VK_ACCESS_HOST_READ_BIT;
    BarrierBatch barriers;
    barriers.add_memory(dependency);
    barriers.flush(device_.fn, commands);
    return queue_.finish();
}

Status Transfers::read(Buffer& buffer, std::uint64_t offset, std::span<std::byte> bytes) {
    if (bytes.empty()) {
        return {};
    }
    const Result<MappedBuffer> target = readback_.reserve(bytes.size());
    if (!target) {
        return forward_error(target);
    }
    const Result<VkCommandBuffer> commands = queue_.commands();
    if (!commands) {
        return forward_error(commands);
    }
    define_contents(device_, *commands, buffer);
    BarrierBatch barriers;
    use_buffer(buffer, Usage::CopySource, barriers);
    barriers.flush(device_.fn, *commands);
    const VkBufferCopy region{offset, 0, bytes.size()};
    device_.fn.CmdCopyBuffer(*commands, buffer.handle, target->handle, 1, &region);
    if (const Status finished = finish_reading(*commands); !finished) {
        return finished;
    }
    std::memcpy(bytes.data(), target->memory.mapped, bytes.size());
    return {};
}

Status Transfers::read(Texture& texture, gpu::Aspect aspect, std::span<std::byte> bytes) {
    const Result<MappedBuffer> target = readback_.reserve(bytes.size());
    if (!target) {
        return forward_error(target);
    }
    const Result<VkCommandBuffer> commands = queue_.commands();
    if (!commands) {
        return forward_error(commands);
    }
    define_contents(device_, *commands, texture);
    BarrierBatch barriers;
    use_texture(texture, Usage::CopySource, barriers);
    barriers.flush(device_.fn, *commands);
    const VkBufferImageCopy region = whole_level(texture, 0, to_vk(aspect), 0);
    device_.fn.CmdCopyImageToBuffer(*commands, texture.handle,
                                    layout_of(Usage::CopySource, texture.aspects), target->handle,
                                    1, &region);
    if (const Status finished = finish_reading(*commands); !finished) {
        return finished;
    }
    if (aspect == gpu::Aspect::DepthOnly && texture.format == gpu::Format::Depth24UnormStencil8) {
        convert_depth24(target->memory.mapped, bytes);
    } else {
        std::memcpy(bytes.data(), target->memory.mapped, bytes.size());
    }
    return {};
}

Result<std::vector<std::uint64_t>> Transfers::read(const QuerySet& queries) {
    if (const Status finished = queue_.finish(); !finished) {
        return forward_error(finished);
    }
    std::vector<std::uint64_t> values(queries.written.size(), 0);
    for (std::uint32_t i = 0; i < values.size(); ++i) {
        if (!queries.written[i]) {
            continue;
        }
        if (const VkResult result = device_.fn.GetQueryPoolResults(
                device_.handle, queries.pool, i, 1, sizeof values[i], &values[i], sizeof values[i],
                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
            result != VK_SUCCESS) {
            return failure(result, "vkGetQueryPoolResults", queries.subject);
        }
        if (queries.type == gpu::QueryType::Timestamp) {
            const std::uint32_t bits = device_.adapter.timestamp_bits;
            const std::uint64_t ticks =
                bits < 64 ? values[i] & ((std::uint64_t{1} << bits) - 1) : values[i];
            // In long double: a double cannot hold the nanoseconds of a machine up for 105 days.
            values[i] = static_cast<std::uint64_t>(std::llround(
                static_cast<long double>(ticks) *
                static_cast<long double>(device_.adapter.properties.limits.timestampPeriod)));
        }
    }
    return values;
}

}  // namespace gnomon::vk
