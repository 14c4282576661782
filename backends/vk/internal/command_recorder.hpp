// SPDX-License-Identifier: MIT
//
// One visit over a command buffer of the interface: each command becomes one of Vulkan's. Barriers
// cannot be recorded within a render pass, so a pass is looked through once before it begins.
#pragma once

#include <array>
#include <span>

#include <gnomon/gpu/command.hpp>

#include "internal/resources.hpp"

namespace gnomon::vk {

class CommandRecorder {
public:
    /// `out` is the queue's own, or a host's, which is submitted after the queue's and has a number
    /// from 1 then: what is read there is marked by it.
    CommandRecorder(Device& device, RenderPasses& render_passes, Resources& resources, Queue& queue,
                    VkCommandBuffer out, std::uint64_t host_buffer = 0)
        : device_(device),
          render_passes_(render_passes),
          resources_(resources),
          queue_(queue),
          out_(out),
          host_buffer_(host_buffer) {}

    /// Fails when memory for a render pass or framebuffer runs out; what came before that pass
    /// stays recorded.
    [[nodiscard]] Status record(const gpu::CommandBuffer& source);

private:
    struct BoundGroup {
        gpu::cmd::SetBindGroup command;
        bool set = false;
        bool stale = false;  // not yet known to Vulkan
    };

    // Passes (command_recorder_passes.cpp).
    [[nodiscard]] Status begin_pass(const gpu::RenderPassDesc& pass,
                                    std::span<const gpu::Command> commands);
    [[nodiscard]] Status begin_in_host_pass(const gpu::RenderPassDesc& pass, gpu::TextureId id,
                                            std::span<const gpu::Command> commands);
    [[nodiscard]] Status check_in_host_pass(const gpu::RenderPassDesc& pass, gpu::TextureId id,
                                            std::span<const gpu::Command> commands) const;
    void clear_in_host_pass(const gpu::DepthStencilAttachment& attachment, const Texture& texture);
    /// Where barriers of the next pass go: not within a host's render pass, but to the queue, which
    /// is submitted before.
    [[nodiscard]] Result<VkCommandBuffer> before_pass();
    [[nodiscard]] Status prepare_reads(std::span<const gpu::Command> commands,
                                       BarrierBatch& barriers);
    /// `written`: all of it, and nothing of what it holds is read.
    void prepare_attachment(Texture& texture, Usage usage, bool written, BarrierBatch& barriers);
    /// A host's image, to the layout in which the host has it.
    void give_back(gpu::TextureId id, BarrierBatch& barriers);
    [[nodiscard]] RenderPassKey describe_attachments(const gpu::RenderPassDesc& pass);
    void note_stores(const gpu::RenderPassDesc& pass);
    void reset_queries(std::span<const gpu::Command> commands);
    void reset_query(gpu::QuerySetId query_set, std::uint32_t index);
    void write_timestamp(gpu::QuerySetId query_set, std::uint32_t index);
    void end_pass();
    void set_default_state(std::uint32_t width, std::uint32_t height);

    void visit(const gpu::cmd::SetPipeline& command);
    void visit(const gpu::cmd::SetBindGroup& command);
    void visit(const gpu::cmd::SetVertexBuffer& command);
    void visit(const gpu::cmd::SetIndexBuffer& command);
    void visit(const gpu::cmd::SetStencilReference& command);
    void visit(const gpu::cmd::SetBlendConstant& command);
    void visit(const gpu::cmd::SetViewport& command);
    void visit(const gpu::cmd::SetScissorRect& command);
    void visit(const gpu::cmd::SetDepthBounds& command);
    void visit(const gpu::cmd::Draw& command);
    void visit(const gpu::cmd::DrawIndexed& command);
    void visit(const gpu::cmd::BeginOcclusionQuery& command);
    void visit(const gpu::cmd::EndOcclusionQuery& command);
    void visit(const gpu::cmd::CopyBufferToBuffer& command);

    template <class Object>
    void note_read(Object& object) const {
        if (host_buffer_ != 0) {
            object.read_by_host = host_buffer_;
        }
    }
    void bind_stale_groups();
    void begin_label(const std::string& label);
    void end_label();

    Device& device_;
    RenderPasses& render_passes_;
    Resources& resources_;
    Queue& queue_;
    VkCommandBuffer out_;
    std::uint64_t host_buffer_ = 0;

    // Of the pass being recorded.
    const gpu::RenderPassDesc* pass_ = nullptr;
    const Pipeline* pipeline_ = nullptr;
    HostPassKind host_pass_ = 0;  // that it is recorded in
    std::array<BoundGroup, gpu::max_bind_groups> groups_{};
    std::uint32_t open_query_ = 0;
};

}  // namespace gnomon::vk
