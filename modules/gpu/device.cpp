// SPDX-License-Identifier: MIT
#include <utility>
#include <variant>

#include <gnomon/core/expects.hpp>
#include <gnomon/gpu/device.hpp>

#include "internal/device_state.hpp"
#include "internal/validate_bind_groups.hpp"
#include "internal/validate_commands.hpp"
#include "internal/validate_descriptors.hpp"
#include "internal/validate_pipelines.hpp"
#include "internal/validate_transfers.hpp"

namespace gnomon::gpu {

namespace {

/// The one way in which objects are made: validate, name, hand to the backend. `make` is the
/// backend's function.
template <class Tag, class Desc, class... More>
Result<Owned<Tag>> create(const std::shared_ptr<DeviceState>& state, const Desc& desc,
                          Status (Backend::*make)(Id<Tag>, const Desc&, const More&...),
                          const More&... more) {
    auto record = validate(*state, desc);
    if (!record) {
        return in_frame(record, fmt::format("While creating {}.",
                                            object_name(ObjectKind<Tag>::name, desc.label)));
    }
    const Id<Tag> id = state->table<Tag>().insert(desc.label, std::move(*record));
    if (const Status made = (state->backend().*make)(id, desc, more...); !made) {
        state->table<Tag>().erase(id);
        return forward_error(made);
    }
    return Owned<Tag>(state, id);
}

}  // namespace

Device::Device(std::unique_ptr<Backend> backend)
    : state_(std::make_shared<DeviceState>(std::move(backend))) {}
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;
Device::~Device() = default;

Result<Buffer> Device::create_buffer(const BufferDesc& desc) {
    return create(state_, desc, &Backend::create_buffer);
}

Result<Texture> Device::create_texture(const TextureDesc& desc) {
    return create(state_, desc, &Backend::create_texture);
}

Result<Texture> Device::import_texture(const TextureDesc& desc, const NativeTexture& native) {
    return create(state_, desc, &Backend::import_texture, native);
}

Result<Sampler> Device::create_sampler(const SamplerDesc& desc) {
    return create(state_, desc, &Backend::create_sampler);
}

Result<Shader> Device::create_shader(const ShaderDesc& desc) {
    return create(state_, desc, &Backend::create_shader);
}

Result<BindGroupLayout> Device::create_bind_group_layout(const BindGroupLayoutDesc& desc) {
    return create(state_, desc, &Backend::create_bind_group_layout);
}

Result<BindGroup> Device::create_bind_group(const BindGroupDesc& desc) {
    return create(state_, desc, &Backend::create_bind_group);
}

Result<RenderPipeline> Device::create_render_pipeline(const RenderPipelineDesc& desc) {
    return create(state_, desc, &Backend::create_render_pipeline);
}

Result<QuerySet> Device::create_query_set(const QuerySetDesc& desc) {
    return create(state_, desc, &Backend::create_query_set);
}

Status Device::write_buffer(BufferId buffer, std::uint64_t offset,
                            std::span<const std::byte> data) {
    if (const Status s = validate_write_buffer(*state_, buffer, offset, data.size()); !s) {
        return in_frame(s, fmt::format("While writing {}.", state_->name(buffer)));
    }
    if (data.empty()) return {};
    const Status written = state_->backend().write_buffer(buffer, offset, data);
    if (written) state_->counters.uploaded_bytes += data.size();
    return written;
}

Status Device::write_texture(TextureId texture, std::uint32_t mip_level,
                             std::span<const std::byte> data) {
    if (const Status s = validate_write_texture(*state_, texture, mip_level, data.size()); !s) {
        return in_frame(s, fmt::format("While writing {}.", state_->name(texture)));
    }
    const Status written = state_->backend().write_texture(texture, mip_level, data);
    if (written) state_->counters.uploaded_bytes += data.size();
    return written;
}

CommandEncoder Device::create_command_encoder(std::string label) {
    return CommandEncoder(state_, std::move(label));
}

Status Device::submit(const CommandBuffer& commands) {
    if (const Status s = validate_submit(*state_, commands); !s) {
        return in_frame(
            s, fmt::format("While submitting {}.", object_name("CommandBuffer", commands.label)));
    }
    const Status submitted = state_->backend().submit(commands);
    if (!submitted) return submitted;
    DeviceCounters& counters = state_->counters;
    ++counters.submissions;
    counters.render_passes += commands.passes.size();
    for (const Command& command : commands.commands) {
        if (std::holds_alternative<cmd::Draw>(command) ||
            std::holds_alternative<cmd::DrawIndexed>(command)) {
            ++counters.draw_calls;
        }
    }
    return {};
}

Status Device::wait_idle() { return state_->backend().wait_idle(); }

Result<std::vector<std::byte>> Device::read_buffer(BufferId buffer, std::uint64_t offset,
                                                   std::uint64_t size) {
    if (const Status s = validate_read_buffer(*state_, buffer, offset, size); !s) {
        return in_frame(s, fmt::format("While reading {}.", state_->name(buffer)));
    }
    std::vector<std::byte> data(size);
    if (data.empty()) return data;
    if (const Status s = state_->backend().read_buffer(buffer, offset, data); !s) {
        return forward_error(s);
    }
    return data;
}

Result<std::vector<std::byte>> Device::read_texture(TextureId texture, Aspect aspect) {
    const Result<std::uint64_t> size = validate_read_texture(*state_, texture, aspect);
    if (!size) return in_frame(size, fmt::format("While reading {}.", state_->name(texture)));
    std::vector<std::byte> data(*size);
    if (const Status s = state_->backend().read_texture(texture, aspect, data); !s) {
        return forward_error(s);
    }
    return data;
}

Result<std::vector<std::uint64_t>> Device::read_query_set(QuerySetId query_set) {
    if (state_->find(query_set) == nullptr) {
        return invalid("{} While reading {}.", state_->absence(query_set), state_->name(query_set));
    }
    return state_->backend().read_query_set(query_set);
}

Status Device::present(TextureId texture) {
    if (const Status s = validate_present(*state_, texture); !s) {
        return in_frame(s, fmt::format("While presenting {}.", state_->name(texture)));
    }
    return state_->backend().present(texture);
}

std::optional<TextureDesc> Device::desc_of(TextureId texture) const {
    const TextureDesc* desc = state_->find(texture);
    return desc != nullptr ? std::optional(*desc) : std::nullopt;
}

ClipDepth Device::clip_depth_of(TextureId texture) const {
    GNOMON_EXPECTS(state_->find(texture) != nullptr);
    return state_->backend().clip_depth(texture);
}

Status Device::takes_colors_beside(TextureId depth_stencil) const {
    GNOMON_EXPECTS(state_->find(depth_stencil) != nullptr);
    return state_->backend().takes_colors_beside(depth_stencil);
}

const Caps& Device::caps() const { return state_->caps(); }

DeviceCounters Device::counters() const {
    DeviceCounters counters = state_->counters;
    counters.objects_alive = state_->objects_alive();
    return counters;
}

}  // namespace gnomon::gpu
