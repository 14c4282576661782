// SPDX-License-Identifier: MIT
#include "internal/wording.hpp"

#include <initializer_list>

namespace gnomon::gpu {

namespace {

template <class Bits>
std::string join_bits(Bits set,
                      std::initializer_list<std::pair<Bits, std::string_view>> vocabulary) {
    std::string text;
    auto unknown = static_cast<std::uint32_t>(set);
    const auto append = [&text](std::string_view word) {
        if (!text.empty()) text += " | ";
        text += word;
    };
    for (const auto& [bit, word] : vocabulary) {
        if (!has(set, bit)) continue;
        append(word);
        unknown &= ~static_cast<std::uint32_t>(bit);
    }
    if (unknown != 0) append(fmt::format("{:#x}", unknown));
    return text.empty() ? "None" : text;
}

}  // namespace

std::string object_name(std::string_view kind, std::string_view label) {
    return label.empty() ? fmt::format("[{}]", kind) : fmt::format("[{} \"{}\"]", kind, label);
}

std::string_view to_text(Format format) {
    switch (format) {
        case Format::Undefined: return "Undefined";
        case Format::R8Unorm: return "R8Unorm";
        case Format::R8Uint: return "R8Uint";
        case Format::R32Uint: return "R32Uint";
        case Format::R32Float: return "R32Float";
        case Format::Rgba8Unorm: return "Rgba8Unorm";
        case Format::Rgba8UnormSrgb: return "Rgba8UnormSrgb";
        case Format::Rgba16Float: return "Rgba16Float";
        case Format::Rgba32Float: return "Rgba32Float";
        case Format::Rgba32Uint: return "Rgba32Uint";
        case Format::Depth32Float: return "Depth32Float";
        case Format::Depth24UnormStencil8: return "Depth24UnormStencil8";
        case Format::Depth32FloatStencil8: return "Depth32FloatStencil8";
    }
    return "unknown";
}

std::string_view to_text(Aspect aspect) {
    switch (aspect) {
        case Aspect::Color: return "Color";
        case Aspect::DepthOnly: return "DepthOnly";
        case Aspect::StencilOnly: return "StencilOnly";
    }
    return "unknown";
}

std::string_view to_text(SampleType type) {
    switch (type) {
        case SampleType::Float: return "Float";
        case SampleType::Uint: return "Uint";
        case SampleType::Depth: return "Depth";
    }
    return "unknown";
}

std::string_view to_text(QueryType type) {
    return type == QueryType::Occlusion ? "Occlusion" : "Timestamp";
}

std::string_view to_text(BindingType type) {
    return type == BindingType::UniformBuffer ? "UniformBuffer" : "SampledTexture";
}

std::string to_text(BufferUsage usage) {
    return join_bits<BufferUsage>(usage, {{BufferUsage::CopySrc, "CopySrc"},
                                          {BufferUsage::CopyDst, "CopyDst"},
                                          {BufferUsage::Index, "Index"},
                                          {BufferUsage::Vertex, "Vertex"},
                                          {BufferUsage::Uniform, "Uniform"}});
}

std::string to_text(TextureUsage usage) {
    return join_bits<TextureUsage>(usage, {{TextureUsage::CopySrc, "CopySrc"},
                                           {TextureUsage::CopyDst, "CopyDst"},
                                           {TextureUsage::TextureBinding, "TextureBinding"},
                                           {TextureUsage::RenderAttachment, "RenderAttachment"}});
}

std::string to_text(ShaderStage stages) {
    return join_bits<ShaderStage>(
        stages, {{ShaderStage::Vertex, "Vertex"}, {ShaderStage::Fragment, "Fragment"}});
}

}  // namespace gnomon::gpu
