// SPDX-License-Identifier: MIT
//
// Every enumeration of the interface in Vulkan's words, side by side.
#pragma once

#include <gnomon/gpu/types.hpp>

#include "internal/functions.hpp"

namespace gnomon::vk {

[[nodiscard]] VkFormat to_vk(gpu::Format format);
[[nodiscard]] VkFormat to_vk(gpu::VertexFormat format);
[[nodiscard]] VkImageAspectFlags aspects_of(gpu::Format format);
[[nodiscard]] VkImageAspectFlags to_vk(gpu::Aspect aspect);
[[nodiscard]] VkCompareOp to_vk(gpu::Compare compare);
[[nodiscard]] VkStencilOp to_vk(gpu::StencilOp op);
[[nodiscard]] VkPrimitiveTopology to_vk(gpu::PrimitiveTopology topology);
[[nodiscard]] VkFrontFace to_vk(gpu::FrontFace face);
[[nodiscard]] VkCullModeFlags to_vk(gpu::CullMode mode);
[[nodiscard]] VkIndexType to_vk(gpu::IndexFormat format);
[[nodiscard]] VkVertexInputRate to_vk(gpu::VertexStepMode mode);
[[nodiscard]] VkBlendFactor to_vk(gpu::BlendFactor factor);
[[nodiscard]] VkBlendOp to_vk(gpu::BlendOperation operation);
[[nodiscard]] VkColorComponentFlags to_vk(gpu::ColorWrite mask);
[[nodiscard]] VkAttachmentLoadOp to_vk(gpu::LoadOp op);
[[nodiscard]] VkAttachmentStoreOp to_vk(gpu::StoreOp op);
[[nodiscard]] VkSamplerAddressMode to_vk(gpu::AddressMode mode);
[[nodiscard]] VkFilter to_vk(gpu::FilterMode mode);
[[nodiscard]] VkSamplerMipmapMode to_vk_mipmap(gpu::FilterMode mode);
[[nodiscard]] VkShaderStageFlags to_vk(gpu::ShaderStage stages);
[[nodiscard]] VkSampleCountFlagBits to_vk_samples(std::uint32_t count);

}  // namespace gnomon::vk
