// SPDX-License-Identifier: MIT
//
// Commands: what an encoder records. A CommandBuffer is plain data: it can be copied, printed,
// compared, counted and replayed, and knows nothing of a backend. A backend is, mostly, one visit
// over it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <gnomon/gpu/descriptors.hpp>

#pragma GCC visibility push(default)
namespace gnomon::gpu {

/// Bind groups a pipeline has at most.
inline constexpr std::uint32_t max_bind_groups = 4;
inline constexpr std::uint32_t max_dynamic_offsets = 4;  ///< per bind group

namespace cmd {

/// CommandEncoder::begin_render_pass().
struct BeginRenderPass {
    std::uint32_t pass = 0;  ///< index into CommandBuffer::passes
};
/// RenderPassEncoder::end().
struct EndRenderPass {};
/// RenderPassEncoder::set_pipeline().
struct SetPipeline {
    RenderPipelineId pipeline;  ///< which one
};
/// RenderPassEncoder::set_bind_group().
struct SetBindGroup {
    std::uint32_t group = 0;                 ///< its place in the pipeline
    BindGroupId bind_group;                  ///< which one
    std::uint32_t dynamic_offset_count = 0;  ///< how many of the offsets count
    std::array<std::uint32_t, max_dynamic_offsets>
        dynamic_offsets{};  ///< bytes, in order of binding
};
/// RenderPassEncoder::set_vertex_buffer().
struct SetVertexBuffer {
    std::uint32_t slot = 0;    ///< its place in RenderPipelineDesc::vertex_buffers
    BufferId buffer;           ///< which one
    std::uint64_t offset = 0;  ///< bytes
};
/// RenderPassEncoder::set_index_buffer().
struct SetIndexBuffer {
    BufferId buffer;                           ///< which one
    IndexFormat format = IndexFormat::Uint32;  ///< of its indices
    std::uint64_t offset = 0;                  ///< bytes
};
/// RenderPassEncoder::set_stencil_reference().
struct SetStencilReference {
    std::uint32_t reference = 0;  ///< 0 .. 255
};
/// RenderPassEncoder::set_blend_constant().
struct SetBlendConstant {
    Color color;  ///< for BlendFactor::Constant
};
/// RenderPassEncoder::set_viewport(). Pixels, row 0 on top.
struct SetViewport {
    float x = 0;          ///< of the left edge
    float y = 0;          ///< of the upper edge
    float width = 0;      ///< may have a fraction
    float height = 0;     ///< may have a fraction
    float min_depth = 0;  ///< where depth 0 of clip space goes
    float max_depth = 1;  ///< where depth 1 goes
};
/// RenderPassEncoder::set_scissor_rect(). Pixels, row 0 on top.
struct SetScissorRect {
    std::uint32_t x = 0;       ///< of the left edge
    std::uint32_t y = 0;       ///< of the upper edge
    std::uint32_t width = 0;   ///< 0 draws nothing
    std::uint32_t height = 0;  ///< 0 draws nothing
};
/// RenderPassEncoder::set_depth_bounds(). Depths as they are stored.
struct SetDepthBounds {
    float min = 0;  ///< the least that is let through
    float max = 1;  ///< the greatest
};
/// RenderPassEncoder::draw().
struct Draw {
    std::uint32_t vertex_count = 0;    ///< of each instance
    std::uint32_t instance_count = 1;  ///< 0 draws nothing
    std::uint32_t first_vertex = 0;    ///< number of the first vertex
    std::uint32_t first_instance = 0;  ///< number of the first instance
};
/// RenderPassEncoder::draw_indexed().
struct DrawIndexed {
    std::uint32_t index_count = 0;     ///< of each instance
    std::uint32_t instance_count = 1;  ///< 0 draws nothing
    std::uint32_t first_index =
        0;  ///< its place in the index buffer  ///< its place in the pass's query set
    std::int32_t base_vertex = 0;      ///< added to every index
    std::uint32_t first_instance = 0;  ///< number of the first instance
};
/// RenderPassEncoder::begin_occlusion_query().
struct BeginOcclusionQuery {
    std::uint32_t index = 0;  ///< its place in the pass's query set
};
/// RenderPassEncoder::end_occlusion_query().
struct EndOcclusionQuery {};
/// push_debug_group() of an encoder.
struct PushDebugGroup {
    std::uint32_t label = 0;  ///< index into CommandBuffer::strings
};
/// pop_debug_group() of an encoder.
struct PopDebugGroup {};
/// CommandEncoder::copy_buffer_to_buffer().
struct CopyBufferToBuffer {
    BufferId source;                       ///< from
    std::uint64_t source_offset = 0;       ///< bytes
    BufferId destination;                  ///< to
    std::uint64_t destination_offset = 0;  ///< bytes
    std::uint64_t size = 0;                ///< bytes
};

}  // namespace cmd

/// One of the structs of cmd.
using Command =
    std::variant<cmd::BeginRenderPass, cmd::EndRenderPass, cmd::SetPipeline, cmd::SetBindGroup,
                 cmd::SetVertexBuffer, cmd::SetIndexBuffer, cmd::SetStencilReference,
                 cmd::SetBlendConstant, cmd::SetViewport, cmd::SetScissorRect, cmd::SetDepthBounds,
                 cmd::Draw, cmd::DrawIndexed, cmd::BeginOcclusionQuery, cmd::EndOcclusionQuery,
                 cmd::PushDebugGroup, cmd::PopDebugGroup, cmd::CopyBufferToBuffer>;

/// A finished recording: what Device::submit() takes.
struct CommandBuffer {
    std::string label;                   ///< its name in messages
    std::vector<Command> commands;       ///< in order
    std::vector<RenderPassDesc> passes;  ///< that commands name by number
    std::vector<std::string> strings;    ///< that commands name by number
};

}  // namespace gnomon::gpu
#pragma GCC visibility pop
