// SPDX-License-Identifier: MIT
#include "internal/validate_transfers.hpp"

#include <algorithm>

namespace gnomon::gpu {

namespace {

Status validate_buffer_range(const DeviceState& device, BufferId id, BufferUsage usage,
                             std::uint64_t offset, std::uint64_t size) {
    const BufferDesc* buffer = device.find(id);
    if (buffer == nullptr) return invalid("{}", device.absence(id));
    const std::string name = device.name(id);
    if (!has(buffer->usage, usage)) {
        return invalid("The usage ({}) of {} lacks {}.", to_text(buffer->usage), name,
                       to_text(usage));
    }
    if (offset % 4 != 0) return invalid("The offset ({}) is not a multiple of 4.", offset);
    if (size % 4 != 0) return invalid("The size ({}) is not a multiple of 4.", size);
    if (!range_fits(offset, size, buffer->size)) {
        return invalid("The range (offset {}, size {}) does not fit in {} (size {}).", offset, size,
                       name, buffer->size);
    }
    return {};
}

Result<const TextureDesc*> find_texture(const DeviceState& device, TextureId id,
                                        TextureUsage usage) {
    const TextureDesc* texture = device.find(id);
    if (texture == nullptr) return invalid("{}", device.absence(id));
    if (!has(texture->usage, usage)) {
        return invalid("The usage ({}) of {} lacks {}.", to_text(texture->usage), device.name(id),
                       to_text(usage));
    }
    if (texture->sample_count != 1) {
        return invalid("{} is multisampled.", device.name(id));
    }
    return texture;
}

}  // namespace

Status validate_write_buffer(const DeviceState& device, BufferId buffer, std::uint64_t offset,
                             std::uint64_t size) {
    return validate_buffer_range(device, buffer, BufferUsage::CopyDst, offset, size);
}

Status validate_read_buffer(const DeviceState& device, BufferId buffer, std::uint64_t offset,
                            std::uint64_t size) {
    return validate_buffer_range(device, buffer, BufferUsage::CopySrc, offset, size);
}

Status validate_write_texture(const DeviceState& device, TextureId id, std::uint32_t mip_level,
                              std::uint64_t size) {
    const auto found = find_texture(device, id, TextureUsage::CopyDst);
    if (!found) return forward_error(found);
    const TextureDesc& texture = **found;
    const std::string name = device.name(id);
    if (!has_color(texture.format)) {
        return invalid("The format ({}) of {} is not a color format.", to_text(texture.format),
                       name);
    }
    if (mip_level >= texture.mip_level_count) {
        return invalid("The mip level ({}) is not below the mip level count ({}) of {}.", mip_level,
                       texture.mip_level_count, name);
    }
    const std::uint64_t width = std::max(texture.width >> mip_level, 1U);
    const std::uint64_t height = std::max(texture.height >> mip_level, 1U);
    const std::uint64_t expected = width * height * texel_bytes(texture.format);
    if (size != expected) {
        return invalid("The data has {} bytes, but mip level {} of {} ({} x {}, {}) has {}.", size,
                       mip_level, name, width, height, to_text(texture.format), expected);
    }
    return {};
}

Result<std::uint64_t> validate_read_texture(const DeviceState& device, TextureId id,
                                            Aspect aspect) {
    const auto found = find_texture(device, id, TextureUsage::CopySrc);
    if (!found) return forward_error(found);
    const TextureDesc& texture = **found;
    const std::uint64_t pixels = std::uint64_t{texture.width} * texture.height;
    if (aspect == Aspect::Color && has_color(texture.format)) {
        return pixels * texel_bytes(texture.format);
    }
    if (aspect == Aspect::DepthOnly && has_depth(texture.format)) return pixels * sizeof(float);
    if (aspect == Aspect::StencilOnly && has_stencil(texture.format)) return pixels;
    return invalid("The format ({}) of {} has no aspect {}.", to_text(texture.format),
                   device.name(id), to_text(aspect));
}

Status validate_present(const DeviceState& device, TextureId id) {
    const auto found = find_texture(device, id, TextureUsage::CopySrc);
    if (!found) return forward_error(found);
    const Format format = (*found)->format;
    if (!has_color(format) || is_uint(format)) {
        return invalid("The format ({}) of {} cannot be shown on a window.", to_text(format),
                       device.name(id));
    }
    return {};
}

}  // namespace gnomon::gpu
