// SPDX-License-Identifier: MIT
//
// Translation of enumerations. The front end lets no value through that has no translation; the
// returns behind the switches are for the compiler.
#include "internal/conv.hpp"

namespace gnomon::webgpu {

namespace {

std::uint32_t flag_if(bool condition, std::uint32_t flag) { return condition ? flag : 0; }

}  // namespace

const char* to_webgpu(gpu::Format format) {
    switch (format) {
        case gpu::Format::Undefined: return "";
        case gpu::Format::R8Unorm: return "r8unorm";
        case gpu::Format::R8Uint: return "r8uint";
        case gpu::Format::R32Uint: return "r32uint";
        case gpu::Format::R32Float: return "r32float";
        case gpu::Format::Rgba8Unorm: return "rgba8unorm";
        case gpu::Format::Rgba8UnormSrgb: return "rgba8unorm-srgb";
        case gpu::Format::Rgba16Float: return "rgba16float";
        case gpu::Format::Rgba32Float: return "rgba32float";
        case gpu::Format::Rgba32Uint: return "rgba32uint";
        case gpu::Format::Depth32Float: return "depth32float";
        case gpu::Format::Depth24UnormStencil8: return "";
        case gpu::Format::Depth32FloatStencil8: return "depth32float-stencil8";
    }
    return "";
}

const char* to_webgpu(gpu::VertexFormat format) {
    switch (format) {
        case gpu::VertexFormat::Float32: return "float32";
        case gpu::VertexFormat::Float32x2: return "float32x2";
        case gpu::VertexFormat::Float32x3: return "float32x3";
        case gpu::VertexFormat::Float32x4: return "float32x4";
        case gpu::VertexFormat::Uint32: return "uint32";
        case gpu::VertexFormat::Unorm8x4: return "unorm8x4";
    }
    return "";
}

const char* to_webgpu(gpu::Aspect aspect) {
    switch (aspect) {
        case gpu::Aspect::Color: return "all";
        case gpu::Aspect::DepthOnly: return "depth-only";
        case gpu::Aspect::StencilOnly: return "stencil-only";
    }
    return "";
}

const char* to_webgpu(gpu::Compare compare) {
    switch (compare) {
        case gpu::Compare::Undefined:
        case gpu::Compare::Always: return "always";
        case gpu::Compare::Never: return "never";
        case gpu::Compare::Less: return "less";
        case gpu::Compare::Equal: return "equal";
        case gpu::Compare::LessEqual: return "less-equal";
        case gpu::Compare::Greater: return "greater";
        case gpu::Compare::NotEqual: return "not-equal";
        case gpu::Compare::GreaterEqual: return "greater-equal";
    }
    return "";
}

const char* to_webgpu(gpu::StencilOp op) {
    switch (op) {
        case gpu::StencilOp::Keep: return "keep";
        case gpu::StencilOp::Zero: return "zero";
        case gpu::StencilOp::Replace: return "replace";
        case gpu::StencilOp::Invert: return "invert";
        case gpu::StencilOp::IncrementClamp: return "increment-clamp";
        case gpu::StencilOp::DecrementClamp: return "decrement-clamp";
        case gpu::StencilOp::IncrementWrap: return "increment-wrap";
        case gpu::StencilOp::DecrementWrap: return "decrement-wrap";
    }
    return "";
}

const char* to_webgpu(gpu::PrimitiveTopology topology) {
    switch (topology) {
        case gpu::PrimitiveTopology::PointList: return "point-list";
        case gpu::PrimitiveTopology::LineList: return "line-list";
        case gpu::PrimitiveTopology::TriangleList: return "triangle-list";
    }
    return "";
}

const char* to_webgpu(gpu::FrontFace face) {
    switch (face) {
        case gpu::FrontFace::Ccw: return "ccw";
        case gpu::FrontFace::Cw: return "cw";
    }
    return "";
}

const char* to_webgpu(gpu::CullMode mode) {
    switch (mode) {
        case gpu::CullMode::None: return "none";
        case gpu::CullMode::Front: return "front";
        case gpu::CullMode::Back: return "back";
    }
    return "";
}

const char* to_webgpu(gpu::VertexStepMode mode) {
    switch (mode) {
        case gpu::VertexStepMode::Vertex: return "vertex";
        case gpu::VertexStepMode::Instance: return "instance";
    }
    return "";
}

const char* to_webgpu(gpu::BlendFactor factor) {
    switch (factor) {
        case gpu::BlendFactor::Zero: return "zero";
        case gpu::BlendFactor::One: return "one";
        case gpu::BlendFactor::Src: return "src";
        case gpu::BlendFactor::OneMinusSrc: return "one-minus-src";
        case gpu::BlendFactor::SrcAlpha: return "src-alpha";
        case gpu::BlendFactor::OneMinusSrcAlpha: return "one-minus-src-alpha";
        case gpu::BlendFactor::Dst: return "dst";
        case gpu::BlendFactor::OneMinusDst: return "one-minus-dst";
        case gpu::BlendFactor::DstAlpha: return "dst-alpha";
        case gpu::BlendFactor::OneMinusDstAlpha: return "one-minus-dst-alpha";
        case gpu::BlendFactor::Constant: return "constant";
        case gpu::BlendFactor::OneMinusConstant: return "one-minus-constant";
    }
    return "";
}

const char* to_webgpu(gpu::BlendOperation operation) {
    switch (operation) {
        case gpu::BlendOperation::Add: return "add";
        case gpu::BlendOperation::Subtract: return "subtract";
        case gpu::BlendOperation::ReverseSubtract: return "reverse-subtract";
        case gpu::BlendOperation::Min: return "min";
        case gpu::BlendOperation::Max: return "max";
    }
    return "";
}

const char* to_webgpu(gpu::AddressMode mode) {
    switch (mode) {
        case gpu::AddressMode::ClampToEdge: return "clamp-to-edge";
        case gpu::AddressMode::Repeat: return "repeat";
        case gpu::AddressMode::MirrorRepeat: return "mirror-repeat";
    }
    return "";
}

const char* to_webgpu(gpu::FilterMode mode) {
    switch (mode) {
        case gpu::FilterMode::Nearest: return "nearest";
        case gpu::FilterMode::Linear: return "linear";
    }
    return "";
}

const char* to_webgpu(gpu::QueryType type) {
    switch (type) {
        case gpu::QueryType::Occlusion: return "occlusion";
        case gpu::QueryType::Timestamp: return "timestamp";
    }
    return "";
}

std::uint32_t to_webgpu(gpu::BufferUsage usage) {
    std::uint32_t flags = 0;
    flags |= flag_if(gpu::has(usage, gpu::BufferUsage::CopySrc), 0x04);
    flags |= flag_if(gpu::has(usage, gpu::BufferUsage::CopyDst), 0x08);
    flags |= flag_if(gpu::has(usage, gpu::BufferUsage::Index), 0x10);
    flags |= flag_if(gpu::has(usage, gpu::BufferUsage::Vertex), 0x20);
    flags |= flag_if(gpu::has(usage, gpu::BufferUsage::Uniform), 0x40);
    return flags;
}

std::uint32_t to_webgpu(gpu::TextureUsage usage) {
    std::uint32_t flags = 0;
    flags |= flag_if(gpu::has(usage, gpu::TextureUsage::CopySrc), 0x01);
    flags |= flag_if(gpu::has(usage, gpu::TextureUsage::CopyDst), 0x02);
    flags |= flag_if(gpu::has(usage, gpu::TextureUsage::TextureBinding), 0x04);
    flags |= flag_if(gpu::has(usage, gpu::TextureUsage::RenderAttachment), 0x10);
    return flags;
}

std::uint32_t to_webgpu(gpu::ShaderStage stages) {
    std::uint32_t flags = 0;
    flags |= flag_if(gpu::has(stages, gpu::ShaderStage::Vertex), 0x1);
    flags |= flag_if(gpu::has(stages, gpu::ShaderStage::Fragment), 0x2);
    return flags;
}

std::uint32_t to_webgpu(gpu::ColorWrite mask) {
    std::uint32_t flags = 0;
    flags |= flag_if(gpu::has(mask, gpu::ColorWrite::Red), 0x1);
    flags |= flag_if(gpu::has(mask, gpu::ColorWrite::Green), 0x2);
    flags |= flag_if(gpu::has(mask, gpu::ColorWrite::Blue), 0x4);
    flags |= flag_if(gpu::has(mask, gpu::ColorWrite::Alpha), 0x8);
    return flags;
}

}  // namespace gnomon::webgpu
