// SPDX-License-Identifier: MIT
//
// Descriptors: plain structs from which GPU objects are made. Every field has WebGPU's default;
// every object has a label, which is how error messages name it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gnomon/gpu/handle.hpp>
#include <gnomon/gpu/shader_source.hpp>
#include <gnomon/gpu/types.hpp>

namespace gnomon::gpu {

struct BufferDesc {
    std::string label = {};
    std::uint64_t size = 0;  ///< bytes, a multiple of 4
    BufferUsage usage = BufferUsage::None;
};

struct TextureDesc {
    std::string label = {};
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    Format format = Format::Undefined;
    TextureUsage usage = TextureUsage::None;
    std::uint32_t mip_level_count = 1;
    std::uint32_t sample_count = 1;  ///< 1 or 4
};

struct SamplerDesc {
    std::string label = {};
    AddressMode address_mode_u = AddressMode::ClampToEdge;
    AddressMode address_mode_v = AddressMode::ClampToEdge;
    FilterMode mag_filter = FilterMode::Nearest;
    FilterMode min_filter = FilterMode::Nearest;
    FilterMode mipmap_filter = FilterMode::Nearest;
};

struct ShaderDesc {
    std::string label = {};
    ShaderStage stage = ShaderStage::None;  ///< exactly one
    ShaderSource source = {};  ///< must outlive the call, not the shader; entry point "main"
};

struct BindGroupLayoutEntry {
    std::uint32_t binding =
        0;  ///< unique across all groups of a pipeline: desktop GL has no descriptor sets
    ShaderStage visibility = ShaderStage::None;
    BindingType type = BindingType::UniformBuffer;
    // for UniformBuffer
    bool has_dynamic_offset = false;
    std::uint64_t min_binding_size = 0;
    // for SampledTexture
    SampleType sample_type = SampleType::Float;
    bool multisampled = false;
    bool operator==(const BindGroupLayoutEntry&) const = default;
};

struct BindGroupLayoutDesc {
    std::string label = {};
    std::vector<BindGroupLayoutEntry> entries = {};
};

struct BindGroupEntry {
    std::uint32_t binding = 0;
    // for UniformBuffer
    BufferId buffer = {};
    std::uint64_t offset = 0;
    std::uint64_t size = 0;  ///< 0: to the buffer's end
    // for SampledTexture
    TextureId texture = {};
    SamplerId sampler =
        {};  ///< may be empty for multisampled and integer textures, which are only fetched
    Aspect aspect = Aspect::Color;
};

struct BindGroupDesc {
    std::string label = {};
    BindGroupLayoutId layout = {};
    std::vector<BindGroupEntry> entries = {};
};

struct VertexAttribute {
    VertexFormat format = VertexFormat::Float32x3;
    std::uint64_t offset = 0;
    std::uint32_t shader_location = 0;
};

struct VertexBufferLayout {
    std::uint64_t array_stride = 0;
    VertexStepMode step_mode = VertexStepMode::Vertex;
    std::vector<VertexAttribute> attributes = {};
};

struct StencilFaceState {
    Compare compare = Compare::Always;
    StencilOp fail_op = StencilOp::Keep;
    StencilOp depth_fail_op = StencilOp::Keep;
    StencilOp pass_op = StencilOp::Keep;
    bool operator==(const StencilFaceState&) const = default;
};

struct DepthStencilState {
    Format format = Format::Undefined;
    bool depth_write_enabled = false;
    Compare depth_compare = Compare::Undefined;
    StencilFaceState stencil_front = {};
    StencilFaceState stencil_back = {};
    std::uint32_t stencil_read_mask = 0xFF;
    std::uint32_t stencil_write_mask = 0xFF;
    std::int32_t depth_bias = 0;
    float depth_bias_slope_scale = 0.0F;
    float depth_bias_clamp = 0.0F;
    /// Samples whose stored depth is not within RenderPassEncoder::set_depth_bounds() are left
    /// alone, stencil included. Needs Features::depth_bounds.
    bool depth_bounds_test = false;
};

struct BlendComponent {
    BlendFactor src_factor = BlendFactor::One;
    BlendFactor dst_factor = BlendFactor::Zero;
    BlendOperation operation = BlendOperation::Add;
};

struct BlendState {
    BlendComponent color = {};
    BlendComponent alpha = {};
};

struct ColorTargetState {
    Format format = Format::Undefined;
    std::optional<BlendState> blend = std::nullopt;
    ColorWrite write_mask = ColorWrite::All;
};

struct PrimitiveState {
    PrimitiveTopology topology = PrimitiveTopology::TriangleList;
    FrontFace front_face = FrontFace::Ccw;
    CullMode cull_mode = CullMode::None;
    bool unclipped_depth = false;  ///< needs Features::unclipped_depth
};

struct RenderPipelineDesc {
    std::string label = {};
    std::vector<BindGroupLayoutId> bind_group_layouts = {};
    ShaderId vertex = {};
    ShaderId fragment = {};  ///< may be empty where no colour is written
    std::vector<VertexBufferLayout> vertex_buffers = {};
    PrimitiveState primitive = {};
    std::optional<DepthStencilState> depth_stencil = std::nullopt;
    std::vector<ColorTargetState> targets = {};
    std::uint32_t sample_count = 1;
};

struct QuerySetDesc {
    std::string label = {};
    QueryType type = QueryType::Occlusion;
    std::uint32_t count = 0;
};

struct Color {
    double r = 0.0, g = 0.0, b = 0.0, a = 0.0;
};

struct ColorAttachment {
    TextureId texture = {};
    TextureId resolve_target =
        {};  ///< single-sampled, same size and format; written when the pass ends
    LoadOp load_op = LoadOp::Load;
    StoreOp store_op = StoreOp::Store;
    Color clear_value = {};
};

struct DepthStencilAttachment {
    TextureId texture = {};
    LoadOp depth_load_op = LoadOp::Load;
    StoreOp depth_store_op = StoreOp::Store;
    float depth_clear_value = 0.0F;  ///< 0 is far: depth is reversed here
    bool depth_read_only = false;
    LoadOp stencil_load_op = LoadOp::Load;
    StoreOp stencil_store_op = StoreOp::Store;
    std::uint32_t stencil_clear_value = 0;
    bool stencil_read_only = false;
};

struct TimestampWrites {
    QuerySetId query_set = {};
    std::uint32_t beginning_index = 0;
    std::uint32_t end_index = 1;
};

struct RenderPassDesc {
    std::string label = {};
    std::vector<ColorAttachment> color_attachments = {};
    std::optional<DepthStencilAttachment> depth_stencil = std::nullopt;
    QuerySetId occlusion_query_set = {};
    std::optional<TimestampWrites> timestamp_writes = std::nullopt;
};

}  // namespace gnomon::gpu
