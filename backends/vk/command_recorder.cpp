// SPDX-License-Identifier: MIT
//
// The visit over the commands; what passes need before they begin is in
// command_recorder_passes.cpp.
#include "internal/command_recorder.hpp"

#include "internal/conv.hpp"

namespace gnomon::vk {

Status CommandRecorder::record(const gpu::CommandBuffer& source) {
    const std::span<const gpu::Command> commands = source.commands;
    begin_label(source.label);
    Status status;
    for (std::size_t i = 0; status && i < commands.size(); ++i) {
        std::visit(
            [&](const auto& command) {
                using Type = std::decay_t<decltype(command)>;
                if constexpr (std::is_same_v<Type, gpu::cmd::BeginRenderPass>) {
                    status = begin_pass(source.passes[command.pass], commands.subspan(i + 1));
                } else if constexpr (std::is_same_v<Type, gpu::cmd::EndRenderPass>) {
                    end_pass();
                } else if constexpr (std::is_same_v<Type, gpu::cmd::PushDebugGroup>) {
                    begin_label(source.strings[command.label]);
                } else if constexpr (std::is_same_v<Type, gpu::cmd::PopDebugGroup>) {
                    end_label();
                } else {
                    visit(command);
                }
            },
            commands[i]);
    }
    end_label();
    return status;
}

void CommandRecorder::visit(const gpu::cmd::SetPipeline& command) {
    const Pipeline& next = resources_.pipelines[command.pipeline];
    device_.fn.CmdBindPipeline(out_, VK_PIPELINE_BIND_POINT_GRAPHICS,
                               host_pass_ != 0 ? next.in_host_pass(host_pass_) : next.handle);
    // Vulkan keeps bound sets only up to the first slot whose layout differs.
    std::size_t same = 0;
    if (pipeline_ != nullptr) {
        const auto& before = pipeline_->bind_group_layouts;
        while (same < before.size() && same < next.bind_group_layouts.size() &&
               before[same] == next.bind_group_layouts[same]) {
            ++same;
        }
    }
    for (std::size_t slot = same; slot < groups_.size(); ++slot) {
        groups_[slot].stale = groups_[slot].set;
    }
    pipeline_ = &next;
}

void CommandRecorder::visit(const gpu::cmd::SetBindGroup& command) {
    groups_[command.group] = {command, true, true};
}

void CommandRecorder::bind_stale_groups() {
    const std::size_t used = pipeline_->bind_group_layouts.size();
    for (std::size_t slot = 0; slot < used; ++slot) {
        BoundGroup& group = groups_[slot];
        if (!group.stale) {
            continue;
        }
        device_.fn.CmdBindDescriptorSets(
            out_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_->layout,
            static_cast<std::uint32_t>(slot), 1,
            &resources_.bind_groups[group.command.bind_group].set.handle,
            group.command.dynamic_offset_count, group.command.dynamic_offsets.data());
        group.stale = false;
    }
}

void CommandRecorder::visit(const gpu::cmd::SetVertexBuffer& command) {
    const Buffer& buffer = resources_.buffers[command.buffer];
    // Vulkan has no binding that starts at the buffer's end; valid draws read nothing from it.
    const VkDeviceSize offset = command.offset < buffer.size ? command.offset : 0;
    device_.fn.CmdBindVertexBuffers(out_, command.slot, 1, &buffer.handle, &offset);
}

void CommandRecorder::visit(const gpu::cmd::SetIndexBuffer& command) {
    const Buffer& buffer = resources_.buffers[command.buffer];
    const VkDeviceSize offset = command.offset < buffer.size ? command.offset : 0;
    device_.fn.CmdBindIndexBuffer(out_, buffer.handle, offset, to_vk(command.format));
}

void CommandRecorder::visit(const gpu::cmd::SetStencilReference& command) {
    device_.fn.CmdSetStencilReference(out_, VK_STENCIL_FACE_FRONT_AND_BACK, command.reference);
}

void CommandRecorder::visit(const gpu::cmd::SetBlendConstant& command) {
    const std::array<float, 4> constants{
        static_cast<float>(command.color.r), static_cast<float>(command.color.g),
        static_cast<float>(command.color.b), static_cast<float>(command.color.a)};
    device_.fn.CmdSetBlendConstants(out_, constants.data());
}

void CommandRecorder::visit(const gpu::cmd::SetViewport& command) {
    // Either draws the same, but mirrored triangles meet the clip planes in another order: a
    // viewport of negative height makes other last bits than OpenGL.
    const bool by_viewport = device_.y_up == YUp::Viewport;
    const VkViewport viewport{
        command.x,         by_viewport ? command.y + command.height : command.y,
        command.width,     by_viewport ? -command.height : command.height,
        command.min_depth, command.max_depth};
    device_.fn.CmdSetViewport(out_, 0, 1, &viewport);
}

void CommandRecorder::visit(const gpu::cmd::SetScissorRect& command) {
    const VkRect2D scissor{
        {static_cast<std::int32_t>(command.x), static_cast<std::int32_t>(command.y)},
        {command.width, command.height}};
    device_.fn.CmdSetScissor(out_, 0, 1, &scissor);
}

void CommandRecorder::visit(const gpu::cmd::SetDepthBounds& command) {
    device_.fn.CmdSetDepthBounds(out_, command.min, command.max);
}

void CommandRecorder::visit(const gpu::cmd::Draw& command) {
    bind_stale_groups();
    device_.fn.CmdDraw(out_, command.vertex_count, command.instance_count, command.first_vertex,
                       command.first_instance);
}

void CommandRecorder::visit(const gpu::cmd::DrawIndexed& command) {
    bind_stale_groups();
    device_.fn.CmdDrawIndexed(out_, command.index_count, command.instance_count,
                              command.first_index, command.base_vertex, command.first_instance);
}

void CommandRecorder::visit(const gpu::cmd::BeginOcclusionQuery& command) {
    QuerySet& queries = resources_.query_sets[pass_->occlusion_query_set];
    device_.fn.CmdBeginQuery(out_, queries.pool, command.index, VK_QUERY_CONTROL_PRECISE_BIT);
    open_query_ = command.index;
}

void CommandRecorder::visit(const gpu::cmd::EndOcclusionQuery&) {
    QuerySet& queries = resources_.query_sets[pass_->occlusion_query_set];
    device_.fn.CmdEndQuery(out_, queries.pool, open_query_);
    queries.written[open_query_] = true;
}

void CommandRecorder::visit(const gpu::cmd::CopyBufferToBuffer& command) {
    if (command.size == 0) {
        return;
    }
    Buffer& source = resources_.buffers[command.source];
    Buffer& destination = resources_.buffers[command.destination];
    note_read(source);
    note_read(destination);
    define_contents(device_, out_, source);
    define_contents(device_, out_, destination);
    BarrierBatch barriers;
    use_buffer(source, Usage::CopySource, barriers);
    barriers.flush(device_.fn, out_);
    use_as_copy_destination(device_, out_, destination, command.destination_offset, command.size);
    const VkBufferCopy region{command.source_offset, command.destination_offset, command.size};
    device_.fn.CmdCopyBuffer(out_, source.handle, destination.handle, 1, &region);
}

void CommandRecorder::begin_label(const std::string& label) {
    if (device_.instance->fn.CmdBeginDebugUtilsLabelEXT == nullptr) {
        return;
    }
    VkDebugUtilsLabelEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT;
    info.pLabelName = label.c_str();
    device_.instance->fn.CmdBeginDebugUtilsLabelEXT(out_, &info);
}

void CommandRecorder::end_label() {
    if (device_.instance->fn.CmdEndDebugUtilsLabelEXT != nullptr) {
        device_.instance->fn.CmdEndDebugUtilsLabelEXT(out_);
    }
}

}  // namespace gnomon::vk
