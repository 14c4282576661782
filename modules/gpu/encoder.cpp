// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include <gnomon/core/expects.hpp>
#include <gnomon/gpu/encoder.hpp>

#include "internal/device_state.hpp"
#include "internal/recording.hpp"
#include "internal/validate_commands.hpp"

namespace gnomon::gpu {

namespace {

std::uint32_t add_string(CommandBuffer& buffer, std::string_view text) {
    buffer.strings.emplace_back(text);
    return static_cast<std::uint32_t>(buffer.strings.size() - 1);
}

std::shared_ptr<Recording> make_recording(std::string label) {
    auto recording = std::make_shared<Recording>();
    recording->buffer.label = std::move(label);
    return recording;
}

}  // namespace

RenderPassEncoder::RenderPassEncoder(std::shared_ptr<Recording> recording, std::uint32_t pass)
    : recording_(std::move(recording)), pass_(pass) {}

RenderPassEncoder::RenderPassEncoder(RenderPassEncoder&& other) noexcept = default;

RenderPassEncoder::~RenderPassEncoder() {
    if (recording_ != nullptr && !ended_) end();
}

template <class Cmd>
void RenderPassEncoder::record(const char* function, const Cmd& command) {
    GNOMON_EXPECTS(recording_ != nullptr);
    CommandBuffer& buffer = recording_->buffer;
    if (!ended_) {
        buffer.commands.emplace_back(command);
    } else if (pass_ < buffer.passes.size()) {
        recording_->misuse.push_back(
            fmt::format("{} was called on {} after its end.", function,
                        object_name("RenderPass", buffer.passes[pass_].label)));
    }
}

void RenderPassEncoder::set_pipeline(RenderPipelineId pipeline) {
    record("set_pipeline", cmd::SetPipeline{pipeline});
}

void RenderPassEncoder::set_bind_group(std::uint32_t group, BindGroupId bind_group,
                                       std::span<const std::uint32_t> dynamic_offsets) {
    cmd::SetBindGroup command{
        group, bind_group, static_cast<std::uint32_t>(dynamic_offsets.size()), {}};
    // What does not fit is left out here and found by its count at finish().
    const std::size_t kept = std::min<std::size_t>(dynamic_offsets.size(), max_dynamic_offsets);
    std::copy_n(dynamic_offsets.begin(), kept, command.dynamic_offsets.begin());
    record("set_bind_group", command);
}

void RenderPassEncoder::set_vertex_buffer(std::uint32_t slot, BufferId buffer,
                                          std::uint64_t offset) {
    record("set_vertex_buffer", cmd::SetVertexBuffer{slot, buffer, offset});
}

void RenderPassEncoder::set_index_buffer(BufferId buffer, IndexFormat format,
                                         std::uint64_t offset) {
    record("set_index_buffer", cmd::SetIndexBuffer{buffer, format, offset});
}

void RenderPassEncoder::set_stencil_reference(std::uint32_t reference) {
    record("set_stencil_reference", cmd::SetStencilReference{reference});
}

void RenderPassEncoder::set_blend_constant(Color color) {
    record("set_blend_constant", cmd::SetBlendConstant{color});
}

void RenderPassEncoder::set_viewport(float x, float y, float width, float height, float min_depth,
                                     float max_depth) {
    record("set_viewport", cmd::SetViewport{x, y, width, height, min_depth, max_depth});
}

void RenderPassEncoder::set_scissor_rect(std::uint32_t x, std::uint32_t y, std::uint32_t width,
                                         std::uint32_t height) {
    record("set_scissor_rect", cmd::SetScissorRect{x, y, width, height});
}

void RenderPassEncoder::set_depth_bounds(float min, float max) {
    record("set_depth_bounds", cmd::SetDepthBounds{min, max});
}

void RenderPassEncoder::draw(std::uint32_t vertex_count, std::uint32_t instance_count,
                             std::uint32_t first_vertex, std::uint32_t first_instance) {
    record("draw", cmd::Draw{vertex_count, instance_count, first_vertex, first_instance});
}

void RenderPassEncoder::draw_indexed(std::uint32_t index_count, std::uint32_t instance_count,
                                     std::uint32_t first_index, std::int32_t base_vertex,
                                     std::uint32_t first_instance) {
    record("draw_indexed",
           cmd::DrawIndexed{index_count, instance_count, first_index, base_vertex, first_instance});
}

void RenderPassEncoder::begin_occlusion_query(std::uint32_t index) {
    record("begin_occlusion_query", cmd::BeginOcclusionQuery{index});
}

void RenderPassEncoder::end_occlusion_query() {
    record("end_occlusion_query", cmd::EndOcclusionQuery{});
}

void RenderPassEncoder::push_debug_group(std::string_view label) {
    record("push_debug_group", cmd::PushDebugGroup{add_string(recording_->buffer, label)});
}

void RenderPassEncoder::pop_debug_group() { record("pop_debug_group", cmd::PopDebugGroup{}); }

void RenderPassEncoder::end() {
    record("end", cmd::EndRenderPass{});
    ended_ = true;
}

CommandEncoder::CommandEncoder(std::weak_ptr<DeviceState> device, std::string label)
    : device_(std::move(device)), recording_(make_recording(std::move(label))) {}

RenderPassEncoder CommandEncoder::begin_render_pass(RenderPassDesc desc) {
    CommandBuffer& buffer = recording_->buffer;
    if (const auto device = device_.lock(); device != nullptr && buffer.commands.empty()) {
        buffer.commands.reserve(device->commands_before);
    }
    const auto pass = static_cast<std::uint32_t>(buffer.passes.size());
    buffer.passes.push_back(std::move(desc));
    buffer.commands.emplace_back(cmd::BeginRenderPass{pass});
    return RenderPassEncoder(recording_, pass);
}

void CommandEncoder::copy_buffer_to_buffer(BufferId source, std::uint64_t source_offset,
                                           BufferId destination, std::uint64_t destination_offset,
                                           std::uint64_t size) {
    recording_->buffer.commands.emplace_back(
        cmd::CopyBufferToBuffer{source, source_offset, destination, destination_offset, size});
}

void CommandEncoder::push_debug_group(std::string_view label) {
    CommandBuffer& buffer = recording_->buffer;
    buffer.commands.emplace_back(cmd::PushDebugGroup{add_string(buffer, label)});
}

void CommandEncoder::pop_debug_group() {
    recording_->buffer.commands.emplace_back(cmd::PopDebugGroup{});
}

Result<CommandBuffer> CommandEncoder::finish() {
    const std::shared_ptr<Recording> recording =
        std::exchange(recording_, make_recording(recording_->buffer.label));
    const std::shared_ptr<DeviceState> device = device_.lock();
    if (device == nullptr) {
        return invalid("The device of {} is gone.",
                       object_name("CommandBuffer", recording->buffer.label));
    }
    device->commands_before = recording->buffer.commands.size();
    if (const Status s = validate_commands(*device, recording->buffer, recording->misuse); !s) {
        return forward_error(s);
    }
    return std::move(recording->buffer);
}

}  // namespace gnomon::gpu
