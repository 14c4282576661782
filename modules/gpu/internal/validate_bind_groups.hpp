// SPDX-License-Identifier: MIT
//
// The rules of bind group layouts and bind groups.
#pragma once

#include "internal/device_state.hpp"

namespace gnomon::gpu {

[[nodiscard]] Result<BindGroupLayoutRecord> validate(DeviceState& device,
                                                     const BindGroupLayoutDesc& desc);
[[nodiscard]] Result<BindGroupRecord> validate(DeviceState& device, const BindGroupDesc& desc);

}  // namespace gnomon::gpu
