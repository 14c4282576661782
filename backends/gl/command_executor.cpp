// SPDX-License-Identifier: MIT
#include "internal/command_executor.hpp"

#include <fmt/format.h>

#include <utility>

#include "internal/debug_output.hpp"
#include "internal/host_target.hpp"
#include "internal/textures.hpp"

namespace gnomon::gl {
namespace {

// What every driver takes, less GL's own group.
constexpr std::uint32_t max_group_depth = 63;

GLsizei to_size(std::size_t value) { return static_cast<GLsizei>(value); }

}  // namespace

CommandExecutor::CommandExecutor(const Adapter& adapter, Objects& objects,
                                 FramebufferCache& framebuffers, const Surroundings& surroundings,
                                 const gpu::CommandBuffer& commands)
    : adapter_(adapter),
      gl_(adapter.gl),
      objects_(objects),
      framebuffers_(framebuffers),
      commands_(commands),
      state_(adapter, surroundings.vertex_array),
      host_provoking_vertex_(surroundings.provoking_vertex),
      vertex_buffers_(adapter.caps.limits.max_vertex_buffers) {}

Status CommandExecutor::run() {
    state_.begin();
    for (const gpu::Command& command : commands_.commands) {
        std::visit(*this, command);
        if (!status_) break;
    }
    while (group_depth_ > 0) pop_group();  // where a failure cut a pass short
    state_.end();
    return std::move(status_);
}

void CommandExecutor::operator()(const gpu::cmd::BeginRenderPass& command) {
    pass_ = &commands_.passes[command.pass];
    pipeline_ = nullptr;
    stencil_reference_ = 0;
    push_group(pass_->label);
    if (pass_->timestamp_writes) {
        write_timestamp(pass_->timestamp_writes->query_set,
                        pass_->timestamp_writes->beginning_index);
    }
    status_ = bind_attachments(*pass_);
    if (!status_) return;
    clear_attachments(*pass_);
    state_.set_blend_constant({});
}

Status CommandExecutor::bind_attachments(const gpu::RenderPassDesc& pass) {
    FramebufferKey key;
    const TextureObject* any = nullptr;
    gpu::Format depth_stencil_format = gpu::Format::Undefined;
    for (const gpu::ColorAttachment& attachment : pass.color_attachments) {
        any = &objects_.textures[attachment.texture];
        key.colors.push_back(any->name);
    }
    if (pass.depth_stencil) {
        any = &objects_.textures[pass.depth_stencil->texture];
        key.depth_stencil = any->name;
        depth_stencil_format = any->format;
    }
    target_ = any;
    Status bound = any->host ? bind_host(pass, key, *any)
                             : framebuffers_.bind(gl_, key, any->target, depth_stencil_format,
                                                  fmt::format("[RenderPass \"{}\"]", pass.label));
    if (!bound) return bound;
    state_.set_viewport({.x = 0.0F,
                         .y = 0.0F,
                         .width = static_cast<float>(any->width),
                         .height = static_cast<float>(any->height),
                         .min_depth = 0.0F,
                         .max_depth = 1.0F});
    state_.set_depth_bounds({});
    return {};
}

Status CommandExecutor::bind_host(const gpu::RenderPassDesc& pass, FramebufferKey key,
                                  const TextureObject& texture) {
    const HostFramebuffer& host = *texture.host;
    if (key.colors.empty()) {
        gl_.BindFramebuffer(GL_FRAMEBUFFER, host.name);
    } else {
        if (const Status takes = takes_colors_beside(texture); !takes) return takes;
        if (!host.owned) {
            const Status same = check_still_attached(gl_, texture);
            if (!same) return same;
        }
        key.host = *host.attached;
        const Status bound = framebuffers_.bind(gl_, key, texture.target, texture.format,
                                                fmt::format("[RenderPass \"{}\"]", pass.label));
        if (!bound) return bound;
    }
    gl_.ClipControl(host.upper_left ? GL_UPPER_LEFT : GL_LOWER_LEFT, host.clip_depth);
    gl_.ProvokingVertex(host_provoking_vertex_);
    return {};
}

void CommandExecutor::clear_attachments(const gpu::RenderPassDesc& pass) {
    open_for_clear(adapter_);
    state_.forget_masks();
    for (std::size_t i = 0; i < pass.color_attachments.size(); ++i) {
        const gpu::ColorAttachment& attachment = pass.color_attachments[i];
        if (attachment.load_op != gpu::LoadOp::Clear) continue;
        const gpu::Color& value = attachment.clear_value;
        const auto index = static_cast<GLint>(i);
        if (gpu::is_uint(objects_.textures[attachment.texture].format)) {
            const std::array integers{static_cast<GLuint>(value.r), static_cast<GLuint>(value.g),
                                      static_cast<GLuint>(value.b), static_cast<GLuint>(value.a)};
            gl_.ClearBufferuiv(GL_COLOR, index, integers.data());
        } else {
            const std::array floats{static_cast<GLfloat>(value.r), static_cast<GLfloat>(value.g),
                                    static_cast<GLfloat>(value.b), static_cast<GLfloat>(value.a)};
            gl_.ClearBufferfv(GL_COLOR, index, floats.data());
        }
    }
    if (pass.depth_stencil) clear_depth_stencil(*pass.depth_stencil);
}

void CommandExecutor::clear_depth_stencil(const gpu::DepthStencilAttachment& attachment) {
    const gpu::Format format = objects_.textures[attachment.texture].format;
    const bool depth = attachment.depth_load_op == gpu::LoadOp::Clear;
    const bool stencil =
        gpu::has_stencil(format) && attachment.stencil_load_op == gpu::LoadOp::Clear;
    const auto stencil_value = static_cast<GLint>(attachment.stencil_clear_value & 0xFFU);
    if (depth && stencil) {
        gl_.ClearBufferfi(GL_DEPTH_STENCIL, 0, attachment.depth_clear_value, stencil_value);
    } else if (depth) {
        gl_.ClearBufferfv(GL_DEPTH, 0, &attachment.depth_clear_value);
    } else if (stencil) {
        gl_.ClearBufferiv(GL_STENCIL, 0, &stencil_value);
    }
}

void CommandExecutor::operator()(const gpu::cmd::EndRenderPass&) {
    // A blit heeds the scissor.
    gl_.Disable(GL_SCISSOR_TEST);
    discard_attachments(*pass_);
    for (const gpu::ColorAttachment& attachment : pass_->color_attachments) {
        if (attachment.resolve_target && status_) status_ = resolve(attachment);
    }
    if (pass_->timestamp_writes) {
        write_timestamp(pass_->timestamp_writes->query_set, pass_->timestamp_writes->end_index);
    }
    pop_group();
    if (target_->host) state_.set_conventions();
    pass_ = nullptr;
}

Status CommandExecutor::resolve(const gpu::ColorAttachment& attachment) {
    const TextureObject& source = objects_.textures[attachment.texture];
    const TextureObject& target = objects_.textures[attachment.resolve_target];
    if (Status bound = framebuffers_.bind(gl_, target); !bound) return bound;
    if (Status bound = framebuffers_.bind_for_reading(gl_, source); !bound) return bound;
    const GLint width = to_size(source.width);
    const GLint height = to_size(source.height);
    gl_.BlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    return {};
}

void CommandExecutor::discard_attachments(const gpu::RenderPassDesc& pass) {
    std::vector<GLenum> discarded;
    for (std::size_t i = 0; i < pass.color_attachments.size(); ++i) {
        const gpu::ColorAttachment& attachment = pass.color_attachments[i];
        // What is resolved is read once more, below. What is the host's is not ours to discard.
        if (attachment.store_op == gpu::StoreOp::Discard && !attachment.resolve_target &&
            !objects_.textures[attachment.texture].borrowed) {
            discarded.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
        }
    }
    if (pass.depth_stencil && !objects_.textures[pass.depth_stencil->texture].host) {
        const gpu::DepthStencilAttachment& attachment = *pass.depth_stencil;
        if (attachment.depth_store_op == gpu::StoreOp::Discard) {
            discarded.push_back(GL_DEPTH_ATTACHMENT);
        }
        if (gpu::has_stencil(objects_.textures[attachment.texture].format) &&
            attachment.stencil_store_op == gpu::StoreOp::Discard) {
            discarded.push_back(GL_STENCIL_ATTACHMENT);
        }
    }
    if (!discarded.empty()) {
        gl_.InvalidateFramebuffer(GL_FRAMEBUFFER, static_cast<GLsizei>(discarded.size()),
                                  discarded.data());
    }
}

void CommandExecutor::write_timestamp(gpu::QuerySetId id, std::uint32_t index) {
    QuerySetObject& set = objects_.query_sets[id];
    gl_.QueryCounter(set.names[index], GL_TIMESTAMP);
    set.written[index] = true;
}

void CommandExecutor::operator()(const gpu::cmd::SetPipeline& command) {
    pipeline_ = &objects_.pipelines[command.pipeline];
    state_.set_pipeline(*pipeline_);
}

void CommandExecutor::operator()(const gpu::cmd::SetBindGroup& command) {
    // Binding numbers are unique across groups, so a group can be bound before its pipeline.
    const BindGroupObject& group = objects_.bind_groups[command.bind_group];
    std::uint32_t next_offset = 0;
    for (const UniformBinding& uniform : group.uniforms) {
        state_.set_uniform(uniform, uniform.dynamic ? command.dynamic_offsets[next_offset++] : 0);
    }
    for (const TextureBinding& texture : group.textures) state_.set_texture(texture);
}

void CommandExecutor::operator()(const gpu::cmd::SetVertexBuffer& command) {
    vertex_buffers_[command.slot] = {.name = objects_.buffers[command.buffer].name,
                                     .offset = static_cast<GLintptr>(command.offset)};
}

void CommandExecutor::operator()(const gpu::cmd::SetIndexBuffer& command) {
    index_buffer_ = {.name = objects_.buffers[command.buffer].name,
                     .format = command.format,
                     .offset = command.offset};
}

void CommandExecutor::operator()(const gpu::cmd::SetStencilReference& command) {
    // GL clamps a reference beyond the stencil's bits, WebGPU cuts it.
    stencil_reference_ = static_cast<GLint>(command.reference & 0xFFU);
}

void CommandExecutor::operator()(const gpu::cmd::SetBlendConstant& command) {
    state_.set_blend_constant(command.color);
}

void CommandExecutor::operator()(const gpu::cmd::SetViewport& command) {
    state_.set_viewport(command);
}

void CommandExecutor::operator()(const gpu::cmd::SetScissorRect& command) {
    gpu::cmd::SetScissorRect rect = command;
    // Rows are those of the framebuffer, as vertex stages leave them; there they are turned over.
    if (target_->host && target_->host->upper_left) {
        rect.y = target_->height - command.y - command.height;
    }
    // Several samples are cut exactly on a grid that begins at row 0, and at the other end in a
    // window's framebuffer. What a guest draws may be cut less, never wrongly.
    const std::uint32_t grid = adapter_.caps.limits.multisample_scissor_alignment;
    if (target_->host && target_->target == GL_TEXTURE_2D_MULTISAMPLE && grid > 1 &&
        (target_->host->upper_left || target_->host->name == 0)) {
        rect.y = 0;
        rect.height = target_->height;
    }
    state_.set_scissor(rect);
}

void CommandExecutor::operator()(const gpu::cmd::SetDepthBounds& command) {
    state_.set_depth_bounds(command);
}

GlStencil CommandExecutor::current_stencil() const {
    GlStencil stencil = pipeline_->stencil;
    stencil.reference = stencil_reference_;
    return stencil;
}

void CommandExecutor::prepare_draw(std::uint32_t first_instance) {
    state_.set_stencil(current_stencil());
    for (std::size_t slot = 0; slot < pipeline_->slots.size(); ++slot) {
        state_.set_vertex_buffer(static_cast<GLuint>(slot), vertex_buffers_[slot].name,
                                 vertex_buffers_[slot].offset, pipeline_->slots[slot].stride);
    }
    if (pipeline_->base_instance_location >= 0) {
        gl_.Uniform1i(pipeline_->base_instance_location, static_cast<GLint>(first_instance));
    }
}

void CommandExecutor::operator()(const gpu::cmd::Draw& command) {
    prepare_draw(command.first_instance);
    adapter_.stencil->draw(gl_, current_stencil(), pipeline_->topology, [&] {
        gl_.DrawArraysInstancedBaseInstance(
            pipeline_->topology, to_size(command.first_vertex), to_size(command.vertex_count),
            to_size(command.instance_count), command.first_instance);
    });
}

void CommandExecutor::operator()(const gpu::cmd::DrawIndexed& command) {
    prepare_draw(command.first_instance);
    state_.set_index_buffer(index_buffer_.name);
    const std::uint64_t index_bytes = index_buffer_.format == gpu::IndexFormat::Uint16 ? 2 : 4;
    const std::uint64_t start = index_buffer_.offset + command.first_index * index_bytes;
    adapter_.stencil->draw(gl_, current_stencil(), pipeline_->topology, [&] {
        gl_.DrawElementsInstancedBaseVertexBaseInstance(
            pipeline_->topology, to_size(command.index_count), to_gl(index_buffer_.format),
            reinterpret_cast<const void*>(start), to_size(command.instance_count),
            command.base_vertex, command.first_instance);
    });
}

void CommandExecutor::operator()(const gpu::cmd::BeginOcclusionQuery& command) {
    QuerySetObject& set = objects_.query_sets[pass_->occlusion_query_set];
    gl_.BeginQuery(GL_SAMPLES_PASSED, set.names[command.index]);
    set.written[command.index] = true;
}

void CommandExecutor::operator()(const gpu::cmd::EndOcclusionQuery&) {
    gl_.EndQuery(GL_SAMPLES_PASSED);
}

void CommandExecutor::operator()(const gpu::cmd::PushDebugGroup& command) {
    push_group(commands_.strings[command.label]);
}

void CommandExecutor::operator()(const gpu::cmd::PopDebugGroup&) { pop_group(); }

void CommandExecutor::push_group(std::string_view label) {
    ++group_depth_;
    if (!adapter_.debug_groups || group_depth_ > max_group_depth) return;
    label = label.substr(0, max_label_length);
    gl_.PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, to_size(label.size()), label.data());
}

void CommandExecutor::pop_group() {
    if (adapter_.debug_groups && group_depth_ <= max_group_depth) gl_.PopDebugGroup();
    --group_depth_;
}

void CommandExecutor::operator()(const gpu::cmd::CopyBufferToBuffer& command) {
    gl_.BindBuffer(GL_COPY_READ_BUFFER, objects_.buffers[command.source].name);
    gl_.BindBuffer(GL_COPY_WRITE_BUFFER, objects_.buffers[command.destination].name);
    gl_.CopyBufferSubData(
        GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(command.source_offset),
        static_cast<GLintptr>(command.destination_offset), static_cast<GLsizeiptr>(command.size));
}

}  // namespace gnomon::gl
