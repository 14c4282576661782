// SPDX-License-Identifier: MIT
#include "internal/conv.hpp"

namespace gnomon::gl {

GlFormat to_gl(gpu::Format format) {
    using gpu::Format;
    switch (format) {
        case Format::R8Unorm: return {GL_R8, GL_RED, GL_UNSIGNED_BYTE};
        case Format::R8Uint: return {GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE};
        case Format::R32Uint: return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT};
        case Format::R32Float: return {GL_R32F, GL_RED, GL_FLOAT};
        case Format::Rgba8Unorm: return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};
        case Format::Rgba8UnormSrgb: return {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE};
        case Format::Rgba16Float: return {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT};
        case Format::Rgba32Float: return {GL_RGBA32F, GL_RGBA, GL_FLOAT};
        case Format::Rgba32Uint: return {GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT};
        case Format::Depth32Float: return {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT};
        case Format::Depth24UnormStencil8:
            return {GL_DEPTH24_STENCIL8, GL_DEPTH_COMPONENT, GL_FLOAT};
        case Format::Depth32FloatStencil8:
            return {GL_DEPTH32F_STENCIL8, GL_DEPTH_COMPONENT, GL_FLOAT};
        case Format::Undefined: break;
    }
    return {};
}

GlVertexFormat to_gl(gpu::VertexFormat format) {
    using gpu::VertexFormat;
    switch (format) {
        case VertexFormat::Float32: return {1, GL_FLOAT, GL_FALSE, false};
        case VertexFormat::Float32x2: return {2, GL_FLOAT, GL_FALSE, false};
        case VertexFormat::Float32x3: return {3, GL_FLOAT, GL_FALSE, false};
        case VertexFormat::Float32x4: return {4, GL_FLOAT, GL_FALSE, false};
        case VertexFormat::Uint32: return {1, GL_UNSIGNED_INT, GL_FALSE, true};
        case VertexFormat::Unorm8x4: return {4, GL_UNSIGNED_BYTE, GL_TRUE, false};
    }
    return {};
}

GLenum to_gl(gpu::Compare compare) {
    using gpu::Compare;
    switch (compare) {
        case Compare::Never: return GL_NEVER;
        case Compare::Less: return GL_LESS;
        case Compare::Equal: return GL_EQUAL;
        case Compare::LessEqual: return GL_LEQUAL;
        case Compare::Greater: return GL_GREATER;
        case Compare::NotEqual: return GL_NOTEQUAL;
        case Compare::GreaterEqual: return GL_GEQUAL;
        case Compare::Undefined:  // the front end lets it through where nothing is compared
        case Compare::Always: break;
    }
    return GL_ALWAYS;
}

GLenum to_gl(gpu::StencilOp op) {
    using gpu::StencilOp;
    switch (op) {
        case StencilOp::Zero: return GL_ZERO;
        case StencilOp::Replace: return GL_REPLACE;
        case StencilOp::Invert: return GL_INVERT;
        case StencilOp::IncrementClamp: return GL_INCR;
        case StencilOp::DecrementClamp: return GL_DECR;
        case StencilOp::IncrementWrap: return GL_INCR_WRAP;
        case StencilOp::DecrementWrap: return GL_DECR_WRAP;
        case StencilOp::Keep: break;
    }
    return GL_KEEP;
}

GLenum to_gl(gpu::PrimitiveTopology topology) {
    switch (topology) {
        case gpu::PrimitiveTopology::PointList: return GL_POINTS;
        case gpu::PrimitiveTopology::LineList: return GL_LINES;
        case gpu::PrimitiveTopology::TriangleList: break;
    }
    return GL_TRIANGLES;
}

// Vertex stages end by negating y (RenderState::begin says why), which turns every triangle over.
GLenum to_gl(gpu::FrontFace face) { return face == gpu::FrontFace::Ccw ? GL_CW : GL_CCW; }

GLenum to_gl(gpu::IndexFormat format) {
    return format == gpu::IndexFormat::Uint16 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT;
}

GLenum to_gl(gpu::BlendFactor factor, bool alpha) {
    using gpu::BlendFactor;
    switch (factor) {
        case BlendFactor::Zero: return GL_ZERO;
        case BlendFactor::One: return GL_ONE;
        case BlendFactor::Src: return alpha ? GL_SRC_ALPHA : GL_SRC_COLOR;
        case BlendFactor::OneMinusSrc:
            return alpha ? GL_ONE_MINUS_SRC_ALPHA : GL_ONE_MINUS_SRC_COLOR;
        case BlendFactor::SrcAlpha: return GL_SRC_ALPHA;
        case BlendFactor::OneMinusSrcAlpha: return GL_ONE_MINUS_SRC_ALPHA;
        case BlendFactor::Dst: return alpha ? GL_DST_ALPHA : GL_DST_COLOR;
        case BlendFactor::OneMinusDst:
            return alpha ? GL_ONE_MINUS_DST_ALPHA : GL_ONE_MINUS_DST_COLOR;
        case BlendFactor::DstAlpha: return GL_DST_ALPHA;
        case BlendFactor::OneMinusDstAlpha: return GL_ONE_MINUS_DST_ALPHA;
        case BlendFactor::Constant: return alpha ? GL_CONSTANT_ALPHA : GL_CONSTANT_COLOR;
        case BlendFactor::OneMinusConstant:
            return alpha ? GL_ONE_MINUS_CONSTANT_ALPHA : GL_ONE_MINUS_CONSTANT_COLOR;
    }
    return GL_ZERO;
}

GLenum to_gl(gpu::BlendOperation operation) {
    using gpu::BlendOperation;
    switch (operation) {
        case BlendOperation::Subtract: return GL_FUNC_SUBTRACT;
        case BlendOperation::ReverseSubtract: return GL_FUNC_REVERSE_SUBTRACT;
        case BlendOperation::Min: return GL_MIN;
        case BlendOperation::Max: return GL_MAX;
        case BlendOperation::Add: break;
    }
    return GL_FUNC_ADD;
}

GLint to_gl(gpu::AddressMode mode) {
    switch (mode) {
        case gpu::AddressMode::Repeat: return GL_REPEAT;
        case gpu::AddressMode::MirrorRepeat: return GL_MIRRORED_REPEAT;
        case gpu::AddressMode::ClampToEdge: break;
    }
    return GL_CLAMP_TO_EDGE;
}

GLint to_gl(gpu::FilterMode filter) {
    return filter == gpu::FilterMode::Linear ? GL_LINEAR : GL_NEAREST;
}

GLint minification(gpu::FilterMode within, gpu::FilterMode between) {
    if (between == gpu::FilterMode::Linear) {
        return within == gpu::FilterMode::Linear ? GL_LINEAR_MIPMAP_LINEAR
                                                 : GL_NEAREST_MIPMAP_LINEAR;
    }
    return within == gpu::FilterMode::Linear ? GL_LINEAR_MIPMAP_NEAREST : GL_NEAREST_MIPMAP_NEAREST;
}

GLenum depth_stencil_attachment(gpu::Format format) {
    return gpu::has_stencil(format) ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
}

}  // namespace gnomon::gl
