// SPDX-License-Identifier: MIT
//
// What a render pass needs before it begins and leaves behind when it ends: defined contents,
// barriers, the render pass and framebuffer objects, queries.
#include <variant>

#include <fmt/format.h>

#include "internal/command_recorder.hpp"
#include "internal/conv.hpp"

namespace gnomon::vk {

namespace {

VkClearValue clear_color(gpu::Format format, const gpu::Color& color) {
    VkClearValue value{};
    if (gpu::is_uint(format)) {
        value.color.uint32[0] = static_cast<std::uint32_t>(color.r);
        value.color.uint32[1] = static_cast<std::uint32_t>(color.g);
        value.color.uint32[2] = static_cast<std::uint32_t>(color.b);
        value.color.uint32[3] = static_cast<std::uint32_t>(color.a);
    } else {
        value.color.float32[0] = static_cast<float>(color.r);
        value.color.float32[1] = static_cast<float>(color.g);
        value.color.float32[2] = static_cast<float>(color.b);
        value.color.float32[3] = static_cast<float>(color.a);
    }
    return value;
}

/// Loading what counts as zero is clearing to zero.
VkAttachmentLoadOp load_op(gpu::LoadOp wanted, const Texture& texture, VkImageAspectFlags aspect) {
    return (texture.undefined & aspect) != 0 ? VK_ATTACHMENT_LOAD_OP_CLEAR : to_vk(wanted);
}

/// The value for the load operation above.
bool clears_to_zero(gpu::LoadOp wanted) { return wanted == gpu::LoadOp::Load; }

void note_store(Texture& texture, VkImageAspectFlags aspect, gpu::StoreOp op) {
    if (texture.host_layout) {
        return;  // stored, whatever the pass says
    }
    if (op == gpu::StoreOp::Discard) {
        texture.undefined |= aspect & texture.aspects;
    } else {
        texture.undefined &= ~aspect;
    }
}

}  // namespace

Status CommandRecorder::begin_pass(const gpu::RenderPassDesc& pass,
                                   std::span<const gpu::Command> commands) {
    std::size_t length = 0;
    while (!std::holds_alternative<gpu::cmd::EndRenderPass>(commands[length])) {
        ++length;
    }
    commands = commands.first(length);
    if (pass.depth_stencil && resources_.textures[pass.depth_stencil->texture].host_pass) {
        return begin_in_host_pass(pass, pass.depth_stencil->texture, commands);
    }

    host_pass_ = 0;
    BarrierBatch barriers;
    if (const Status prepared = prepare_reads(commands, barriers); !prepared) {
        return prepared;
    }
    FramebufferKey framebuffer_key;
    std::vector<VkImageView> resolve_views;
    std::vector<VkClearValue> clears;
    for (const gpu::ColorAttachment& attachment : pass.color_attachments) {
        Texture& texture = resources_.textures[attachment.texture];
        prepare_attachment(texture, Usage::ColorAttachment,
                           attachment.load_op == gpu::LoadOp::Clear, barriers);
        framebuffer_key.views.push_back(texture.attachment);
        clears.push_back(clear_color(texture.format, clears_to_zero(attachment.load_op)
                                                         ? gpu::Color{}
                                                         : attachment.clear_value));
        if (attachment.resolve_target) {
            Texture& target = resources_.textures[attachment.resolve_target];
            prepare_attachment(target, Usage::ColorAttachment, true, barriers);
            resolve_views.push_back(target.attachment);
        }
        framebuffer_key.width = texture.width;
        framebuffer_key.height = texture.height;
    }
    framebuffer_key.views.insert(framebuffer_key.views.end(), resolve_views.begin(),
                                 resolve_views.end());
    clears.resize(framebuffer_key.views.size());
    if (pass.depth_stencil) {
        const gpu::DepthStencilAttachment& attachment = *pass.depth_stencil;
        Texture& texture = resources_.textures[attachment.texture];
        prepare_attachment(texture, Usage::DepthStencilAttachment, false, barriers);
        framebuffer_key.views.push_back(texture.attachment);
        VkClearValue clear{};
        clear.depthStencil.depth =
            clears_to_zero(attachment.depth_load_op) ? 0.0F : attachment.depth_clear_value;
        clear.depthStencil.stencil =
            clears_to_zero(attachment.stencil_load_op) ? 0 : attachment.stencil_clear_value;
        clears.push_back(clear);
        framebuffer_key.width = texture.width;
        framebuffer_key.height = texture.height;
    }
    barriers.flush(device_.fn, out_);

    const Result<VkRenderPass> render_pass = render_passes_.render_pass(describe_attachments(pass));
    if (!render_pass) {
        return forward_error(render_pass);
    }
    framebuffer_key.render_pass = *render_pass;
    const Result<VkFramebuffer> framebuffer =
        render_passes_.framebuffer(framebuffer_key, fmt::format("render pass '{}'", pass.label));
    if (!framebuffer) {
        return forward_error(framebuffer);
    }

    pass_ = &pass;
    pipeline_ = nullptr;
    groups_ = {};
    begin_label(pass.label);
    reset_queries(commands);
    if (pass.timestamp_writes) {
        write_timestamp(pass.timestamp_writes->query_set, pass.timestamp_writes->beginning_index);
    }
    VkRenderPassBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    info.renderPass = *render_pass;
    info.framebuffer = *framebuffer;
    info.renderArea.extent = {framebuffer_key.width, framebuffer_key.height};
    info.clearValueCount = static_cast<std::uint32_t>(clears.size());
    info.pClearValues = clears.data();
    device_.fn.CmdBeginRenderPass(out_, &info, VK_SUBPASS_CONTENTS_INLINE);
    set_default_state(framebuffer_key.width, framebuffer_key.height);
    return {};
}

Status CommandRecorder::check_in_host_pass(const gpu::RenderPassDesc& pass, gpu::TextureId id,
                                           std::span<const gpu::Command> commands) const {
    const std::string subject = fmt::format("Render pass '{}' in the host's render pass of {}",
                                            pass.label, resources_.textures[id].subject);
    if (queue_.is_recording_to(out_)) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{} has no command buffer to go to: set "
                                "HostCommands::command_buffer to the one in which the host has "
                                "begun that.",
                                subject));
    }
    if (!pass.color_attachments.empty()) {
        return takes_colors_beside(resources_.textures[id]);
    }
    if (pass.occlusion_query_set || pass.timestamp_writes) {
        return fail(
            ErrorCode::Unsupported,
            fmt::format("{} has queries, which are reset outside of render passes.", subject));
    }
    const HostPassKind kind = resources_.textures[id].host_pass_kind;
    for (const gpu::Command& command : commands) {
        const auto* set = std::get_if<gpu::cmd::SetPipeline>(&command);
        if (set != nullptr &&
            resources_.pipelines[set->pipeline].in_host_pass(kind) == VK_NULL_HANDLE) {
            return fail(ErrorCode::InvalidInput,
                        fmt::format("{} sets a pipeline that was made before that was imported: "
                                    "import it first.",
                                    subject));
        }
    }
    return {};
}

Status CommandRecorder::begin_in_host_pass(const gpu::RenderPassDesc& pass, gpu::TextureId id,
                                           std::span<const gpu::Command> commands) {
    if (const Status checked = check_in_host_pass(pass, id, commands); !checked) {
        return checked;
    }
    host_pass_ = resources_.textures[id].host_pass_kind;
    BarrierBatch barriers;
    if (const Status prepared = prepare_reads(commands, barriers); !prepared) {
        return prepared;
    }
    if (!barriers.empty()) {
        const Result<VkCommandBuffer> before = before_pass();
        if (!before) {
            return forward_error(before);
        }
        barriers.flush(device_.fn, *before);
    }
    const Texture& texture = resources_.textures[id];
    pass_ = &pass;
    pipeline_ = nullptr;
    groups_ = {};
    begin_label(pass.label);
    set_default_state(texture.width, texture.height);
    clear_in_host_pass(*pass.depth_stencil, texture);
    return {};
}

void CommandRecorder::clear_in_host_pass(const gpu::DepthStencilAttachment& attachment,
                                         const Texture& texture) {
    VkClearAttachment clear{};
    clear.clearValue.depthStencil = {attachment.depth_clear_value, attachment.stencil_clear_value};
    if (attachment.depth_load_op == gpu::LoadOp::Clear) {
        clear.aspectMask |= VK_IMAGE_ASPECT_DEPTH_BIT;
    }
    if (attachment.stencil_load_op == gpu::LoadOp::Clear) {
        clear.aspectMask |= VK_IMAGE_ASPECT_STENCIL_BIT;
    }
    if (clear.aspectMask == 0) {
        return;
    }
    const VkClearRect all{{{0, 0}, {texture.width, texture.height}}, 0, 1};
    device_.fn.CmdClearAttachments(out_, 1, &clear, 1, &all);
}

void CommandRecorder::end_pass() {
    if (host_pass_ != 0) {
        end_label();
        pass_ = nullptr;
        return;
    }
    device_.fn.CmdEndRenderPass(out_);
    if (pass_->timestamp_writes) {
        write_timestamp(pass_->timestamp_writes->query_set, pass_->timestamp_writes->end_index);
    }
    end_label();
    note_stores(*pass_);
    BarrierBatch barriers;
    for (const gpu::ColorAttachment& attachment : pass_->color_attachments) {
        give_back(attachment.texture, barriers);
        if (attachment.resolve_target) {
            give_back(attachment.resolve_target, barriers);
        }
    }
    if (pass_->depth_stencil) {
        give_back(pass_->depth_stencil->texture, barriers);
    }
    barriers.flush(device_.fn, out_);
    pass_ = nullptr;
}

void CommandRecorder::give_back(gpu::TextureId id, BarrierBatch& barriers) {
    Texture& texture = resources_.textures[id];
    if (texture.host_layout) {
        Dependency dependency;
        texture.tracker.give_back(*texture.host_layout, dependency);
        barriers.add_image(dependency, texture.handle, texture.aspects);
    }
}

Result<VkCommandBuffer> CommandRecorder::before_pass() {
    if (host_pass_ != 0) {
        return queue_.commands();
    }
    return out_;
}

Status CommandRecorder::prepare_reads(std::span<const gpu::Command> commands,
                                      BarrierBatch& barriers) {
    Status status;
    const auto define = [&](auto& object) {
        const Result<VkCommandBuffer> before = before_pass();
        if (before) {
            define_contents(device_, *before, object);
        } else {
            status = forward_error(before);
        }
    };
    const auto read_buffer = [&](gpu::BufferId id, Usage usage) {
        Buffer& buffer = resources_.buffers[id];
        if (!buffer.zeroed) {
            define(buffer);
        }
        use_buffer(buffer, usage, barriers);
        note_read(buffer);
    };
    const auto read_texture = [&](const BoundTexture& bound) {
        Texture& texture = resources_.textures[bound.texture];
        if (texture.undefined != 0) {
            define(texture);
        }
        use_texture(texture,
                    bound.in_vertex_shader ? Usage::SampledInVertex : Usage::SampledInFragment,
                    barriers);
        note_read(texture);
    };
    for (const gpu::Command& command : commands) {
        if (const auto* set = std::get_if<gpu::cmd::SetBindGroup>(&command)) {
            const BindGroup& group = resources_.bind_groups[set->bind_group];
            for (const gpu::BufferId id : group.buffers) {
                read_buffer(id, Usage::Uniform);
            }
            for (const BoundTexture& bound : group.textures) {
                read_texture(bound);
            }
        } else if (const auto* vertices = std::get_if<gpu::cmd::SetVertexBuffer>(&command)) {
            read_buffer(vertices->buffer, Usage::VertexInput);
        } else if (const auto* indices = std::get_if<gpu::cmd::SetIndexBuffer>(&command)) {
            read_buffer(indices->buffer, Usage::VertexInput);
        }
    }
    return status;
}

void CommandRecorder::prepare_attachment(Texture& texture, Usage usage, bool written,
                                         BarrierBatch& barriers) {
    if (texture.host_layout) {
        texture.tracker.lent(*texture.host_layout);
        if (written) {
            texture.tracker.forget_contents();
        }
    } else if (texture.mip_level_count > 1) {
        // The pass clears level 0 alone.
        define_contents(device_, out_, texture);
    } else if (texture.undefined == texture.aspects) {
        texture.tracker.forget_contents();
    }
    use_texture(texture, usage, barriers);
}

RenderPassKey CommandRecorder::describe_attachments(const gpu::RenderPassDesc& pass) {
    // What is the host's is not ours to discard.
    const auto stored = [](const Texture& texture, gpu::StoreOp op) {
        return to_vk(texture.host_layout ? gpu::StoreOp::Store : op);
    };
    const auto describe = [](const Texture& texture, Usage usage) {
        AttachmentState state;
        state.format = to_vk(texture.format);
        state.samples = to_vk_samples(texture.sample_count);
        state.layout = layout_of(usage, texture.aspects);
        return state;
    };
    RenderPassKey key;
    for (const gpu::ColorAttachment& attachment : pass.color_attachments) {
        const Texture& texture = resources_.textures[attachment.texture];
        AttachmentState state = describe(texture, Usage::ColorAttachment);
        state.load = load_op(attachment.load_op, texture, VK_IMAGE_ASPECT_COLOR_BIT);
        state.store = stored(texture, attachment.store_op);
        state.resolves = static_cast<bool>(attachment.resolve_target);
        key.colors.push_back(state);
    }
    if (pass.depth_stencil) {
        const gpu::DepthStencilAttachment& attachment = *pass.depth_stencil;
        const Texture& texture = resources_.textures[attachment.texture];
        AttachmentState state = describe(texture, Usage::DepthStencilAttachment);
        state.load = load_op(attachment.depth_load_op, texture, VK_IMAGE_ASPECT_DEPTH_BIT);
        state.store = stored(texture, attachment.depth_store_op);
        if (gpu::has_stencil(texture.format)) {
            state.stencil_load =
                load_op(attachment.stencil_load_op, texture, VK_IMAGE_ASPECT_STENCIL_BIT);
            state.stencil_store = stored(texture, attachment.stencil_store_op);
        }
        key.depth_stencil.push_back(state);
    }
    return key;
}

void CommandRecorder::note_stores(const gpu::RenderPassDesc& pass) {
    for (const gpu::ColorAttachment& attachment : pass.color_attachments) {
        note_store(resources_.textures[attachment.texture], VK_IMAGE_ASPECT_COLOR_BIT,
                   attachment.store_op);
        if (attachment.resolve_target) {
            note_store(resources_.textures[attachment.resolve_target], VK_IMAGE_ASPECT_COLOR_BIT,
                       gpu::StoreOp::Store);
        }
    }
    if (pass.depth_stencil) {
        Texture& texture = resources_.textures[pass.depth_stencil->texture];
        note_store(texture, VK_IMAGE_ASPECT_DEPTH_BIT, pass.depth_stencil->depth_store_op);
        note_store(texture, VK_IMAGE_ASPECT_STENCIL_BIT, pass.depth_stencil->stencil_store_op);
    }
}

void CommandRecorder::reset_queries(std::span<const gpu::Command> commands) {
    for (const gpu::Command& command : commands) {
        if (const auto* query = std::get_if<gpu::cmd::BeginOcclusionQuery>(&command)) {
            reset_query(pass_->occlusion_query_set, query->index);
        }
    }
    if (pass_->timestamp_writes) {
        const gpu::TimestampWrites& writes = *pass_->timestamp_writes;
        reset_query(writes.query_set, writes.beginning_index);
        reset_query(writes.query_set, writes.end_index);
    }
}

void CommandRecorder::reset_query(gpu::QuerySetId query_set, std::uint32_t index) {
    device_.fn.CmdResetQueryPool(out_, resources_.query_sets[query_set].pool, index, 1);
}

void CommandRecorder::write_timestamp(gpu::QuerySetId query_set, std::uint32_t index) {
    QuerySet& queries = resources_.query_sets[query_set];
    // The bottom of the pipe at the beginning too: when all earlier work is done, so that the
    // difference is this pass's own time.
    device_.fn.CmdWriteTimestamp(out_, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, queries.pool, index);
    queries.written[index] = true;
}

void CommandRecorder::set_default_state(std::uint32_t width, std::uint32_t height) {
    visit(gpu::cmd::SetViewport{
        .x = 0, .y = 0, .width = static_cast<float>(width), .height = static_cast<float>(height)});
    visit(gpu::cmd::SetScissorRect{.x = 0, .y = 0, .width = width, .height = height});
    visit(gpu::cmd::SetDepthBounds{});
    visit(gpu::cmd::SetStencilReference{});
    visit(gpu::cmd::SetBlendConstant{});
}

}  // namespace gnomon::vk
