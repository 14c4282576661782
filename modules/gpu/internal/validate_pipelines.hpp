// SPDX-License-Identifier: MIT
//
// The rules of render pipelines.
#pragma once

#include "internal/device_state.hpp"

namespace gnomon::gpu {

[[nodiscard]] Result<RenderPipelineRecord> validate(DeviceState& device,
                                                    const RenderPipelineDesc& desc);

}  // namespace gnomon::gpu
