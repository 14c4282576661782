// SPDX-License-Identifier: MIT
//
// Translation of enumerations. The front end lets no value through that has no translation; the
// returns behind the switches are for the compiler.
#include "internal/conv.hpp"

namespace gnomon::vk {

namespace {

VkFlags flag_if(bool condition, VkFlags flag) { return condition ? flag : 0; }

}  // namespace

VkFormat to_vk(gpu::Format format) {
    switch (format) {
        case gpu::Format::Undefined: return VK_FORMAT_UNDEFINED;
        case gpu::Format::R8Unorm: return VK_FORMAT_R8_UNORM;
        case gpu::Format::R8Uint: return VK_FORMAT_R8_UINT;
        case gpu::Format::R32Uint: return VK_FORMAT_R32_UINT;
        case gpu::Format::R32Float: return VK_FORMAT_R32_SFLOAT;
        case gpu::Format::Rgba8Unorm: return VK_FORMAT_R8G8B8A8_UNORM;
        case gpu::Format::Rgba8UnormSrgb: return VK_FORMAT_R8G8B8A8_SRGB;
        case gpu::Format::Rgba16Float: return VK_FORMAT_R16G16B16A16_SFLOAT;
        case gpu::Format::Rgba32Float: return VK_FORMAT_R32G32B32A32_SFLOAT;
        case gpu::Format::Rgba32Uint: return VK_FORMAT_R32G32B32A32_UINT;
        case gpu::Format::Depth32Float: return VK_FORMAT_D32_SFLOAT;
        case gpu::Format::Depth24UnormStencil8: return VK_FORMAT_D24_UNORM_S8_UINT;
        case gpu::Format::Depth32FloatStencil8: return VK_FORMAT_D32_SFLOAT_S8_UINT;
    }
    return VK_FORMAT_UNDEFINED;
}

VkFormat to_vk(gpu::VertexFormat format) {
    switch (format) {
        case gpu::VertexFormat::Float32: return VK_FORMAT_R32_SFLOAT;
        case gpu::VertexFormat::Float32x2: return VK_FORMAT_R32G32_SFLOAT;
        case gpu::VertexFormat::Float32x3: return VK_FORMAT_R32G32B32_SFLOAT;
        case gpu::VertexFormat::Float32x4: return VK_FORMAT_R32G32B32A32_SFLOAT;
        case gpu::VertexFormat::Uint32: return VK_FORMAT_R32_UINT;
        case gpu::VertexFormat::Unorm8x4: return VK_FORMAT_R8G8B8A8_UNORM;
    }
    return VK_FORMAT_UNDEFINED;
}

VkImageAspectFlags aspects_of(gpu::Format format) {
    VkImageAspectFlags aspects = 0;
    aspects |= flag_if(gpu::has_color(format), VK_IMAGE_ASPECT_COLOR_BIT);
    aspects |= flag_if(gpu::has_depth(format), VK_IMAGE_ASPECT_DEPTH_BIT);
    aspects |= flag_if(gpu::has_stencil(format), VK_IMAGE_ASPECT_STENCIL_BIT);
    return aspects;
}

VkImageAspectFlags to_vk(gpu::Aspect aspect) {
    switch (aspect) {
        case gpu::Aspect::Color: return VK_IMAGE_ASPECT_COLOR_BIT;
        case gpu::Aspect::DepthOnly: return VK_IMAGE_ASPECT_DEPTH_BIT;
        case gpu::Aspect::StencilOnly: return VK_IMAGE_ASPECT_STENCIL_BIT;
    }
    return 0;
}

VkCompareOp to_vk(gpu::Compare compare) {
    switch (compare) {
        case gpu::Compare::Undefined:
        case gpu::Compare::Always: return VK_COMPARE_OP_ALWAYS;
        case gpu::Compare::Never: return VK_COMPARE_OP_NEVER;
        case gpu::Compare::Less: return VK_COMPARE_OP_LESS;
        case gpu::Compare::Equal: return VK_COMPARE_OP_EQUAL;
        case gpu::Compare::LessEqual: return VK_COMPARE_OP_LESS_OR_EQUAL;
        case gpu::Compare::Greater: return VK_COMPARE_OP_GREATER;
        case gpu::Compare::NotEqual: return VK_COMPARE_OP_NOT_EQUAL;
        case gpu::Compare::GreaterEqual: return VK_COMPARE_OP_GREATER_OR_EQUAL;
    }
    return VK_COMPARE_OP_ALWAYS;
}

VkStencilOp to_vk(gpu::StencilOp op) {
    switch (op) {
        case gpu::StencilOp::Keep: return VK_STENCIL_OP_KEEP;
        case gpu::StencilOp::Zero: return VK_STENCIL_OP_ZERO;
        case gpu::StencilOp::Replace: return VK_STENCIL_OP_REPLACE;
        case gpu::StencilOp::Invert: return VK_STENCIL_OP_INVERT;
        case gpu::StencilOp::IncrementClamp: return VK_STENCIL_OP_INCREMENT_AND_CLAMP;
        case gpu::StencilOp::DecrementClamp: return VK_STENCIL_OP_DECREMENT_AND_CLAMP;
        case gpu::StencilOp::IncrementWrap: return VK_STENCIL_OP_INCREMENT_AND_WRAP;
        case gpu::StencilOp::DecrementWrap: return VK_STENCIL_OP_DECREMENT_AND_WRAP;
    }
    return VK_STENCIL_OP_KEEP;
}

VkPrimitiveTopology to_vk(gpu::PrimitiveTopology topology) {
    switch (topology) {
        case gpu::PrimitiveTopology::PointList: return VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
        case gpu::PrimitiveTopology::LineList: return VK_PRIMITIVE_TOPOLOGY_LINE_LIST;
        case gpu::PrimitiveTopology::TriangleList: return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    }
    return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
}

// Vertex stages negate y, which turns Vulkan's y round, so the words need not be swapped.
VkFrontFace to_vk(gpu::FrontFace face) {
    return face == gpu::FrontFace::Ccw ? VK_FRONT_FACE_COUNTER_CLOCKWISE : VK_FRONT_FACE_CLOCKWISE;
}

VkCullModeFlags to_vk(gpu::CullMode mode) {
    switch (mode) {
        case gpu::CullMode::None: return VK_CULL_MODE_NONE;
        case gpu::CullMode::Front: return VK_CULL_MODE_FRONT_BIT;
        case gpu::CullMode::Back: return VK_CULL_MODE_BACK_BIT;
    }
    return VK_CULL_MODE_NONE;
}

VkIndexType to_vk(gpu::IndexFormat format) {
    return format == gpu::IndexFormat::Uint16 ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32;
}

VkVertexInputRate to_vk(gpu::VertexStepMode mode) {
    return mode == gpu::VertexStepMode::Vertex ? VK_VERTEX_INPUT_RATE_VERTEX
                                               : VK_VERTEX_INPUT_RATE_INSTANCE;
}

// Used for the alpha component too, where Vulkan takes the alpha of a colour factor.
VkBlendFactor to_vk(gpu::BlendFactor factor) {
    switch (factor) {
        case gpu::BlendFactor::Zero: return VK_BLEND_FACTOR_ZERO;
        case gpu::BlendFactor::One: return VK_BLEND_FACTOR_ONE;
        case gpu::BlendFactor::Src: return VK_BLEND_FACTOR_SRC_COLOR;
        case gpu::BlendFactor::OneMinusSrc: return VK_BLEND_FACTOR_ONE_MINUS_SRC_COLOR;
        case gpu::BlendFactor::SrcAlpha: return VK_BLEND_FACTOR_SRC_ALPHA;
        case gpu::BlendFactor::OneMinusSrcAlpha: return VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
        case gpu::BlendFactor::Dst: return VK_BLEND_FACTOR_DST_COLOR;
        case gpu::BlendFactor::OneMinusDst: return VK_BLEND_FACTOR_ONE_MINUS_DST_COLOR;
        case gpu::BlendFactor::DstAlpha: return VK_BLEND_FACTOR_DST_ALPHA;
        case gpu::BlendFactor::OneMinusDstAlpha: return VK_BLEND_FACTOR_ONE_MINUS_DST_ALPHA;
        case gpu::BlendFactor::Constant: return VK_BLEND_FACTOR_CONSTANT_COLOR;
        case gpu::BlendFactor::OneMinusConstant: return VK_BLEND_FACTOR_ONE_MINUS_CONSTANT_COLOR;
    }
    return VK_BLEND_FACTOR_ZERO;
}

VkBlendOp to_vk(gpu::BlendOperation operation) {
    switch (operation) {
        case gpu::BlendOperation::Add: return VK_BLEND_OP_ADD;
        case gpu::BlendOperation::Subtract: return VK_BLEND_OP_SUBTRACT;
        case gpu::BlendOperation::ReverseSubtract: return VK_BLEND_OP_REVERSE_SUBTRACT;
        case gpu::BlendOperation::Min: return VK_BLEND_OP_MIN;
        case gpu::BlendOperation::Max: return VK_BLEND_OP_MAX;
    }
    return VK_BLEND_OP_ADD;
}

VkColorComponentFlags to_vk(gpu::ColorWrite mask) {
    VkColorComponentFlags flags = 0;
    flags |= flag_if(gpu::has(mask, gpu::ColorWrite::Red), VK_COLOR_COMPONENT_R_BIT);
    flags |= flag_if(gpu::has(mask, gpu::ColorWrite::Green), VK_COLOR_COMPONENT_G_BIT);
    flags |= flag_if(gpu::has(mask, gpu::ColorWrite::Blue), VK_COLOR_COMPONENT_B_BIT);
    flags |= flag_if(gpu::has(mask, gpu::ColorWrite::Alpha), VK_COLOR_COMPONENT_A_BIT);
    return flags;
}

VkAttachmentLoadOp to_vk(gpu::LoadOp op) {
    return op == gpu::LoadOp::Load ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR;
}

VkAttachmentStoreOp to_vk(gpu::StoreOp op) {
    return op == gpu::StoreOp::Store ? VK_ATTACHMENT_STORE_OP_STORE
                                     : VK_ATTACHMENT_STORE_OP_DONT_CARE;
}

VkSamplerAddressMode to_vk(gpu::AddressMode mode) {
    switch (mode) {
        case gpu::AddressMode::ClampToEdge: return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
        case gpu::AddressMode::Repeat: return VK_SAMPLER_ADDRESS_MODE_REPEAT;
        case gpu::AddressMode::MirrorRepeat: return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    }
    return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
}

VkFilter to_vk(gpu::FilterMode mode) {
    return mode == gpu::FilterMode::Nearest ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
}

VkSamplerMipmapMode to_vk_mipmap(gpu::FilterMode mode) {
    return mode == gpu::FilterMode::Nearest ? VK_SAMPLER_MIPMAP_MODE_NEAREST
                                            : VK_SAMPLER_MIPMAP_MODE_LINEAR;
}

VkShaderStageFlags to_vk(gpu::ShaderStage stages) {
    VkShaderStageFlags flags = 0;
    flags |= flag_if(gpu::has(stages, gpu::ShaderStage::Vertex), VK_SHADER_STAGE_VERTEX_BIT);
    flags |= flag_if(gpu::has(stages, gpu::ShaderStage::Fragment), VK_SHADER_STAGE_FRAGMENT_BIT);
    return flags;
}

VkSampleCountFlagBits to_vk_samples(std::uint32_t count) {
    return count == 4 ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT;
}

}  // namespace gnomon::vk
