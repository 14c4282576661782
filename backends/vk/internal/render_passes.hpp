// SPDX-License-Identifier: MIT
//
// VkRenderPass and VkFramebuffer objects, made on first use and kept. Vulkan 1.1 has no dynamic
// rendering; one path that works everywhere is better than two.
#pragma once

#include <compare>
#include <map>
#include <vector>

#include "internal/queue.hpp"

namespace gnomon::vk {

/// One attachment as a render pass sees it. Layouts do not change within a pass: barriers before it
/// have moved the images.
struct AttachmentState {
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkAttachmentLoadOp load = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    VkAttachmentStoreOp store = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    VkAttachmentLoadOp stencil_load = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    VkAttachmentStoreOp stencil_store = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    bool resolves = false;  ///< into a single-sampled attachment; colour only
    auto operator<=>(const AttachmentState&) const = default;
};

struct RenderPassKey {
    std::vector<AttachmentState> colors;
    std::vector<AttachmentState> depth_stencil;  ///< none or one
    auto operator<=>(const RenderPassKey&) const = default;
};

struct FramebufferKey {
    VkRenderPass render_pass = VK_NULL_HANDLE;
    std::vector<VkImageView> views;  ///< colours, resolve targets in their order, depth-stencil
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    auto operator<=>(const FramebufferKey&) const = default;
};

class RenderPasses {
public:
    RenderPasses(Device& device, Queue& queue) : device_(device), queue_(queue) {}
    ~RenderPasses();
    RenderPasses(const RenderPasses&) = delete;
    RenderPasses& operator=(const RenderPasses&) = delete;

    [[nodiscard]] Result<VkRenderPass> render_pass(const RenderPassKey& key);
    [[nodiscard]] Result<VkFramebuffer> framebuffer(const FramebufferKey& key,
                                                    const std::string& subject);
    /// The view is about to be destroyed: framebuffers with it go, once the device is done.
    void forget(VkImageView view);

private:
    Device& device_;
    Queue& queue_;
    std::map<RenderPassKey, VkRenderPass> render_passes_;
    std::map<FramebufferKey, VkFramebuffer> framebuffers_;
};

}  // namespace gnomon::vk
