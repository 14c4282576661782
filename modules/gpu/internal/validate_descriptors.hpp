// SPDX-License-Identifier: MIT
//
// The rules of objects that name no other objects. Each function gives the record that the front
// end keeps, or the sentence that says which rule is broken.
#pragma once

#include "internal/device_state.hpp"

namespace gnomon::gpu {

[[nodiscard]] Result<BufferDesc> validate(DeviceState& device, const BufferDesc& desc);
[[nodiscard]] Result<TextureDesc> validate(DeviceState& device, const TextureDesc& desc);
[[nodiscard]] Result<SamplerDesc> validate(DeviceState& device, const SamplerDesc& desc);
[[nodiscard]] Result<ShaderRecord> validate(DeviceState& device, const ShaderDesc& desc);
[[nodiscard]] Result<QuerySetDesc> validate(DeviceState& device, const QuerySetDesc& desc);

/// 1, or 4 where the adapter can do that. `name` is the object the count belongs to.
[[nodiscard]] Status validate_sample_count(const DeviceState& device, std::uint32_t sample_count,
                                           std::string_view name);
/// A format of this enumeration that the adapter has.
[[nodiscard]] Status validate_format(const DeviceState& device, Format format,
                                     std::string_view name);

}  // namespace gnomon::gpu
