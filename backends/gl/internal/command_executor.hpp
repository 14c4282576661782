// SPDX-License-Identifier: MIT
//
// One visit over a command buffer: each command becomes its GL calls. The commands were validated.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include <gnomon/gpu/command.hpp>

#include "internal/adapter.hpp"
#include "internal/framebuffer_cache.hpp"
#include "internal/objects.hpp"
#include "internal/render_state.hpp"

namespace gnomon::gl {

class CommandExecutor {
public:
    /// What the host of the context has set, and what is ours.
    struct Surroundings {
        GLuint vertex_array = 0;
        GLenum provoking_vertex = GL_LAST_VERTEX_CONVENTION;  ///< with which it draws its own
    };
    CommandExecutor(const Adapter& adapter, Objects& objects, FramebufferCache& framebuffers,
                    const Surroundings& surroundings, const gpu::CommandBuffer& commands);

    /// Stops at the first command that the driver cannot carry out.
    [[nodiscard]] Status run();

    void operator()(const gpu::cmd::BeginRenderPass& command);
    void operator()(const gpu::cmd::EndRenderPass& command);
    void operator()(const gpu::cmd::SetPipeline& command);
    void operator()(const gpu::cmd::SetBindGroup& command);
    void operator()(const gpu::cmd::SetVertexBuffer& command);
    void operator()(const gpu::cmd::SetIndexBuffer& command);
    void operator()(const gpu::cmd::SetStencilReference& command);
    void operator()(const gpu::cmd::SetBlendConstant& command);
    void operator()(const gpu::cmd::SetViewport& command);
    void operator()(const gpu::cmd::SetScissorRect& command);
    void operator()(const gpu::cmd::SetDepthBounds& command);
    void operator()(const gpu::cmd::Draw& command);
    void operator()(const gpu::cmd::DrawIndexed& command);
    void operator()(const gpu::cmd::BeginOcclusionQuery& command);
    void operator()(const gpu::cmd::EndOcclusionQuery& command);
    void operator()(const gpu::cmd::PushDebugGroup& command);
    void operator()(const gpu::cmd::PopDebugGroup& command);
    void operator()(const gpu::cmd::CopyBufferToBuffer& command);

private:
    struct VertexBuffer {
        GLuint name = 0;
        GLintptr offset = 0;
    };
    struct IndexBuffer {
        GLuint name = 0;
        gpu::IndexFormat format = gpu::IndexFormat::Uint32;
        std::uint64_t offset = 0;
    };

    [[nodiscard]] Status bind_attachments(const gpu::RenderPassDesc& pass);
    /// Draws as the host does from here on: by its clip space and its provoking vertex.
    /// `key`: the pass's colour attachments.
    [[nodiscard]] Status bind_host(const gpu::RenderPassDesc& pass, FramebufferKey key,
                                   const TextureObject& texture);
    void clear_attachments(const gpu::RenderPassDesc& pass);
    void clear_depth_stencil(const gpu::DepthStencilAttachment& attachment);
    [[nodiscard]] Status resolve(const gpu::ColorAttachment& attachment);
    void discard_attachments(const gpu::RenderPassDesc& pass);
    void write_timestamp(gpu::QuerySetId set, std::uint32_t index);
    void push_group(std::string_view label);
    void pop_group();
    void prepare_draw(std::uint32_t first_instance);
    [[nodiscard]] GlStencil current_stencil() const;

    const Adapter& adapter_;
    const GlFunctions& gl_;
    Objects& objects_;
    FramebufferCache& framebuffers_;
    const gpu::CommandBuffer& commands_;
    RenderState state_;
    Status status_;
    std::uint32_t group_depth_ = 0;
    GLenum host_provoking_vertex_;

    // of the pass that is open
    const gpu::RenderPassDesc* pass_ = nullptr;
    const TextureObject* target_ = nullptr;  ///< one of the attachments
    const PipelineObject* pipeline_ = nullptr;
    std::vector<VertexBuffer> vertex_buffers_;
    IndexBuffer index_buffer_;
    GLint stencil_reference_ = 0;
};

}  // namespace gnomon::gl
