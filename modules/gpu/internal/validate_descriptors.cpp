// SPDX-License-Identifier: MIT
#include "internal/validate_descriptors.hpp"

#include <algorithm>
#include <bit>

namespace gnomon::gpu {

namespace {

template <class Bits>
bool only_known_bits(Bits set, std::uint32_t known) {
    return (static_cast<std::uint32_t>(set) & ~known) == 0;
}

// Which WebGPU gives one sample alone.
bool has_wide_channels(Format format) {
    return format == Format::R32Uint || format == Format::Rgba32Uint ||
           format == Format::Rgba32Float;
}

constexpr std::uint32_t max_queries = 4096;  // WebGPU's maxQuerySetSize

}  // namespace

Status validate_sample_count(const DeviceState& device, std::uint32_t sample_count,
                             std::string_view name) {
    if (sample_count != 1 && sample_count != 4) {
        return invalid("The sample count ({}) of {} is neither 1 nor 4.", sample_count, name);
    }
    if (sample_count == 4 && !device.caps().features.multisample_4) {
        return invalid("The sample count of {} is 4, but this adapter has no multisample_4.", name);
    }
    return {};
}

Status validate_format(const DeviceState& device, Format format, std::string_view name) {
    const Features& features = device.caps().features;
    if (format == Format::Undefined || format > Format::Depth32FloatStencil8) {
        return invalid("The format of {} is {}.", name, to_text(format));
    }
    if ((format == Format::Depth24UnormStencil8 && !features.depth24unorm_stencil8) ||
        (format == Format::Depth32FloatStencil8 && !features.depth32float_stencil8)) {
        return invalid("The format of {} is {}, which this adapter does not have.", name,
                       to_text(format));
    }
    return {};
}

Result<BufferDesc> validate(DeviceState& device, const BufferDesc& desc) {
    const std::string name = object_name("Buffer", desc.label);
    const std::uint64_t limit = device.caps().limits.max_buffer_size;
    if (desc.size == 0) return invalid("The size of {} is zero.", name);
    if (desc.size % 4 != 0) {
        return invalid("The size ({}) of {} is not a multiple of 4.", desc.size, name);
    }
    if (desc.size > limit) {
        return invalid("The size ({}) of {} exceeds max_buffer_size ({}).", desc.size, name, limit);
    }
    if (desc.usage == BufferUsage::None) return invalid("{} has no usage.", name);
    if (!only_known_bits(desc.usage, 31)) {
        return invalid("The usage ({}) of {} has unknown bits.", to_text(desc.usage), name);
    }
    return desc;
}

Result<TextureDesc> validate(DeviceState& device, const TextureDesc& desc) {
    const std::string name = object_name("Texture", desc.label);
    const std::uint32_t limit = device.caps().limits.max_texture_dimension_2d;
    if (desc.width == 0 || desc.height == 0) {
        return invalid("The size ({} x {}) of {} is zero.", desc.width, desc.height, name);
    }
    if (desc.width > limit || desc.height > limit) {
        return invalid("The size ({} x {}) of {} exceeds max_texture_dimension_2d ({}).",
                       desc.width, desc.height, name, limit);
    }
    if (const Status s = validate_format(device, desc.format, name); !s) return forward_error(s);
    if (desc.usage == TextureUsage::None) return invalid("{} has no usage.", name);
    if (!only_known_bits(desc.usage, 15)) {
        return invalid("The usage ({}) of {} has unknown bits.", to_text(desc.usage), name);
    }
    const auto full_chain =
        static_cast<std::uint32_t>(std::bit_width(std::max(desc.width, desc.height)));
    if (desc.mip_level_count == 0 || desc.mip_level_count > full_chain) {
        return invalid("The mip level count ({}) of {} is not within 1 and {}, as {} x {} allows.",
                       desc.mip_level_count, name, full_chain, desc.width, desc.height);
    }
    if (const Status s = validate_sample_count(device, desc.sample_count, name); !s) {
        return forward_error(s);
    }
    if (desc.sample_count > 1) {
        if (has_wide_channels(desc.format) && !device.caps().features.multisample_32bit) {
            return invalid(
                "The sample count of {} is 4, but its format is {} and this adapter has no "
                "multisample_32bit.",
                name, to_text(desc.format));
        }
        if (desc.mip_level_count != 1) {
            return invalid("{} is multisampled, but has {} mip levels instead of 1.", name,
                           desc.mip_level_count);
        }
        if (!has(desc.usage, TextureUsage::RenderAttachment)) {
            return invalid("{} is multisampled, but its usage ({}) lacks RenderAttachment.", name,
                           to_text(desc.usage));
        }
    }
    return desc;
}

Result<SamplerDesc> validate(DeviceState&, const SamplerDesc& desc) {
    // Every combination of address and filter modes is legal.
    return desc;
}

Result<ShaderRecord> validate(DeviceState& device, const ShaderDesc& desc) {
    const std::string name = object_name("Shader", desc.label);
    if (desc.stage != ShaderStage::Vertex && desc.stage != ShaderStage::Fragment) {
        return invalid("The stage of {} is {} instead of either Vertex or Fragment.", name,
                       to_text(desc.stage));
    }
    const std::string& backend = device.caps().backend;
    if (desc.source.spirv.empty() && desc.source.glsl.empty() && desc.source.wgsl.empty()) {
        return invalid("The source of {} is empty.", name);
    }
    if (backend == "gl" && desc.source.glsl.empty()) {
        return invalid("The GLSL source of {} is empty, and the backend takes GLSL.", name);
    }
    if (backend == "vk" && desc.source.spirv.empty()) {
        return invalid("The SPIR-V source of {} is empty, and the backend takes SPIR-V.", name);
    }
    if (backend == "webgpu" && desc.source.wgsl.empty()) {
        return invalid("The WGSL source of {} is empty, and the backend takes WGSL.", name);
    }
    return ShaderRecord{desc.label, desc.stage};
}

Result<QuerySetDesc> validate(DeviceState& device, const QuerySetDesc& desc) {
    const std::string name = object_name("QuerySet", desc.label);
    const Features& features = device.caps().features;
    if (desc.count == 0 || desc.count > max_queries) {
        return invalid("The count ({}) of {} is not within 1 and {}.", desc.count, name,
                       max_queries);
    }
    if (desc.type == QueryType::Occlusion && !features.occlusion_query) {
        return invalid("The type of {} is Occlusion, but this adapter has no occlusion_query.",
                       name);
    }
    if (desc.type == QueryType::Timestamp && !features.timestamp_query) {
        return invalid("The type of {} is Timestamp, but this adapter has no timestamp_query.",
                       name);
    }
    return desc;
}

}  // namespace gnomon::gpu
