// SPDX-License-Identifier: MIT
//
// The one file of the apps that knows which backends there are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/gpu/message_sink.hpp>

namespace gnomon::cli {

/// The backends of this build: some of "gl", "vk", "null".
[[nodiscard]] std::vector<std::string> backend_names();

struct DeviceRequest {
    std::string backend = {};     ///< empty: the first of backend_names() that works and draws
    std::string gl_stencil = {};  ///< "two-side", "separate", "two-pass" or empty
    gpu::MessageSink message_sink = {};
};

[[nodiscard]] Result<gpu::Device> create_device(const DeviceRequest& request);

}  // namespace gnomon::cli
