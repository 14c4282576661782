// SPDX-License-Identifier: MIT
//
// The rules of what a device does at once: writing, reading back and presenting.
#pragma once

#include "internal/device_state.hpp"

namespace gnomon::gpu {

/// True when [offset, offset + size) lies within [0, limit); no sum that could overflow.
[[nodiscard]] constexpr bool range_fits(std::uint64_t offset, std::uint64_t size,
                                        std::uint64_t limit) {
    return offset <= limit && size <= limit - offset;
}

[[nodiscard]] Status validate_write_buffer(const DeviceState& device, BufferId buffer,
                                           std::uint64_t offset, std::uint64_t size);
[[nodiscard]] Status validate_read_buffer(const DeviceState& device, BufferId buffer,
                                          std::uint64_t offset, std::uint64_t size);
[[nodiscard]] Status validate_write_texture(const DeviceState& device, TextureId texture,
                                            std::uint32_t mip_level, std::uint64_t size);
/// The bytes that will be read.
[[nodiscard]] Result<std::uint64_t> validate_read_texture(const DeviceState& device,
                                                          TextureId texture, Aspect aspect);
[[nodiscard]] Status validate_present(const DeviceState& device, TextureId texture);

}  // namespace gnomon::gpu
