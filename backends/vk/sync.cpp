// SPDX-License-Identifier: MIT
//
// Tracks uses and makes barriers.
#include "internal/sync.hpp"

namespace gnomon::vk {

namespace {

struct UsageInfo {
    VkPipelineStageFlags stages;
    VkAccessFlags access;
    VkAccessFlags writes;  // the part of `access` that writes
};

constexpr VkPipelineStageFlags depth_stages =
    VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
constexpr VkPipelineStageFlags shader_stages =
    VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;

UsageInfo info_of(Usage usage) {
    switch (usage) {
        case Usage::CopySource:
            return {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT, 0};
        case Usage::CopyDestination:
            return {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
                    VK_ACCESS_TRANSFER_WRITE_BIT};
        case Usage::VertexInput:
            return {VK_PIPELINE_STAGE_VERTEX_INPUT_BIT,
                    VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT | VK_ACCESS_INDEX_READ_BIT, 0};
        case Usage::Uniform: return {shader_stages, VK_ACCESS_UNIFORM_READ_BIT, 0};
        case Usage::SampledInFragment:
            return {VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT, 0};
        case Usage::SampledInVertex: return {shader_stages, VK_ACCESS_SHADER_READ_BIT, 0};
        case Usage::ColorAttachment:
            return {VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                    VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
                    VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT};
        case Usage::DepthStencilAttachment:
            return {depth_stages,
                    VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                        VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
                    VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
        case Usage::PresentSource:
            // The semaphore that presenting waits for does the rest.
            return {VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0, 0};
    }
    return {};
}

std::uint32_t bit_of(Usage usage) { return 1U << static_cast<unsigned>(usage); }

VkPipelineStageFlags stages_of_readers(std::uint32_t readers) {
    VkPipelineStageFlags stages = 0;
    for (unsigned i = 0; readers >> i != 0; ++i) {
        if ((readers >> i & 1U) != 0) {
            stages |= info_of(static_cast<Usage>(i)).stages;
        }
    }
    return stages;
}

}  // namespace

VkImageLayout layout_of(Usage usage, VkImageAspectFlags aspects) {
    switch (usage) {
        case Usage::CopySource: return VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
        case Usage::CopyDestination: return VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
        case Usage::SampledInFragment:
        case Usage::SampledInVertex:
            return (aspects & VK_IMAGE_ASPECT_COLOR_BIT) != 0
                       ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL
                       : VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
        case Usage::ColorAttachment: return VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        case Usage::DepthStencilAttachment: return VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
        case Usage::PresentSource: return VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
        default: return VK_IMAGE_LAYOUT_UNDEFINED;
    }
}

bool Tracker::use_buffer(Usage usage, Dependency& dependency) {
    return use(usage, VK_IMAGE_LAYOUT_UNDEFINED, dependency);
}

bool Tracker::use_image(Usage usage, VkImageAspectFlags aspects, Dependency& dependency) {
    return use(usage, layout_of(usage, aspects), dependency);
}

void Tracker::acquired(VkPipelineStageFlags stages) {
    write_stages_ = stages;
    write_access_ = 0;
    readers_ = 0;
    layout_ = VK_IMAGE_LAYOUT_UNDEFINED;
}

void Tracker::lent(VkImageLayout layout) {
    write_stages_ = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    write_access_ = VK_ACCESS_MEMORY_WRITE_BIT;
    readers_ = 0;
    layout_ = layout;
}

void Tracker::give_back(VkImageLayout layout, Dependency& dependency) {
    dependency = {.source_stages = write_stages_,
                  .source_access = write_access_,
                  .destination_stages = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                  .destination_access = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
                  .old_layout = layout_,
                  .new_layout = layout};
}

bool Tracker::use(Usage usage, VkImageLayout layout, Dependency& dependency) {
    const UsageInfo info = info_of(usage);
    const bool moves = layout != layout_;
    dependency = {.source_stages = write_stages_,
                  .source_access = write_access_,
                  .destination_stages = info.stages,
                  .destination_access = info.access,
                  .old_layout = layout_,
                  .new_layout = layout};
    if (info.writes == 0 && !moves) {
        const bool waits = write_stages_ != 0 && (readers_ & bit_of(usage)) == 0;
        readers_ |= bit_of(usage);
        return waits;
    }
    if (readers_ != 0) {
        // They waited for the last write already: waiting for them is enough.
        dependency.source_stages = stages_of_readers(readers_);
        dependency.source_access = 0;
    }
    const bool first = dependency.source_stages == 0;
    if (first) {
        dependency.source_stages = VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT;
    }
    write_stages_ = info.stages;
    write_access_ = info.writes;
    readers_ = info.writes == 0 ? bit_of(usage) : 0;
    layout_ = layout;
    return moves || !first;
}

void BarrierBatch::add_memory(const Dependency& dependency) {
    any_ = true;
    source_stages_ |= dependency.source_stages;
    destination_stages_ |= dependency.destination_stages;
    source_access_ |= dependency.source_access;
    destination_access_ |= dependency.destination_access;
}

void BarrierBatch::add_image(const Dependency& dependency, VkImage image,
                             VkImageAspectFlags aspects) {
    any_ = true;
    source_stages_ |= dependency.source_stages;
    destination_stages_ |= dependency.destination_stages;
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.srcAccessMask = dependency.source_access;
    barrier.dstAccessMask = dependency.destination_access;
    barrier.oldLayout = dependency.old_layout;
    barrier.newLayout = dependency.new_layout;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {aspects, 0, VK_REMAINING_MIP_LEVELS, 0, 1};
    images_.push_back(barrier);
}

void BarrierBatch::flush(const DeviceFunctions& fn, VkCommandBuffer commands) {
    if (!any_) {
        return;
    }
    VkMemoryBarrier memory{};
    memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    memory.srcAccessMask = source_access_;
    memory.dstAccessMask = destination_access_;
    const bool has_memory = (source_access_ | destination_access_) != 0;
    fn.CmdPipelineBarrier(commands, source_stages_, destination_stages_, 0, has_memory ? 1 : 0,
                          &memory, 0, nullptr, static_cast<std::uint32_t>(images_.size()),
                          images_.data());
    *this = {};
}

}  // namespace gnomon::vk
