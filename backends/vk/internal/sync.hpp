// SPDX-License-Identifier: MIT
//
// Which barriers a use of a resource needs. Commands are recorded in the order in which the queue
// runs them, so a resource's last write and the reads since then are all there is to remember.
// A use is one of a few kinds with fixed stages, accesses and layouts; whole resources are tracked.
#pragma once

#include <cstdint>
#include <vector>

#include "internal/functions.hpp"

namespace gnomon::vk {

enum class Usage : std::uint8_t {
    CopySource,
    CopyDestination,
    VertexInput,  ///< vertices and indices
    Uniform,
    SampledInFragment,
    SampledInVertex,  ///< and in fragment shaders
    ColorAttachment,
    DepthStencilAttachment,
    PresentSource,
};

/// What a barrier has to do.
struct Dependency {
    VkPipelineStageFlags source_stages = 0;
    VkAccessFlags source_access = 0;
    VkPipelineStageFlags destination_stages = 0;
    VkAccessFlags destination_access = 0;
    VkImageLayout old_layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< images only
    VkImageLayout new_layout = VK_IMAGE_LAYOUT_UNDEFINED;
};

/// The layout an image must be in for a use.
[[nodiscard]] VkImageLayout layout_of(Usage usage, VkImageAspectFlags aspects);

/// The state of one buffer or image.
class Tracker {
public:
    /// Notes the use. True when a barrier is needed first: `dependency` then says which.
    [[nodiscard]] bool use_buffer(Usage usage, Dependency& dependency);
    [[nodiscard]] bool use_image(Usage usage, VkImageAspectFlags aspects, Dependency& dependency);

    /// The contents are of no interest any more: the next transition may drop them.
    void forget_contents() { layout_ = VK_IMAGE_LAYOUT_UNDEFINED; }
    /// A swapchain image: what the semaphore waits for has happened at these stages.
    void acquired(VkPipelineStageFlags stages);
    /// A host's image: it may have been written by anything that came before.
    void lent(VkImageLayout layout);
    /// Gives it back: whatever comes after may use it, in that layout.
    void give_back(VkImageLayout layout, Dependency& dependency);

private:
    bool use(Usage usage, VkImageLayout layout, Dependency& dependency);

    VkPipelineStageFlags write_stages_ = 0;  // of the last write; 0: there was none
    VkAccessFlags write_access_ = 0;
    std::uint32_t readers_ = 0;  // uses that have waited for that write, one bit each
    VkImageLayout layout_ = VK_IMAGE_LAYOUT_UNDEFINED;
};

/// Gathers barriers and records them as one command.
class BarrierBatch {
public:
    void add_memory(const Dependency& dependency);
    void add_image(const Dependency& dependency, VkImage image, VkImageAspectFlags aspects);
    [[nodiscard]] bool empty() const { return !any_; }
    /// Records what was gathered, if anything. Not inside a render pass.
    void flush(const DeviceFunctions& fn, VkCommandBuffer commands);

private:
    VkPipelineStageFlags source_stages_ = 0;
    VkPipelineStageFlags destination_stages_ = 0;
    bool any_ = false;
    VkAccessFlags source_access_ = 0;
    VkAccessFlags destination_access_ = 0;
    std::vector<VkImageMemoryBarrier> images_;
};

}  // namespace gnomon::vk
