// SPDX-License-Identifier: MIT
//
// The vocabulary of the GPU interface: WebGPU's words, defaults and limits as plain C++
// enumerations. What differs from WebGPU, and why, is listed in docs/backends.md.
#pragma once

#include <cstddef>
#include <cstdint>

namespace gnomon::gpu {

enum class Format : std::uint8_t {
    Undefined,
    R8Unorm,
    R8Uint,
    R32Uint,
    R32Float,
    Rgba8Unorm,
    Rgba8UnormSrgb,
    Rgba16Float,
    Rgba32Float,
    Rgba32Uint,
    Depth32Float,
    Depth24UnormStencil8,
    Depth32FloatStencil8,
};

[[nodiscard]] constexpr bool has_depth(Format f) { return f >= Format::Depth32Float; }
[[nodiscard]] constexpr bool has_stencil(Format f) { return f >= Format::Depth24UnormStencil8; }
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
enum class Aspect : std::uint8_t { Color, DepthOnly, StencilOnly };

enum class Compare : std::uint8_t {
    Undefined,  ///< no default where one would hide a mistake: the caller states the direction of
                ///< depth
    Never,
    Less,
    Equal,
    LessEqual,
    Greater,
    NotEqual,
    GreaterEqual,
    Always,
};

enum class StencilOp : std::uint8_t {
    Keep,
    Zero,
    Replace,
    Invert,
    IncrementClamp,
    DecrementClamp,
    IncrementWrap,
    DecrementWrap,
};

/// What of clip space is drawn, in z / w.
enum class ClipDepth : std::uint8_t {
    ZeroToOne,      ///< into every texture of a device's own
    MinusOneToOne,  ///< into what a host draws into by OpenGL's own convention
};

enum class PrimitiveTopology : std::uint8_t { PointList, LineList, TriangleList };
enum class FrontFace : std::uint8_t { Ccw, Cw };
enum class CullMode : std::uint8_t { None, Front, Back };
enum class IndexFormat : std::uint8_t { Uint16, Uint32 };
enum class VertexFormat : std::uint8_t {
    Float32,
    Float32x2,
    Float32x3,
    Float32x4,
    Uint32,
    Unorm8x4
};
enum class VertexStepMode : std::uint8_t { Vertex, Instance };

[[nodiscard]] constexpr std::uint32_t vertex_format_bytes(VertexFormat f) {
    switch (f) {
        case VertexFormat::Float32x2: return 8;
        case VertexFormat::Float32x3: return 12;
        case VertexFormat::Float32x4: return 16;
        default: return 4;
    }
}

enum class BlendFactor : std::uint8_t {
    Zero,
    One,
    Src,
    OneMinusSrc,
    SrcAlpha,
    OneMinusSrcAlpha,
    Dst,
    OneMinusDst,
    DstAlpha,
    OneMinusDstAlpha,
    Constant,
    OneMinusConstant,
};
enum class BlendOperation : std::uint8_t { Add, Subtract, ReverseSubtract, Min, Max };

enum class LoadOp : std::uint8_t { Load, Clear };
enum class StoreOp : std::uint8_t { Store, Discard };
enum class AddressMode : std::uint8_t { ClampToEdge, Repeat, MirrorRepeat };
enum class FilterMode : std::uint8_t { Nearest, Linear };
enum class QueryType : std::uint8_t {
    Occlusion,  ///< samples that passed depth and stencil; exact, not merely zero or not
    Timestamp,  ///< nanoseconds
};
enum class SampleType : std::uint8_t { Float, Uint, Depth };
enum class BindingType : std::uint8_t {
    UniformBuffer,
    SampledTexture,  ///< a texture and the sampler it is read with: one binding, as GL has it
};

/// Bit sets. `BufferUsage::Vertex | BufferUsage::CopyDst`.
enum class BufferUsage : std::uint32_t {
    None = 0,
    CopySrc = 1,
    CopyDst = 2,  ///< write_buffer may be used on it
    Index = 4,
    Vertex = 8,
    Uniform = 16,
};
enum class TextureUsage : std::uint32_t {
    None = 0,
    CopySrc = 1,  ///< read_texture and present may be used on it
    CopyDst = 2,  ///< write_texture may be used on it
    TextureBinding = 4,
    RenderAttachment = 8,
};
enum class ShaderStage : std::uint32_t { None = 0, Vertex = 1, Fragment = 2 };
enum class ColorWrite : std::uint32_t {
    None = 0,
    Red = 1,
    Green = 2,
    Blue = 4,
    Alpha = 8,
    All = 15
};

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
