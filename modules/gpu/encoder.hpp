// SPDX-License-Identifier: MIT
//
// Encoders record commands into plain data. Recording never fails: misuse is found, all of it at
// once, when CommandEncoder::finish() validates what was recorded.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/command.hpp>

#pragma GCC visibility push(default)
namespace gnomon::gpu {

class CommandEncoder;
struct Recording;  // what an encoder and its passes write into; shared, so that either may go first

/// Records one render pass. Ends when end() is called or it goes out of scope. A call after that is
/// misuse that finish() reports. Not thread-safe; two encoders on two threads are fine.
class RenderPassEncoder {
public:
    RenderPassEncoder(RenderPassEncoder&& other) noexcept;
    RenderPassEncoder& operator=(RenderPassEncoder&&) = delete;
    ~RenderPassEncoder();

    /// State and shaders of the draws that follow.
    void set_pipeline(RenderPipelineId pipeline);
    /// Buffers and textures of the pipeline's group number `group`; an offset in bytes for each
    /// dynamic binding, in order of binding.
    void set_bind_group(std::uint32_t group, BindGroupId bind_group,
                        std::span<const std::uint32_t> dynamic_offsets = {});
    /// The buffer for RenderPipelineDesc::vertex_buffers[slot], from `offset` bytes on.
    void set_vertex_buffer(std::uint32_t slot, BufferId buffer, std::uint64_t offset = 0);
    /// The indices of draw_indexed(), from `offset` bytes on.
    void set_index_buffer(BufferId buffer, IndexFormat format, std::uint64_t offset = 0);
    /// What stencil comparisons compare with, 0 .. 255; 0 when a pass begins.
    void set_stencil_reference(std::uint32_t reference);
    /// BlendFactor::Constant; all 0 when a pass begins.
    void set_blend_constant(Color color);
    /// Pixels, row 0 on top; depth range within 0..1.
    void set_viewport(float x, float y, float width, float height, float min_depth = 0.0F,
                      float max_depth = 1.0F);
    /// Nothing outside is drawn. Pixels, row 0 on top; the whole target when a pass begins.
    void set_scissor_rect(std::uint32_t x, std::uint32_t y, std::uint32_t width,
                          std::uint32_t height);
    /// What DepthStencilState::depth_bounds_test lets through, within 0..1; everything at the
    /// beginning of a pass. Needs Features::depth_bounds.
    void set_depth_bounds(float min, float max);
    /// Draws vertices in order.
    void draw(std::uint32_t vertex_count, std::uint32_t instance_count = 1,
              std::uint32_t first_vertex = 0, std::uint32_t first_instance = 0);
    /// Draws vertices by number: `base_vertex` is added to each index.
    void draw_indexed(std::uint32_t index_count, std::uint32_t instance_count = 1,
                      std::uint32_t first_index = 0, std::int32_t base_vertex = 0,
                      std::uint32_t first_instance = 0);
    /// Counts samples that pass, until end_occlusion_query(), into that place of the pass's query
    /// set. Not nested.
    void begin_occlusion_query(std::uint32_t index);
    /// Ends what begin_occlusion_query() began.
    void end_occlusion_query();
    /// A name for what follows, in debuggers and validation messages.
    void push_debug_group(std::string_view label);
    /// Ends the last group.
    void pop_debug_group();
    /// Ends the pass.
    void end();

private:
    friend class CommandEncoder;
    RenderPassEncoder(std::shared_ptr<Recording> recording, std::uint32_t pass);
    template <class Cmd>
    void record(const char* function, const Cmd& command);

    std::shared_ptr<Recording> recording_;  // null when moved from
    std::uint32_t pass_;
    bool ended_ = false;
};

/// Records a command buffer. Made by Device::create_command_encoder.
class CommandEncoder {
public:
    /// What Device::create_command_encoder() does.
    CommandEncoder(std::weak_ptr<DeviceState> device, std::string label);

    /// Begins a pass; the one before must have ended.
    [[nodiscard]] RenderPassEncoder begin_render_pass(RenderPassDesc desc);
    /// Copies bytes on the device, outside of passes; offsets and size are multiples of 4.
    void copy_buffer_to_buffer(BufferId source, std::uint64_t source_offset, BufferId destination,
                               std::uint64_t destination_offset, std::uint64_t size);
    /// A name for what follows, in debuggers and validation messages.
    void push_debug_group(std::string_view label);
    /// Ends the last group.
    void pop_debug_group();

    /// Validates everything recorded and hands it over; the encoder is empty afterwards. The
    /// message lists every violation, one a line. Cost: linear in the number of commands.
    [[nodiscard]] Result<CommandBuffer> finish();

private:
    std::weak_ptr<DeviceState> device_;
    std::shared_ptr<Recording> recording_;
};

}  // namespace gnomon::gpu
#pragma GCC visibility pop
