// SPDX-License-Identifier: MIT
//
// Making objects for ids, and freeing them when the device is done with them.
#include <algorithm>

#include <fmt/format.h>

#include "internal/conv.hpp"
#include "internal/error.hpp"
#include "internal/vulkan_backend.hpp"

namespace gnomon::vk {

namespace {

const gpu::BindGroupLayoutEntry& entry_of(const BindGroupLayout& layout, std::uint32_t binding) {
    return *std::find_if(
        layout.entries.begin(), layout.entries.end(),
        [binding](const gpu::BindGroupLayoutEntry& entry) { return entry.binding == binding; });
}

/// Whether it reads gl_SampleID: SPIR-V declares capabilities before all else.
bool runs_once_a_sample(const gpu::ShaderSource& source) {
    constexpr std::size_t header_words = 5;
    constexpr std::uint32_t capability = 17;  // OpCapability
    constexpr std::uint32_t sample_rate_shading = 35;
    constexpr std::uint32_t capability_words = 2;
    const std::span<const std::uint32_t> words = source.spirv;
    for (std::size_t i = header_words;
         i + 1 < words.size() && words[i] == (capability_words << 16U | capability);
         i += capability_words) {
        if (words[i + 1] == sample_rate_shading) {
            return true;
        }
    }
    return false;
}

}  // namespace

VulkanBackend::~VulkanBackend() {
    // Everything still alive may be in use by the last submissions.
    queue_.drain();
    swapchain_.reset();
    const auto free = [this](auto& object) { destroy_now(object); };
    resources_.query_sets.for_each(free);
    resources_.pipelines.for_each(free);
    resources_.bind_groups.for_each(free);
    resources_.bind_group_layouts.for_each(free);
    resources_.shaders.for_each(free);
    resources_.samplers.for_each(free);
    resources_.textures.for_each(free);
    resources_.buffers.for_each(free);
    device_->fn.DestroySampler(device_->handle, nearest_sampler_, nullptr);
}

Status VulkanBackend::create_buffer(gpu::BufferId id, const gpu::BufferDesc& desc) {
    Result<Buffer> buffer = make_buffer(*device_, memory_, desc);
    if (!buffer) {
        return forward_error(buffer);
    }
    resources_.buffers.insert(id, std::move(*buffer));
    return {};
}

Status VulkanBackend::create_texture(gpu::TextureId id, const gpu::TextureDesc& desc) {
    Result<Texture> texture = make_texture(*device_, memory_, desc);
    if (!texture) {
        return forward_error(texture);
    }
    resources_.textures.insert(id, std::move(*texture));
    return {};
}

Status VulkanBackend::import_texture(gpu::TextureId id, const gpu::TextureDesc& desc,
                                     const gpu::NativeTexture& native) {
    const auto* image = std::any_cast<HostImage>(&native);
    const auto* pass = std::any_cast<HostRenderPass>(&native);
    if (image == nullptr && pass == nullptr) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("[Texture \"{}\"] cannot be imported: what Vulkan imports is a "
                                "vk::HostImage or a vk::HostRenderPass.",
                                desc.label));
    }
    Result<Texture> texture = image != nullptr ? gnomon::vk::import_texture(*device_, desc, *image)
                                               : gnomon::vk::import_texture(*device_, desc, *pass);
    if (!texture) {
        return forward_error(texture);
    }
    if (pass != nullptr) {
        texture->host_pass_kind = host_passes_.add(*pass, desc.format, desc.sample_count);
    }
    resources_.textures.insert(id, std::move(*texture));
    return {};
}

Status VulkanBackend::create_sampler(gpu::SamplerId id, const gpu::SamplerDesc& desc) {
    const Result<VkSampler> sampler = make_sampler(*device_, desc);
    if (!sampler) {
        return forward_error(sampler);
    }
    resources_.samplers.insert(id, *sampler);
    return {};
}

Status VulkanBackend::create_shader(gpu::ShaderId id, const gpu::ShaderDesc& desc) {
    if (runs_once_a_sample(desc.source) && device_->adapter.enabled.sampleRateShading == VK_FALSE) {
        return fail(
            ErrorCode::Unsupported,
            fmt::format("Shader '{}' runs once a sample, but {}.", desc.label,
                        device_->is_adopted()
                            ? "HostDevice::enabled_features lacks \"sampleRateShading\": make the "
                              "device with that feature, and name it there"
                            : "the adapter lacks sampleRateShading"));
    }
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = desc.source.spirv.size_bytes();
    info.pCode = desc.source.spirv.data();
    VkShaderModule shader = VK_NULL_HANDLE;
    if (const VkResult result =
            device_->fn.CreateShaderModule(device_->handle, &info, nullptr, &shader);
        result != VK_SUCCESS) {
        return failure(result, "vkCreateShaderModule", fmt::format("shader '{}'", desc.label));
    }
    device_->set_name(VK_OBJECT_TYPE_SHADER_MODULE, shader, desc.label);
    resources_.shaders.insert(id, shader);
    return {};
}

Status VulkanBackend::create_bind_group_layout(gpu::BindGroupLayoutId id,
                                               const gpu::BindGroupLayoutDesc& desc) {
    Result<BindGroupLayout> layout = make_bind_group_layout(*device_, desc);
    if (!layout) {
        return forward_error(layout);
    }
    resources_.bind_group_layouts.insert(id, std::move(*layout));
    return {};
}

Status VulkanBackend::create_bind_group(gpu::BindGroupId id, const gpu::BindGroupDesc& desc) {
    const BindGroupLayout& layout = resources_.bind_group_layouts[desc.layout];
    const Result<DescriptorSet> set =
        descriptor_pools_.allocate(layout, fmt::format("bind group '{}'", desc.label));
    if (!set) {
        return forward_error(set);
    }
    BindGroup group;
    group.set = *set;
    for (const gpu::BindGroupEntry& entry : desc.entries) {
        const gpu::BindGroupLayoutEntry& expected = entry_of(layout, entry.binding);
        if (expected.type == gpu::BindingType::UniformBuffer) {
            group.buffers.push_back(entry.buffer);
        } else {
            group.textures.push_back(
                {entry.texture, gpu::has(expected.visibility, gpu::ShaderStage::Vertex)});
        }
    }
    write_descriptors(group, layout, desc);
    device_->set_name(VK_OBJECT_TYPE_DESCRIPTOR_SET, group.set.handle, desc.label);
    resources_.bind_groups.insert(id, std::move(group));
    return {};
}

void VulkanBackend::write_descriptors(const BindGroup& group, const BindGroupLayout& layout,
                                      const gpu::BindGroupDesc& desc) {
    // Writes point into these, which must not move: their final size is reserved.
    std::vector<VkDescriptorBufferInfo> buffers;
    std::vector<VkDescriptorImageInfo> images;
    std::vector<VkWriteDescriptorSet> writes;
    buffers.reserve(desc.entries.size());
    images.reserve(desc.entries.size());
    for (const gpu::BindGroupEntry& entry : desc.entries) {
        const gpu::BindGroupLayoutEntry& expected = entry_of(layout, entry.binding);
        VkWriteDescriptorSet write{};
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = group.set.handle;
        write.dstBinding = entry.binding;
        write.descriptorCount = 1;
        if (expected.type == gpu::BindingType::UniformBuffer) {
            const Buffer& buffer = resources_.buffers[entry.buffer];
            const std::uint64_t size = entry.size != 0 ? entry.size : buffer.size - entry.offset;
            buffers.push_back({buffer.handle, entry.offset, size});
            write.descriptorType = expected.has_dynamic_offset
                                       ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC
                                       : VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
            write.pBufferInfo = &buffers.back();
        } else {
            const Texture& texture = resources_.textures[entry.texture];
            const VkSampler sampler =
                entry.sampler ? resources_.samplers[entry.sampler] : nearest_sampler_;
            images.push_back({sampler, texture.sampled(entry.aspect),
                              layout_of(Usage::SampledInFragment, texture.aspects)});
            write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
            write.pImageInfo = &images.back();
        }
        writes.push_back(write);
    }
    device_->fn.UpdateDescriptorSets(device_->handle, static_cast<std::uint32_t>(writes.size()),
                                     writes.data(), 0, nullptr);
}

std::vector<HostPass> VulkanBackend::host_passes_for(const gpu::RenderPipelineDesc& desc) const {
    if (!desc.targets.empty() || !desc.depth_stencil) {
        return {};
    }
    return host_passes_.of(desc.depth_stencil->format, desc.sample_count);
}

Status VulkanBackend::create_render_pipeline(gpu::RenderPipelineId id,
                                             const gpu::RenderPipelineDesc& desc) {
    PipelineParts parts;
    parts.vertex = resources_.shaders[desc.vertex];
    if (desc.fragment) {
        parts.fragment = resources_.shaders[desc.fragment];
    }
    for (const gpu::BindGroupLayoutId layout : desc.bind_group_layouts) {
        parts.set_layouts.push_back(resources_.bind_group_layouts[layout].handle);
    }
    Result<Pipeline> pipeline = pipeline_maker_.make(desc, parts, host_passes_for(desc));
    if (!pipeline) {
        return forward_error(pipeline);
    }
    resources_.pipelines.insert(id, std::move(*pipeline));
    return {};
}

Status VulkanBackend::create_query_set(gpu::QuerySetId id, const gpu::QuerySetDesc& desc) {
    QuerySet queries;
    queries.subject = fmt::format("query set '{}'", desc.label);
    queries.type = desc.type;
    queries.written.resize(desc.count);
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType =
        desc.type == gpu::QueryType::Occlusion ? VK_QUERY_TYPE_OCCLUSION : VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = desc.count;
    if (const VkResult result =
            device_->fn.CreateQueryPool(device_->handle, &info, nullptr, &queries.pool);
        result != VK_SUCCESS) {
        return failure(result, "vkCreateQueryPool", queries.subject);
    }
    device_->set_name(VK_OBJECT_TYPE_QUERY_POOL, queries.pool, desc.label);
    resources_.query_sets.insert(id, std::move(queries));
    return {};
}

template <class Object>
void VulkanBackend::destroy_later(Object object) {
    look_at_host();
    queue_.defer([this, object = std::move(object)]() mutable { destroy_now(object); });
}

void VulkanBackend::destroy(gpu::BufferId id) { destroy_later(resources_.buffers.take(id)); }

void VulkanBackend::destroy(gpu::TextureId id) {
    look_at_host();
    Texture texture = resources_.textures.take(id);
    host_passes_.remove(texture.host_pass_kind);
    render_passes_.forget(texture.attachment);
    destroy_later(std::move(texture));
}

void VulkanBackend::destroy(gpu::SamplerId id) { destroy_later(resources_.samplers.take(id)); }

void VulkanBackend::destroy(gpu::ShaderId id) { destroy_later(resources_.shaders.take(id)); }

void VulkanBackend::destroy(gpu::BindGroupLayoutId id) {
    destroy_later(resources_.bind_group_layouts.take(id));
}

void VulkanBackend::destroy(gpu::BindGroupId id) { destroy_later(resources_.bind_groups.take(id)); }

void VulkanBackend::destroy(gpu::RenderPipelineId id) {
    destroy_later(resources_.pipelines.take(id));
}

void VulkanBackend::destroy(gpu::QuerySetId id) { destroy_later(resources_.query_sets.take(id)); }

void VulkanBackend::destroy_now(Buffer& buffer) { free_buffer(*device_, memory_, buffer); }

void VulkanBackend::destroy_now(Texture& texture) { free_texture(*device_, memory_, texture); }

void VulkanBackend::destroy_now(VkSampler& sampler) {
    device_->fn.DestroySampler(device_->handle, sampler, nullptr);
}

void VulkanBackend::destroy_now(VkShaderModule& shader) {
    device_->fn.DestroyShaderModule(device_->handle, shader, nullptr);
}

void VulkanBackend::destroy_now(BindGroupLayout& layout) {
    device_->fn.DestroyDescriptorSetLayout(device_->handle, layout.handle, nullptr);
}

void VulkanBackend::destroy_now(BindGroup& group) { descriptor_pools_.free(group.set); }

void VulkanBackend::destroy_now(Pipeline& pipeline) { pipeline_maker_.free(pipeline); }

void VulkanBackend::destroy_now(QuerySet& queries) {
    device_->fn.DestroyQueryPool(device_->handle, queries.pool, nullptr);
}

}  // namespace gnomon::vk
