// SPDX-License-Identifier: MIT
//
// A VkResult as an Error: one sentence that names the call, the object and the result.
#pragma once

#include <string_view>

#include <gnomon/core/result.hpp>

#include "internal/functions.hpp"

namespace gnomon::vk {

/// "VK_ERROR_DEVICE_LOST"; results without a name here give their number.
[[nodiscard]] std::string result_name(VkResult result);

/// `subject` completes "failed for …": "buffer 'indices'".
[[nodiscard]] tl::unexpected<Error> failure(VkResult result, std::string_view call,
                                            std::string_view subject);

}  // namespace gnomon::vk
