// SPDX-License-Identifier: MIT
//
// gpu::Backend on Vulkan: keeps the tables and hands each call to the part that does it.
#pragma once

#include <memory>
#include <vector>

#include <gnomon/gpu/backend.hpp>

#include "internal/command_recorder.hpp"
#include "internal/swapchain.hpp"
#include "internal/transfers.hpp"

namespace gnomon::vk {

class VulkanBackend final : public gpu::Backend {
public:
    /// `commands`: of an adopted device, or null.
    explicit VulkanBackend(std::unique_ptr<Device> device,
                           std::shared_ptr<HostCommands> commands = nullptr);
    ~VulkanBackend() override;
    VulkanBackend(const VulkanBackend&) = delete;
    VulkanBackend& operator=(const VulkanBackend&) = delete;
    [[nodiscard]] Status initialise(const BackendOptions& options);

    [[nodiscard]] const gpu::Caps& caps() const override { return device_->adapter.caps; }

    Status create_buffer(gpu::BufferId id, const gpu::BufferDesc& desc) override;
    Status create_texture(gpu::TextureId id, const gpu::TextureDesc& desc) override;
    Status import_texture(gpu::TextureId id, const gpu::TextureDesc& desc,
                          const gpu::NativeTexture& native) override;
    [[nodiscard]] Status takes_colors_beside(gpu::TextureId id) const override {
        return gnomon::vk::takes_colors_beside(resources_.textures[id]);
    }
    Status create_sampler(gpu::SamplerId id, const gpu::SamplerDesc& desc) override;
    Status create_shader(gpu::ShaderId id, const gpu::ShaderDesc& desc) override;
    Status create_bind_group_layout(gpu::BindGroupLayoutId id,
                                    const gpu::BindGroupLayoutDesc& desc) override;
    Status create_bind_group(gpu::BindGroupId id, const gpu::BindGroupDesc& desc) override;
    Status create_render_pipeline(gpu::RenderPipelineId id,
                                  const gpu::RenderPipelineDesc& desc) override;
    Status create_query_set(gpu::QuerySetId id, const gpu::QuerySetDesc& desc) override;

    void destroy(gpu::BufferId id) override;
    void destroy(gpu::TextureId id) override;
    void destroy(gpu::SamplerId id) override;
    void destroy(gpu::ShaderId id) override;
    void destroy(gpu::BindGroupLayoutId id) override;
    void destroy(gpu::BindGroupId id) override;
    void destroy(gpu::RenderPipelineId id) override;
    void destroy(gpu::QuerySetId id) override;

    Status write_buffer(gpu::BufferId id, std::uint64_t offset,
                        std::span<const std::byte> bytes) override;
    Status write_texture(gpu::TextureId id, std::uint32_t mip_level,
                         std::span<const std::byte> bytes) override;
    Status submit(const gpu::CommandBuffer& commands) override;
    Status wait_idle() override;
    Status read_buffer(gpu::BufferId id, std::uint64_t offset, std::span<std::byte> bytes) override;
    Status read_texture(gpu::TextureId id, gpu::Aspect aspect, std::span<std::byte> bytes) override;
    Result<std::vector<std::uint64_t>> read_query_set(gpu::QuerySetId id) override;
    Status present(gpu::TextureId id) override;

private:
    // The tear-down of one object, once nothing uses it.
    void destroy_now(Buffer& buffer);
    void destroy_now(Texture& texture);
    void destroy_now(VkSampler& sampler);
    void destroy_now(VkShaderModule& shader);
    void destroy_now(BindGroupLayout& layout);
    void destroy_now(BindGroup& group);
    void destroy_now(Pipeline& pipeline);
    void destroy_now(QuerySet& queries);
    template <class Object>
    void destroy_later(Object object);
    /// Those that a pipeline may come to be used in.
    [[nodiscard]] std::vector<HostPass> host_passes_for(const gpu::RenderPipelineDesc& desc) const;
    /// Looks whether the host has another command buffer now; before whatever depends on that.
    void look_at_host();
    /// That a write to a buffer or texture does not change what the host's command buffer reads.
    template <class Object>
    [[nodiscard]] Status check_write(const Object& object);
    void write_descriptors(const BindGroup& group, const BindGroupLayout& layout,
                           const gpu::BindGroupDesc& desc);

    // In the order in which each needs those before it.
    std::unique_ptr<Device> device_;
    std::shared_ptr<HostCommands> host_commands_;
    Memory memory_;
    DescriptorPools descriptor_pools_;
    Queue queue_;
    Transfers transfers_;
    RenderPasses render_passes_;
    PipelineMaker pipeline_maker_;
    Resources resources_;
    HostPasses host_passes_;          ///< of textures that a HostRenderPass is for
    void* host_buffer_ = nullptr;     ///< the host's command buffer when it was looked at last
    std::uint64_t host_buffers_ = 0;  ///< how often it had been set then, which names it
    VkSampler nearest_sampler_ = VK_NULL_HANDLE;  ///< for textures that are only fetched
    std::unique_ptr<Swapchain> swapchain_;
};

}  // namespace gnomon::vk
