// SPDX-License-Identifier: MIT
//
// What is decided once: which features and limits the device has.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/caps.hpp>

namespace gnomon::webgpu {

/// From what bridge.js says of its device: {"adapter": text, "features": [text], "limits": {name:
/// number}}. Empty text means that there is no device.
[[nodiscard]] Result<gpu::Caps> read_caps(std::string_view description,
                                          const std::vector<std::string>& disabled_features);

}  // namespace gnomon::webgpu
