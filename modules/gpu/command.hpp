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

namespace gnomon::gpu {

inline constexpr std::uint32_t max_bind_groups = 4;
inline constexpr std::uint32_t max_dynamic_offsets = 4;  ///< per bind group

namespace cmd {

struct BeginRenderPass {
    std::uint32_t pass = 0;  ///< index into CommandBuffer::passes
};
struct EndRenderPass {};
struct SetPipeline {
    RenderPipelineId pipeline;
};
struct SetBindGroup {
    std::uint32_t group = 0;
    BindGroupId bind_group;
    std::uint32_t dynamic_offset_count = 0;
    std::array<std::uint32_t, max_dynamic_offsets>
        dynamic_offsets{};  ///< bytes, in order of binding
};
struct SetVertexBuffer {
    std::uint32_t slot = 0;
    BufferId buffer;
    std::uint64_t offset = 0;
};
struct SetIndexBuffer {
    BufferId buffer;
    IndexFormat format = IndexFormat::Uint32;
    std::uint64_t offset = 0;
};
struct SetStencilReference {
    std::uint32_t reference = 0;
};
struct SetBlendConstant {
    Color color;
};
struct SetViewport {
    float x = 0, y = 0, width = 0, height = 0, min_depth = 0, max_depth = 1;
};
struct SetScissorRect {
    std::uint32_t x = 0, y = 0, width = 0, height = 0;
};
struct SetDepthBounds {
    float min = 0, max = 1;
};
struct Draw {
    std::uint32_t vertex_count = 0, instance_count = 1, first_vertex = 0, first_instance = 0;
};
struct DrawIndexed {
    std::uint32_t index_count = 0, instance_count = 1, first_index = 0;
    std::int32_t base_vertex = 0;
    std::uint32_t first_instance = 0;
};
struct BeginOcclusionQuery {
    std::uint32_t index = 0;
};
struct EndOcclusionQuery {};
struct PushDebugGroup {
    std::uint32_t label = 0;  ///< index into CommandBuffer::strings
};
struct PopDebugGroup {};
struct CopyBufferToBuffer {
    BufferId source;
    std::uint64_t source_offset = 0;
    BufferId destination;
    std::uint64_t destination_offset = 0;
    std::uint64_t size = 0;
};

}  // namespace cmd

using Command =
    std::variant<cmd::BeginRenderPass, cmd::EndRenderPass, cmd::SetPipeline, cmd::SetBindGroup,
                 cmd::SetVertexBuffer, cmd::SetIndexBuffer, cmd::SetStencilReference,
                 cmd::SetBlendConstant, cmd::SetViewport, cmd::SetScissorRect, cmd::SetDepthBounds,
                 cmd::Draw, cmd::DrawIndexed, cmd::BeginOcclusionQuery, cmd::EndOcclusionQuery,
                 cmd::PushDebugGroup, cmd::PopDebugGroup, cmd::CopyBufferToBuffer>;

struct CommandBuffer {
    std::string label;
    std::vector<Command> commands;
    std::vector<RenderPassDesc> passes;
    std::vector<std::string> strings;
};

}  // namespace gnomon::gpu
