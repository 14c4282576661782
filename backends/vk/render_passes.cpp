// SPDX-License-Identifier: MIT
//
// The caches of render passes and framebuffers.
#include "internal/render_passes.hpp"

#include <algorithm>

#include "internal/error.hpp"

namespace gnomon::vk {

namespace {

VkAttachmentDescription describe(const AttachmentState& state) {
    VkAttachmentDescription description{};
    description.format = state.format;
    description.samples = state.samples;
    description.loadOp = state.load;
    description.storeOp = state.store;
    description.stencilLoadOp = state.stencil_load;
    description.stencilStoreOp = state.stencil_store;
    description.initialLayout = state.layout;
    description.finalLayout = state.layout;
    return description;
}

}  // namespace

RenderPasses::~RenderPasses() {
    for (const auto& [key, framebuffer] : framebuffers_) {
        device_.fn.DestroyFramebuffer(device_.handle, framebuffer, nullptr);
    }
    for (const auto& [key, render_pass] : render_passes_) {
        device_.fn.DestroyRenderPass(device_.handle, render_pass, nullptr);
    }
}

Result<VkRenderPass> RenderPasses::render_pass(const RenderPassKey& key) {
    if (const auto found = render_passes_.find(key); found != render_passes_.end()) {
        return found->second;
    }
    std::vector<VkAttachmentDescription> attachments;
    std::vector<VkAttachmentReference> colors;
    std::vector<VkAttachmentReference> resolves;
    const auto refer_to_last = [&](VkImageLayout layout) {
        return VkAttachmentReference{static_cast<std::uint32_t>(attachments.size() - 1), layout};
    };
    bool any_resolves = false;
    for (const AttachmentState& color : key.colors) {
        attachments.push_back(describe(color));
        colors.push_back(refer_to_last(color.layout));
        any_resolves = any_resolves || color.resolves;
    }
    for (const AttachmentState& color : key.colors) {
        if (!color.resolves) {
            resolves.push_back({VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_UNDEFINED});
            continue;
        }
        AttachmentState target;
        target.format = color.format;
        target.layout = color.layout;
        target.store = VK_ATTACHMENT_STORE_OP_STORE;
        attachments.push_back(describe(target));
        resolves.push_back(refer_to_last(target.layout));
    }
    VkAttachmentReference depth_stencil{};
    for (const AttachmentState& state : key.depth_stencil) {
        attachments.push_back(describe(state));
        depth_stencil = refer_to_last(state.layout);
    }

    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = static_cast<std::uint32_t>(colors.size());
    subpass.pColorAttachments = colors.data();
    subpass.pResolveAttachments = any_resolves ? resolves.data() : nullptr;
    subpass.pDepthStencilAttachment = key.depth_stencil.empty() ? nullptr : &depth_stencil;
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = static_cast<std::uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass render_pass = VK_NULL_HANDLE;
    if (const VkResult result =
            device_.fn.CreateRenderPass(device_.handle, &info, nullptr, &render_pass);
        result != VK_SUCCESS) {
        return failure(result, "vkCreateRenderPass", "the attachments of a render pass");
    }
    render_passes_.emplace(key, render_pass);
    return render_pass;
}

Result<VkFramebuffer> RenderPasses::framebuffer(const FramebufferKey& key,
                                                const std::string& subject) {
    if (const auto found = framebuffers_.find(key); found != framebuffers_.end()) {
        return found->second;
    }
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = key.render_pass;
    info.attachmentCount = static_cast<std::uint32_t>(key.views.size());
    info.pAttachments = key.views.data();
    info.width = key.width;
    info.height = key.height;
    info.layers = 1;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    if (const VkResult result =
            device_.fn.CreateFramebuffer(device_.handle, &info, nullptr, &framebuffer);
        result != VK_SUCCESS) {
        return failure(result, "vkCreateFramebuffer", subject);
    }
    framebuffers_.emplace(key, framebuffer);
    return framebuffer;
}

void RenderPasses::forget(VkImageView view) {
    if (view == VK_NULL_HANDLE) {
        return;
    }
    std::erase_if(framebuffers_, [&](const auto& entry) {
        const auto& [key, framebuffer] = entry;
        if (std::find(key.views.begin(), key.views.end(), view) == key.views.end()) {
            return false;
        }
        queue_.defer([this, dead = framebuffer] {
            device_.fn.DestroyFramebuffer(device_.handle, dead, nullptr);
        });
        return true;
    });
}

}  // namespace gnomon::vk
