// SPDX-License-Identifier: MIT
//
// The vocabulary of the GPU interface: WebGPU's words, defaults and limits as plain C++
// enumerations. What differs from WebGPU, and why, is listed in docs/backends.md.
#pragma once

#include <cstddef>
#include <cstdint>

#pragma GCC visibility push(default)
namespace gnomon::gpu {

/// What a texel holds.
enum class Format : std::uint8_t {
    Undefined,             ///< no format: not said
    R8Unorm,               ///< red, bytes as 0 .. 1
    R8Uint,                ///< red, bytes as numbers
    R32Uint,               ///< red, 32-bit numbers
    R32Float,              ///< red, 32-bit floats
    Rgba8Unorm,            ///< bytes as 0 .. 1
    Rgba8UnormSrgb,        ///< bytes, encoded as sRGB when written and decoded when read
    Rgba16Float,           ///< 16-bit floats
    Rgba32Float,           ///< 32-bit floats
    Rgba32Uint,            ///< 32-bit numbers
    Depth32Float,          ///< depth in 32-bit floats, no stencil
    Depth24UnormStencil8,  ///< depth in 24-bit integers; Features::depth24unorm_stencil8
    Depth32FloatStencil8,  ///< depth in 32-bit floats; Features::depth32float_stencil8
};

/// Whether texels hold depth.
[[nodiscard]] constexpr bool has_depth(Format f) { return f >= Format::Depth32Float; }
/// Whether texels hold a stencil of eight bits.
[[nodiscard]] constexpr bool has_stencil(Format f) { return f >= Format::Depth24UnormStencil8; }
/// Whether texels hold colour.
[[nodiscard]] constexpr bool has_color(Format f) {
    return f != Format::Undefined && f < Format::Depth32Float;
}
/// True for formats a shader reads as unsigned integers.
[[nodiscard]] constexpr bool is_uint(Format f) {
    return f == Format::R8Uint || f == Format::R32Uint || f == Format::Rgba32Uint;
}

/// Bytes of one texel of a colour format, as write_texture and read_texture pack it. 0 for
/// depth-stencil formats.
[[nodiscard]] constexpr std::uint32_t texel_bytes(Format f) {
    switch (f) {
        case Format::R8Unorm:
        case Format::R8Uint: return 1;
        case Format::R32Uint:
        case Format::R32Float:
        case Format::Rgba8Unorm:
        case Format::Rgba8UnormSrgb: return 4;
        case Format::Rgba16Float: return 8;
        case Format::Rgba32Float:
        case Format::Rgba32Uint: return 16;
        default: return 0;
    }
}

/// Which part of a texture is meant. Reading DepthOnly gives 32-bit floats, StencilOnly gives
/// bytes.
enum class Aspect : std::uint8_t {
    Color,        ///< of a colour format
    DepthOnly,    ///< of a format with depth
    StencilOnly,  ///< of a format with a stencil
};

/// What passes: the new value compared with the stored one, as in "new Less stored".
enum class Compare : std::uint8_t {
    Undefined,  ///< no default where one would hide a mistake: the caller states the direction of
                ///< depth
    Never,      ///< nothing passes
    Less,       ///< less than what is stored
    Equal,      ///< equal to it
    LessEqual,  ///< less or equal
    Greater,    ///< greater
    NotEqual,   ///< not equal
    GreaterEqual,  ///< greater or equal
    Always,        ///< everything passes
};

/// What becomes of a stored stencil value.
enum class StencilOp : std::uint8_t {
    Keep,            ///< stays
    Zero,            ///< becomes 0
    Replace,         ///< becomes the reference
    Invert,          ///< each bit turned over
    IncrementClamp,  ///< one more, 255 at most
    DecrementClamp,  ///< one less, 0 at least
    IncrementWrap,   ///< one more, 255 becomes 0
    DecrementWrap,   ///< one less, 0 becomes 255
};

/// What of clip space is drawn, in z / w.
enum class ClipDepth : std::uint8_t {
    ZeroToOne,      ///< into every texture of a device's own
    MinusOneToOne,  ///< into what a host draws into by OpenGL's own convention
};

/// What vertices are put together to.
enum class PrimitiveTopology : std::uint8_t {
    PointList,     ///< each vertex a point of one pixel
    LineList,      ///< two vertices a line
    TriangleList,  ///< three vertices a triangle
};
/// Which triangles are front faces, as they are seen with y up.
enum class FrontFace : std::uint8_t {
    Ccw,  ///< the counter-clockwise ones
    Cw,   ///< the clockwise ones
};
/// Which triangles are not drawn.
enum class CullMode : std::uint8_t {
    None,   ///< all are drawn
    Front,  ///< front faces are not
    Back,   ///< back faces are not
};
/// What an index buffer holds.
enum class IndexFormat : std::uint8_t {
    Uint16,  ///< two bytes an index
    Uint32,  ///< four bytes an index
};
/// What an attribute is in the vertex buffer.
enum class VertexFormat : std::uint8_t {
    Float32,    ///< one 32-bit float
    Float32x2,  ///< two
    Float32x3,  ///< three
    Float32x4,  ///< four
    Uint32,     ///< one 32-bit number, an integer in the shader
    Unorm8x4,   ///< four bytes, 0 .. 1 in the shader
};
/// With what a vertex buffer advances.
enum class VertexStepMode : std::uint8_t {
    Vertex,    ///< an element a vertex
    Instance,  ///< an element an instance
};

/// Bytes of one attribute.
[[nodiscard]] constexpr std::uint32_t vertex_format_bytes(VertexFormat f) {
    switch (f) {
        case VertexFormat::Float32x2: return 8;
        case VertexFormat::Float32x3: return 12;
        case VertexFormat::Float32x4: return 16;
        default: return 4;
    }
}

/// What a colour is multiplied with before BlendOperation: the source is what the shader gives, the
/// destination what is stored.
enum class BlendFactor : std::uint8_t {
    Zero,              ///< 0
    One,               ///< 1
    Src,               ///< the source's colour
    OneMinusSrc,       ///< 1 less that
    SrcAlpha,          ///< the source's alpha
    OneMinusSrcAlpha,  ///< 1 less that
    Dst,               ///< the destination's colour
    OneMinusDst,       ///< 1 less that
    DstAlpha,          ///< the destination's alpha
    OneMinusDstAlpha,  ///< 1 less that
    Constant,          ///< RenderPassEncoder::set_blend_constant()
    OneMinusConstant,  ///< 1 less that
};
/// How the two are put together.
enum class BlendOperation : std::uint8_t {
    Add,              ///< source + destination
    Subtract,         ///< source - destination
    ReverseSubtract,  ///< destination - source
    Min,              ///< the less of the two, factors aside
    Max,              ///< the greater of the two, factors aside
};

/// What an attachment holds when a pass begins.
enum class LoadOp : std::uint8_t {
    Load,   ///< what it held before
    Clear,  ///< the clear value
};
/// What an attachment holds when a pass has ended.
enum class StoreOp : std::uint8_t {
    Store,    ///< what was drawn
    Discard,  ///< zero, as far as anybody can tell
};
/// What lies beyond a texture's edges.
enum class AddressMode : std::uint8_t {
    ClampToEdge,   ///< the texels at the edge
    Repeat,        ///< the texture again
    MirrorRepeat,  ///< the texture again, every other time mirrored
};
/// What lies between texels.
enum class FilterMode : std::uint8_t {
    Nearest,  ///< the nearest texel
    Linear,   ///< a mean of the neighbours
};
/// What a query counts.
enum class QueryType : std::uint8_t {
    Occlusion,  ///< samples that passed depth and stencil; exact, not merely zero or not
    Timestamp,  ///< nanoseconds
};
/// What a shader reads of a texture.
enum class SampleType : std::uint8_t {
    Float,  ///< sampler2D of a colour
    Uint,   ///< usampler2D: integer formats and the stencil
    Depth,  ///< sampler2D of depth; no comparison
};
/// What a binding is.
enum class BindingType : std::uint8_t {
    UniformBuffer,   ///< a uniform block
    SampledTexture,  ///< a texture and the sampler it is read with: one binding, as GL has it
};

/// Bit sets. `BufferUsage::Vertex | BufferUsage::CopyDst`.
enum class BufferUsage : std::uint32_t {
    None = 0,     ///< nothing
    CopySrc = 1,  ///< read_buffer and copies from it
    CopyDst = 2,  ///< write_buffer may be used on it, and copies to it
    Index = 4,    ///< set_index_buffer
    Vertex = 8,   ///< set_vertex_buffer
    Uniform = 16  ///< BindingType::UniformBuffer
};
/// Bit sets: what a texture is for.
enum class TextureUsage : std::uint32_t {
    None = 0,              ///< nothing
    CopySrc = 1,           ///< read_texture and present may be used on it
    CopyDst = 2,           ///< write_texture may be used on it
    TextureBinding = 4,    ///< BindingType::SampledTexture
    RenderAttachment = 8,  ///< drawn to
};
/// Bit sets: which stages.
enum class ShaderStage : std::uint32_t {
    None = 0,      ///< none
    Vertex = 1,    ///< vertex shaders
    Fragment = 2,  ///< fragment shaders
};
/// Bit sets: which channels of a colour are written.
enum class ColorWrite : std::uint32_t {
    None = 0,   ///< none
    Red = 1,    ///< red
    Green = 2,  ///< green
    Blue = 4,   ///< blue
    Alpha = 8,  ///< alpha
    All = 15    ///< all four
};

/// Gives an enumeration of bits its operators. Gone after this header.
#define GNOMON_GPU_BIT_SET(Type)                                                                 \
    [[nodiscard]] constexpr Type operator|(Type a, Type b) {                                     \
        return static_cast<Type>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b)); \
    }                                                                                            \
    [[nodiscard]] constexpr bool has(Type set, Type bit) {                                       \
        return (static_cast<std::uint32_t>(set) & static_cast<std::uint32_t>(bit)) != 0;         \
    }
GNOMON_GPU_BIT_SET(BufferUsage)
GNOMON_GPU_BIT_SET(TextureUsage)
GNOMON_GPU_BIT_SET(ShaderStage)
GNOMON_GPU_BIT_SET(ColorWrite)
#undef GNOMON_GPU_BIT_SET

}  // namespace gnomon::gpu
#pragma GCC visibility pop
