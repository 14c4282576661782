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

#pragma GCC visibility push(default)
namespace gnomon::gpu {

/// Memory of the device.
struct BufferDesc {
    std::string label = {};                 ///< how messages name it
    std::uint64_t size = 0;                 ///< bytes, a multiple of 4
    BufferUsage usage = BufferUsage::None;  ///< all it will be used for
};

/// A picture of the device: colour, or depth and stencil.
struct TextureDesc {
    std::string label = {};                   ///< how messages name it
    std::uint32_t width = 0;                  ///< texels
    std::uint32_t height = 0;                 ///< texels
    Format format = Format::Undefined;        ///< of its texels
    TextureUsage usage = TextureUsage::None;  ///< all it will be used for
    std::uint32_t mip_level_count = 1;        ///< 1 for attachments
    std::uint32_t sample_count = 1;           ///< 1 or 4
};

/// How a texture is read between and beyond its texels.
struct SamplerDesc {
    std::string label = {};                                 ///< how messages name it
    AddressMode address_mode_u = AddressMode::ClampToEdge;  ///< to the left and right
    AddressMode address_mode_v = AddressMode::ClampToEdge;  ///< above and below
    FilterMode mag_filter = FilterMode::Nearest;            ///< where texels are larger than pixels
    FilterMode min_filter = FilterMode::Nearest;            ///< where they are smaller
    FilterMode mipmap_filter = FilterMode::Nearest;         ///< between mip levels
};

/// A shader of one stage.
struct ShaderDesc {
    std::string label = {};                 ///< how messages name it
    ShaderStage stage = ShaderStage::None;  ///< exactly one
    ShaderSource source = {};  ///< must outlive the call, not the shader; entry point "main"
};

/// One binding of a layout.
struct BindGroupLayoutEntry {
    std::uint32_t binding =
        0;  ///< unique across all groups of a pipeline: desktop GL has no descriptor sets
    ShaderStage visibility = ShaderStage::None;     ///< the stages that read it
    BindingType type = BindingType::UniformBuffer;  ///< a buffer or a texture
    // for UniformBuffer
    bool has_dynamic_offset = false;     ///< set_bind_group() says where in the buffer
    std::uint64_t min_binding_size = 0;  ///< bytes that the shader reads
    // for SampledTexture
    SampleType sample_type = SampleType::Float;  ///< what the shader reads
    bool multisampled = false;                   ///< sampler2DMS
    bool operator==(const BindGroupLayoutEntry&) const = default;
};

/// What a shader expects in one group.
struct BindGroupLayoutDesc {
    std::string label = {};                          ///< how messages name it
    std::vector<BindGroupLayoutEntry> entries = {};  ///< in any order
};

/// What one binding is bound to.
struct BindGroupEntry {
    std::uint32_t binding = 0;  ///< as in the layout
    // for UniformBuffer
    BufferId buffer = {};      ///< which one
    std::uint64_t offset = 0;  ///< bytes
    std::uint64_t size = 0;    ///< 0: to the buffer's end
    // for SampledTexture
    TextureId texture = {};  ///< which one
    SamplerId sampler =
        {};  ///< may be empty for multisampled and integer textures, which are only fetched
    Aspect aspect = Aspect::Color;  ///< what is read of it
};

/// Buffers and textures for one group.
struct BindGroupDesc {
    std::string label = {};                    ///< how messages name it
    BindGroupLayoutId layout = {};             ///< which it fits
    std::vector<BindGroupEntry> entries = {};  ///< one for each of the layout's
};

/// One input of a vertex shader.
struct VertexAttribute {
    VertexFormat format = VertexFormat::Float32x3;  ///< in the buffer
    std::uint64_t offset = 0;                       ///< bytes from the element's begin
    std::uint32_t shader_location = 0;              ///< as the shader declares it
};

/// The elements of one vertex buffer.
struct VertexBufferLayout {
    std::uint64_t array_stride = 0;                     ///< bytes from one element to the next
    VertexStepMode step_mode = VertexStepMode::Vertex;  ///< with what it advances
    std::vector<VertexAttribute> attributes = {};       ///< in any order
};

/// What is done to the stencil where one kind of face is drawn.
struct StencilFaceState {
    Compare compare = Compare::Always;          ///< the reference with what is stored
    StencilOp fail_op = StencilOp::Keep;        ///< where that fails
    StencilOp depth_fail_op = StencilOp::Keep;  ///< where depth fails
    StencilOp pass_op = StencilOp::Keep;        ///< where both pass
    bool operator==(const StencilFaceState&) const = default;
};

/// What is tested against depth and stencil, and what is written there.
struct DepthStencilState {
    Format format = Format::Undefined;           ///< of the attachment
    bool depth_write_enabled = false;            ///< where it passes
    Compare depth_compare = Compare::Undefined;  ///< Greater is nearer: depth is reversed here
    StencilFaceState stencil_front = {};         ///< for front faces, points and lines
    StencilFaceState stencil_back = {};          ///< for back faces
    std::uint32_t stencil_read_mask = 0xFF;      ///< bits that are compared
    std::uint32_t stencil_write_mask = 0xFF;     ///< bits that are written
    std::int32_t depth_bias = 0;                 ///< in steps of the format's, as WebGPU has it
    float depth_bias_slope_scale = 0.0F;         ///< times the greater slope of depth
    float depth_bias_clamp = 0.0F;               ///< the most of it; 0: no limit
    /// Samples whose stored depth is not within RenderPassEncoder::set_depth_bounds() are left
    /// alone, stencil included. Needs Features::depth_bounds.
    bool depth_bounds_test = false;
};

/// How one colour comes of two.
struct BlendComponent {
    BlendFactor src_factor = BlendFactor::One;       ///< of what is drawn
    BlendFactor dst_factor = BlendFactor::Zero;      ///< of what is stored
    BlendOperation operation = BlendOperation::Add;  ///< of the two products
};

/// For colour and alpha apart.
struct BlendState {
    BlendComponent color = {};  ///< of red, green and blue
    BlendComponent alpha = {};  ///< of alpha
};

/// One colour attachment of a pipeline.
struct ColorTargetState {
    Format format = Format::Undefined;  ///< of the attachment
    std::optional<BlendState> blend =
        std::nullopt;                         ///< without it what is drawn replaces what was there
    ColorWrite write_mask = ColorWrite::All;  ///< channels that are written
};

/// How vertices become fragments.
struct PrimitiveState {
    PrimitiveTopology topology =
        PrimitiveTopology::TriangleList;    ///< what they are put together to
    FrontFace front_face = FrontFace::Ccw;  ///< which triangles are front faces
    CullMode cull_mode = CullMode::None;    ///< which are not drawn
    bool unclipped_depth = false;           ///< needs Features::unclipped_depth
};

/// Shaders and all state that does not change between draws.
struct RenderPipelineDesc {
    std::string label = {};                                  ///< how messages name it
    std::vector<BindGroupLayoutId> bind_group_layouts = {};  ///< by group
    ShaderId vertex = {};                                    ///< which one
    ShaderId fragment = {};  ///< may be empty where no colour is written
    std::vector<VertexBufferLayout> vertex_buffers = {};  ///< by slot
    PrimitiveState primitive = {};                        ///< how vertices become fragments
    std::optional<DepthStencilState> depth_stencil =
        std::nullopt;                            ///< without it passes have no such attachment
    std::vector<ColorTargetState> targets = {};  ///< by attachment
    std::uint32_t sample_count = 1;              ///< 1 or 4, that of the attachments
};

/// Places for what is counted.
struct QuerySetDesc {
    std::string label = {};                 ///< how messages name it
    QueryType type = QueryType::Occlusion;  ///< what is counted
    std::uint32_t count = 0;                ///< how many places
};

/// Linear; for integer formats the number itself.
struct Color {
    double r = 0.0;  ///< red
    double g = 0.0;  ///< green
    double b = 0.0;  ///< blue
    double a = 0.0;  ///< alpha
};

/// A texture that is drawn to.
struct ColorAttachment {
    TextureId texture = {};  ///< which one
    TextureId resolve_target =
        {};  ///< single-sampled, same size and format; written when the pass ends
    LoadOp load_op = LoadOp::Load;      ///< at the beginning
    StoreOp store_op = StoreOp::Store;  ///< at the end
    Color clear_value = {};             ///< for LoadOp::Clear
};

/// The texture that is tested against.
struct DepthStencilAttachment {
    TextureId texture = {};                     ///< which one
    LoadOp depth_load_op = LoadOp::Load;        ///< at the beginning
    StoreOp depth_store_op = StoreOp::Store;    ///< at the end
    float depth_clear_value = 0.0F;             ///< 0 is far: depth is reversed here
    bool depth_read_only = false;               ///< no pipeline of the pass writes depth
    LoadOp stencil_load_op = LoadOp::Load;      ///< at the beginning
    StoreOp stencil_store_op = StoreOp::Store;  ///< at the end
    std::uint32_t stencil_clear_value = 0;      ///< 0 .. 255, for LoadOp::Clear
    bool stencil_read_only = false;             ///< no pipeline of the pass writes the stencil
};

/// When a pass began and ended, in nanoseconds. Needs Features::timestamp_query.
struct TimestampWrites {
    QuerySetId query_set = {};          ///< of QueryType::Timestamp
    std::uint32_t beginning_index = 0;  ///< its place there
    std::uint32_t end_index = 1;        ///< its place there
};

/// What one pass draws to. All attachments have one size and sample count.
struct RenderPassDesc {
    std::string label = {};                                              ///< how messages name it
    std::vector<ColorAttachment> color_attachments = {};                 ///< by number
    std::optional<DepthStencilAttachment> depth_stencil = std::nullopt;  ///< may be missing
    QuerySetId occlusion_query_set = {};  ///< for begin_occlusion_query(); may be empty
    std::optional<TimestampWrites> timestamp_writes = std::nullopt;  ///< may be missing
};

}  // namespace gnomon::gpu
#pragma GCC visibility pop
