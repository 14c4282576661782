// SPDX-License-Identifier: MIT
//
// Textures: an image, its views, its layout and which of its contents are defined; and samplers.
#pragma once

#include <optional>
#include <string>

#include <gnomon/gpu/descriptors.hpp>

#include "internal/host_passes.hpp"
#include "internal/memory.hpp"
#include "internal/sync.hpp"

namespace gnomon::vk {

struct Texture {
    std::string subject;  ///< "texture 'shadow mask'", for errors
    VkImage handle = VK_NULL_HANDLE;
    Allocation memory;
    gpu::Format format = gpu::Format::Undefined;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t mip_level_count = 1;
    std::uint32_t sample_count = 1;
    VkImageAspectFlags aspects = 0;
    /// Aspects that count as zero although nothing has written zeros yet: fresh ones, and those
    /// that a render pass discarded.
    VkImageAspectFlags undefined = 0;
    VkImageView attachment = VK_NULL_HANDLE;       ///< mip level 0, all aspects
    VkImageView sampled_color = VK_NULL_HANDLE;    ///< all mip levels, one aspect each;
    VkImageView sampled_depth = VK_NULL_HANDLE;    ///< null where the usage or the format
    VkImageView sampled_stencil = VK_NULL_HANDLE;  ///< does not have it
    Tracker tracker;
    /// Of an image that the host made: the layout that it is in before and after each pass.
    std::optional<VkImageLayout> host_layout = std::nullopt;
    /// Of the depth and stencil of a host's render pass, which alone knows the image.
    std::optional<HostRenderPass> host_pass = std::nullopt;
    HostPassKind host_pass_kind = 0;  ///< of that
    std::uint64_t read_by_host = 0;   ///< as Buffer has it

    [[nodiscard]] VkImageView sampled(gpu::Aspect aspect) const;
};

[[nodiscard]] Result<Texture> make_texture(Device& device, Memory& memory,
                                           const gpu::TextureDesc& desc);
[[nodiscard]] Result<Texture> import_texture(Device& device, const gpu::TextureDesc& desc,
                                             const HostImage& host);
[[nodiscard]] Result<Texture> import_texture(Device& device, const gpu::TextureDesc& desc,
                                             const HostRenderPass& host);
/// gpu::Backend::takes_colors_beside().
[[nodiscard]] Status takes_colors_beside(const Texture& texture);
void free_texture(Device& device, Memory& memory, Texture& texture);

/// Gathers the transition before a use.
void use_texture(Texture& texture, Usage usage, BarrierBatch& barriers);
/// Records the clears that make undefined contents zero. Not inside a render pass.
void define_contents(Device& device, VkCommandBuffer commands, Texture& texture);

[[nodiscard]] Result<VkSampler> make_sampler(Device& device, const gpu::SamplerDesc& desc);

}  // namespace gnomon::vk
