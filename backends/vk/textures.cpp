// SPDX-License-Identifier: MIT
//
// Makes, frees and prepares textures; makes samplers.
#include "internal/textures.hpp"

#include <fmt/format.h>

#include "internal/conv.hpp"
#include "internal/device.hpp"
#include "internal/error.hpp"

namespace gnomon::vk {

namespace {

VkImageUsageFlags usage_flags(const gpu::TextureDesc& desc) {
    // Every texture starts as zero, which a transfer sees to unless a render pass does.
    VkImageUsageFlags flags = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if (gpu::has(desc.usage, gpu::TextureUsage::CopySrc)) {
        flags |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    }
    if (gpu::has(desc.usage, gpu::TextureUsage::TextureBinding)) {
        flags |= VK_IMAGE_USAGE_SAMPLED_BIT;
    }
    if (gpu::has(desc.usage, gpu::TextureUsage::RenderAttachment)) {
        flags |= gpu::has_color(desc.format) ? VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT
                                             : VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    }
    return flags;
}

/// The driver's word on whether such an image exists, before it is asked to make one.
Status check_supported(Device& device, const VkImageCreateInfo& info, const Texture& texture) {
    VkImageFormatProperties properties{};
    const VkResult result = device.instance->fn.GetPhysicalDeviceImageFormatProperties(
        device.adapter.handle, info.format, info.imageType, info.tiling, info.usage, info.flags,
        &properties);
    if (result != VK_SUCCESS) {
        return failure(result, "vkGetPhysicalDeviceImageFormatProperties", texture.subject);
    }
    if ((properties.sampleCounts & static_cast<VkSampleCountFlags>(info.samples)) == 0) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("The adapter has no {} samples a pixel for {}.",
                                texture.sample_count, texture.subject));
    }
    return {};
}

Status make_view(Device& device, const Texture& texture, VkImageAspectFlags aspects,
                 std::uint32_t mip_levels, VkImageView& view) {
    VkImageViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.image = texture.handle;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = to_vk(texture.format);
    info.subresourceRange = {aspects, 0, mip_levels, 0, 1};
    if (const VkResult result = device.fn.CreateImageView(device.handle, &info, nullptr, &view);
        result != VK_SUCCESS) {
        return failure(result, "vkCreateImageView", texture.subject);
    }
    return {};
}

Status make_views(Device& device, const gpu::TextureDesc& desc, Texture& texture) {
    if (gpu::has(desc.usage, gpu::TextureUsage::RenderAttachment)) {
        if (const Status made = make_view(device, texture, texture.aspects, 1, texture.attachment);
            !made) {
            return made;
        }
    }
    if (!gpu::has(desc.usage, gpu::TextureUsage::TextureBinding)) {
        return {};
    }
    const auto make_sampled = [&](VkImageAspectFlags aspect, VkImageView& view) -> Status {
        if ((texture.aspects & aspect) == 0) {
            return {};
        }
        return make_view(device, texture, aspect, texture.mip_level_count, view);
    };
    Status made = make_sampled(VK_IMAGE_ASPECT_COLOR_BIT, texture.sampled_color);
    if (made) {
        made = make_sampled(VK_IMAGE_ASPECT_DEPTH_BIT, texture.sampled_depth);
    }
    if (made) {
        made = make_sampled(VK_IMAGE_ASPECT_STENCIL_BIT, texture.sampled_stencil);
    }
    return made;
}

Status fill_in(Device& device, Memory& memory, const gpu::TextureDesc& desc, Texture& texture) {
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = to_vk(desc.format);
    info.extent = {desc.width, desc.height, 1};
    info.mipLevels = desc.mip_level_count;
    info.arrayLayers = 1;
    info.samples = to_vk_samples(desc.sample_count);
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = usage_flags(desc);
    info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    if (const Status supported = check_supported(device, info, texture); !supported) {
        return supported;
    }
    if (const VkResult result =
            device.fn.CreateImage(device.handle, &info, nullptr, &texture.handle);
        result != VK_SUCCESS) {
        return failure(result, "vkCreateImage", texture.subject);
    }
    VkMemoryRequirements requirements{};
    device.fn.GetImageMemoryRequirements(device.handle, texture.handle, &requirements);
    const Result<Allocation> allocation =
        memory.allocate(requirements, MemoryKind::Image, texture.subject);
    if (!allocation) {
        return forward_error(allocation);
    }
    texture.memory = *allocation;
    if (const VkResult result = device.fn.BindImageMemory(device.handle, texture.handle,
                                                          allocation->memory, allocation->offset);
        result != VK_SUCCESS) {
        return failure(result, "vkBindImageMemory", texture.subject);
    }
    device.set_name(VK_OBJECT_TYPE_IMAGE, texture.handle, desc.label);
    return make_views(device, desc, texture);
}

/// Whether all aspects of an image can be in this layout at once.
bool holds(VkImageLayout layout, VkImageAspectFlags aspects) {
    const bool color = aspects == VK_IMAGE_ASPECT_COLOR_BIT;
    switch (layout) {
        case VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL:
        case VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL:
        case VK_IMAGE_LAYOUT_STENCIL_ATTACHMENT_OPTIMAL:
        case VK_IMAGE_LAYOUT_STENCIL_READ_ONLY_OPTIMAL: return false;
        case VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL:
        case VK_IMAGE_LAYOUT_PRESENT_SRC_KHR: return color;
        case VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL:
        case VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL:
        case VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_STENCIL_ATTACHMENT_OPTIMAL:
        case VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_STENCIL_READ_ONLY_OPTIMAL: return !color;
        default: return true;
    }
}

/// What a host made can only be drawn to, whole.
Status check_import(const gpu::TextureDesc& desc, const std::string& subject) {
    if ((!gpu::has_stencil(desc.format) && !gpu::has_color(desc.format)) ||
        desc.usage != gpu::TextureUsage::RenderAttachment) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("{} can only be of a depth-stencil or colour format, with the "
                                "usage RenderAttachment and no other.",
                                subject));
    }
    if (desc.mip_level_count != 1) {
        return fail(ErrorCode::Unsupported, fmt::format("{} can only have 1 mip level, not {}.",
                                                        subject, desc.mip_level_count));
    }
    return {};
}

Texture described(const gpu::TextureDesc& desc) {
    Texture texture;
    texture.subject = fmt::format("texture '{}'", desc.label);
    texture.format = desc.format;
    texture.width = desc.width;
    texture.height = desc.height;
    texture.mip_level_count = desc.mip_level_count;
    texture.sample_count = desc.sample_count;
    texture.aspects = aspects_of(desc.format);
    return texture;
}

}  // namespace

VkImageView Texture::sampled(gpu::Aspect aspect) const {
    switch (aspect) {
        case gpu::Aspect::DepthOnly: return sampled_depth;
        case gpu::Aspect::StencilOnly: return sampled_stencil;
        default: return sampled_color;
    }
}

Result<Texture> make_texture(Device& device, Memory& memory, const gpu::TextureDesc& desc) {
    Texture texture = described(desc);
    texture.undefined = texture.aspects;
    if (const Status made = fill_in(device, memory, desc, texture); !made) {
        free_texture(device, memory, texture);
        return forward_error(made);
    }
    return texture;
}

Result<Texture> import_texture(Device& device, const gpu::TextureDesc& desc,
                               const HostImage& host) {
    Texture texture = described(desc);
    const std::string subject = fmt::format("The host's image of {}", texture.subject);
    if (const Status checked = check_import(desc, subject); !checked) {
        return forward_error(checked);
    }
    if (host.image == 0) {
        return fail(ErrorCode::InvalidInput, fmt::format("{} is VK_NULL_HANDLE.", subject));
    }
    const auto layout = static_cast<VkImageLayout>(host.layout);
    if (layout == VK_IMAGE_LAYOUT_UNDEFINED || layout == VK_IMAGE_LAYOUT_PREINITIALIZED) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{} is in a layout in which it has no contents ({}): say the one "
                                "that {}.",
                                subject, host.layout,
                                gpu::has_color(desc.format) ? "it is sampled in, for instance"
                                                            : "its depth was drawn in"));
    }
    if (!holds(layout, texture.aspects)) {
        return fail(
            ErrorCode::Unsupported,
            fmt::format("{} is in the layout {}, which is not one of {}.", subject, host.layout,
                        gpu::has_color(desc.format)
                            ? "colour: SHADER_READ_ONLY_OPTIMAL, for instance, is"
                            : "depth and stencil together: depth and stencil must be in "
                              "one layout, for instance DEPTH_STENCIL_ATTACHMENT_OPTIMAL"));
    }
    texture.handle = reinterpret_cast<VkImage>(host.image);
    texture.host_layout = layout;
    if (const Status made = make_view(device, texture, texture.aspects, 1, texture.attachment);
        !made) {
        return forward_error(made);
    }
    return texture;
}

Result<Texture> import_texture(Device& device, const gpu::TextureDesc& desc,
                               const HostRenderPass& host) {
    Texture texture = described(desc);
    const std::string subject = fmt::format("The host's render pass of {}", texture.subject);
    if (!gpu::has_stencil(desc.format)) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("{} can only be imported by its depth and stencil, with a "
                                "depth-stencil format.",
                                subject));
    }
    if (const Status checked = check_import(desc, subject); !checked) {
        return forward_error(checked);
    }
    if (host.render_pass == 0 && !device.adapter.dynamic_rendering) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("{} has a VkRenderPass of VK_NULL_HANDLE, so it is begun by "
                                "vkCmdBeginRendering(), but HostDevice::enabled_features lacks "
                                "\"dynamicRendering\".",
                                subject));
    }
    if (host.render_pass == 0 && host.subpass != 0) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{} is begun by vkCmdBeginRendering(), which knows no subpasses, "
                                "but its subpass is {}.",
                                subject, host.subpass));
    }
    const std::uint32_t most = device.adapter.caps.limits.max_color_attachments;
    if (host.color_formats.size() > most) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{} has {} colour attachments, but the adapter {}.", subject,
                                host.color_formats.size(), most));
    }
    texture.host_pass = host;
    return texture;
}

Status takes_colors_beside(const Texture& texture) {
    if (!texture.host_pass) {
        return {};
    }
    return fail(ErrorCode::Unsupported,
                fmt::format("The host's render pass of {} takes no colours of gnomon's beside it, "
                            "such as light masks: import the depth and stencil as a vk::HostImage, "
                            "and draw outside of the host's pass.",
                            texture.subject));
}

void free_texture(Device& device, Memory& memory, Texture& texture) {
    for (VkImageView view : {texture.attachment, texture.sampled_color, texture.sampled_depth,
                             texture.sampled_stencil}) {
        device.fn.DestroyImageView(device.handle, view, nullptr);
    }
    if (texture.host_layout || texture.host_pass) {
        return;
    }
    device.fn.DestroyImage(device.handle, texture.handle, nullptr);
    memory.free(texture.memory);
}

void use_texture(Texture& texture, Usage usage, BarrierBatch& barriers) {
    Dependency dependency;
    if (texture.tracker.use_image(usage, texture.aspects, dependency)) {
        barriers.add_image(dependency, texture.handle, texture.aspects);
    }
}

void define_contents(Device& device, VkCommandBuffer commands, Texture& texture) {
    if (texture.undefined == 0) {
        return;
    }
    if (texture.undefined == texture.aspects) {
        texture.tracker.forget_contents();
    }
    BarrierBatch barriers;
    use_texture(texture, Usage::CopyDestination, barriers);
    barriers.flush(device.fn, commands);
    const VkImageLayout layout = layout_of(Usage::CopyDestination, texture.aspects);
    const VkImageSubresourceRange range{texture.undefined, 0, texture.mip_level_count, 0, 1};
    if (gpu::has_color(texture.format)) {
        const VkClearColorValue zero{};
        device.fn.CmdClearColorImage(commands, texture.handle, layout, &zero, 1, &range);
    } else {
        const VkClearDepthStencilValue zero{};
        device.fn.CmdClearDepthStencilImage(commands, texture.handle, layout, &zero, 1, &range);
    }
    texture.undefined = 0;
}

Result<VkSampler> make_sampler(Device& device, const gpu::SamplerDesc& desc) {
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = to_vk(desc.mag_filter);
    info.minFilter = to_vk(desc.min_filter);
    info.mipmapMode = to_vk_mipmap(desc.mipmap_filter);
    info.addressModeU = to_vk(desc.address_mode_u);
    info.addressModeV = to_vk(desc.address_mode_v);
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.maxLod = VK_LOD_CLAMP_NONE;
    VkSampler sampler = VK_NULL_HANDLE;
    if (const VkResult result = device.fn.CreateSampler(device.handle, &info, nullptr, &sampler);
        result != VK_SUCCESS) {
        return failure(result, "vkCreateSampler", fmt::format("sampler '{}'", desc.label));
    }
    device.set_name(VK_OBJECT_TYPE_SAMPLER, sampler, desc.label);
    return sampler;
}

}  // namespace gnomon::vk
