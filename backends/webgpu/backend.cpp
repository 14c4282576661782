// SPDX-License-Identifier: MIT
#include <gnomon/webgpu/backend.hpp>

#include <utility>

#include <fmt/format.h>

#include "internal/adapter.hpp"
#include "internal/command_words.hpp"
#include "internal/objects.hpp"
#include "internal/webgpu_backend.hpp"

namespace gnomon::webgpu {

namespace {

template <class Value>
void keep(std::vector<Value>& table, std::uint32_t index, Value value) {
    if (index >= table.size()) table.resize(std::size_t{index} + 1);
    table[index] = std::move(value);
}

ErrorCode code_of(Outcome outcome) {
    switch (outcome) {
        case Outcome::Unsupported: return ErrorCode::Unsupported;
        case Outcome::OutOfMemory: return ErrorCode::OutOfMemory;
        case Outcome::DeviceLost: return ErrorCode::DeviceLost;
        case Outcome::Done:
        case Outcome::Internal: break;
    }
    return ErrorCode::Internal;
}

}  // namespace

Result<std::unique_ptr<gpu::Backend>> create_backend_on(std::unique_ptr<Bridge> bridge,
                                                        const BackendOptions& options) {
    Result<gpu::Caps> caps = read_caps(bridge->describe(), options.disabled_features);
    if (!caps) return forward_error(caps);
    return std::make_unique<WebGpuBackend>(std::move(bridge), std::move(*caps),
                                           options.message_sink);
}

WebGpuBackend::WebGpuBackend(std::unique_ptr<Bridge> bridge, gpu::Caps caps, gpu::MessageSink sink)
    : bridge_(std::move(bridge)), caps_(std::move(caps)), sink_(std::move(sink)) {}

Status WebGpuBackend::status_of(Outcome outcome) {
    if (outcome == Outcome::Done) return {};
    return fail(code_of(outcome), bridge_->error());
}

Status WebGpuBackend::status_and_messages(Outcome outcome) {
    Status status = status_of(outcome);
    for (std::string message = bridge_->take_message(); !message.empty();
         message = bridge_->take_message()) {
        if (sink_) sink_(gpu::Severity::Error, message);
    }
    return status;
}

Status WebGpuBackend::create_buffer(gpu::BufferId id, const gpu::BufferDesc& desc) {
    return status_of(bridge_->create(Kind::Buffer, id.index, describe(desc)));
}

Status WebGpuBackend::create_texture(gpu::TextureId id, const gpu::TextureDesc& desc) {
    return status_of(bridge_->create(Kind::Texture, id.index, describe(desc)));
}

Status WebGpuBackend::import_texture(gpu::TextureId id, const gpu::TextureDesc& desc,
                                     const gpu::NativeTexture& native) {
    const auto* host = std::any_cast<HostTexture>(&native);
    if (host == nullptr) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("[Texture \"{}\"] cannot be imported: what WebGPU imports is a "
                                "webgpu::HostTexture.",
                                desc.label));
    }
    return status_of(bridge_->create(Kind::Texture, id.index, describe(desc, host->number)));
}

Status WebGpuBackend::create_sampler(gpu::SamplerId id, const gpu::SamplerDesc& desc) {
    return status_of(bridge_->create(Kind::Sampler, id.index, describe(desc)));
}

Status WebGpuBackend::create_shader(gpu::ShaderId id, const gpu::ShaderDesc& desc) {
    return status_of(bridge_->create(Kind::Shader, id.index, describe(desc)));
}

Status WebGpuBackend::create_bind_group_layout(gpu::BindGroupLayoutId id,
                                               const gpu::BindGroupLayoutDesc& desc) {
    keep(layouts_, id.index, desc);
    return status_of(bridge_->create(Kind::BindGroupLayout, id.index, describe(desc)));
}

Status WebGpuBackend::create_bind_group(gpu::BindGroupId id, const gpu::BindGroupDesc& desc) {
    return status_of(
        bridge_->create(Kind::BindGroup, id.index, describe(desc, layouts_[desc.layout.index])));
}

Status WebGpuBackend::create_render_pipeline(gpu::RenderPipelineId id,
                                             const gpu::RenderPipelineDesc& desc) {
    return status_of(bridge_->create(Kind::RenderPipeline, id.index, describe(desc)));
}

Status WebGpuBackend::create_query_set(gpu::QuerySetId id, const gpu::QuerySetDesc& desc) {
    keep(query_counts_, id.index, desc.count);
    return status_of(bridge_->create(Kind::QuerySet, id.index, describe(desc)));
}

Status WebGpuBackend::write_buffer(gpu::BufferId id, std::uint64_t offset,
                                   std::span<const std::byte> bytes) {
    return status_of(bridge_->write_buffer(id.index, offset, bytes));
}

Status WebGpuBackend::write_texture(gpu::TextureId id, std::uint32_t mip_level,
                                    std::span<const std::byte> bytes) {
    return status_of(bridge_->write_texture(id.index, mip_level, bytes));
}

Status WebGpuBackend::submit(const gpu::CommandBuffer& commands) {
    write_words(commands, words_);
    return status_and_messages(bridge_->submit(words_));
}

Status WebGpuBackend::wait_idle() { return status_and_messages(bridge_->wait_idle()); }

Status WebGpuBackend::read_buffer(gpu::BufferId id, std::uint64_t offset,
                                  std::span<std::byte> bytes) {
    return status_and_messages(bridge_->read_buffer(id.index, offset, bytes));
}

Status WebGpuBackend::read_texture(gpu::TextureId id, gpu::Aspect aspect,
                                   std::span<std::byte> bytes) {
    return status_and_messages(bridge_->read_texture(id.index, aspect, bytes));
}

Result<std::vector<std::uint64_t>> WebGpuBackend::read_query_set(gpu::QuerySetId id) {
    std::vector<std::uint64_t> values(query_counts_[id.index]);
    const Status read = status_and_messages(bridge_->read_query_set(id.index, values));
    if (!read) return forward_error(read);
    return values;
}

Status WebGpuBackend::present(gpu::TextureId id) {
    return status_and_messages(bridge_->present(id.index));
}

}  // namespace gnomon::webgpu
