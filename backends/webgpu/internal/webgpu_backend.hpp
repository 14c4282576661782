// SPDX-License-Identifier: MIT
//
// gpu::Backend in front of a bridge.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <gnomon/gpu/backend.hpp>
#include <gnomon/webgpu/backend.hpp>

#include "bridge.hpp"

namespace gnomon::webgpu {

/// create_backend() with any bridge.
[[nodiscard]] Result<std::unique_ptr<gpu::Backend>> create_backend_on(
    std::unique_ptr<Bridge> bridge, const BackendOptions& options);

class WebGpuBackend final : public gpu::Backend {
public:
    WebGpuBackend(std::unique_ptr<Bridge> bridge, gpu::Caps caps, gpu::MessageSink sink);

    [[nodiscard]] const gpu::Caps& caps() const override { return caps_; }

    Status create_buffer(gpu::BufferId id, const gpu::BufferDesc& desc) override;
    Status create_texture(gpu::TextureId id, const gpu::TextureDesc& desc) override;
    Status import_texture(gpu::TextureId id, const gpu::TextureDesc& desc,
                          const gpu::NativeTexture& native) override;
    Status create_sampler(gpu::SamplerId id, const gpu::SamplerDesc& desc) override;
    Status create_shader(gpu::ShaderId id, const gpu::ShaderDesc& desc) override;
    Status create_bind_group_layout(gpu::BindGroupLayoutId id,
                                    const gpu::BindGroupLayoutDesc& desc) override;
    Status create_bind_group(gpu::BindGroupId id, const gpu::BindGroupDesc& desc) override;
    Status create_render_pipeline(gpu::RenderPipelineId id,
                                  const gpu::RenderPipelineDesc& desc) override;
    Status create_query_set(gpu::QuerySetId id, const gpu::QuerySetDesc& desc) override;

    void destroy(gpu::BufferId id) override { bridge_->destroy(Kind::Buffer, id.index); }
    void destroy(gpu::TextureId id) override { bridge_->destroy(Kind::Texture, id.index); }
    void destroy(gpu::SamplerId id) override { bridge_->destroy(Kind::Sampler, id.index); }
    void destroy(gpu::ShaderId id) override { bridge_->destroy(Kind::Shader, id.index); }
    void destroy(gpu::BindGroupLayoutId id) override {
        bridge_->destroy(Kind::BindGroupLayout, id.index);
    }
    void destroy(gpu::BindGroupId id) override { bridge_->destroy(Kind::BindGroup, id.index); }
    void destroy(gpu::RenderPipelineId id) override {
        bridge_->destroy(Kind::RenderPipeline, id.index);
    }
    void destroy(gpu::QuerySetId id) override { bridge_->destroy(Kind::QuerySet, id.index); }

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
    Status status_of(Outcome outcome);
    /// The same, after which what the device complained of meanwhile goes to the sink.
    Status status_and_messages(Outcome outcome);

    std::unique_ptr<Bridge> bridge_;
    gpu::Caps caps_;
    gpu::MessageSink sink_;
    // By Id::index; a bind group is described with its layout, a query set read with its size.
    std::vector<gpu::BindGroupLayoutDesc> layouts_;
    std::vector<std::uint32_t> query_counts_;
    std::vector<std::uint32_t> words_;
};

}  // namespace gnomon::webgpu
