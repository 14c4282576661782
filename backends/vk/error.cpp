// SPDX-License-Identifier: MIT
//
// Translates results into errors.
#include "internal/error.hpp"

#include <fmt/format.h>

namespace gnomon::vk {

namespace {

ErrorCode code_of(VkResult result) {
    switch (result) {
        case VK_ERROR_DEVICE_LOST:
        // Where the swapchain could make no other one, a device of another window helps.
        case VK_ERROR_SURFACE_LOST_KHR: return ErrorCode::DeviceLost;
        case VK_ERROR_OUT_OF_HOST_MEMORY:
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        case VK_ERROR_OUT_OF_POOL_MEMORY:
        case VK_ERROR_FRAGMENTED_POOL:
        case VK_ERROR_TOO_MANY_OBJECTS: return ErrorCode::OutOfMemory;
        case VK_ERROR_LAYER_NOT_PRESENT:
        case VK_ERROR_EXTENSION_NOT_PRESENT:
        case VK_ERROR_FEATURE_NOT_PRESENT:
        case VK_ERROR_INCOMPATIBLE_DRIVER:
        case VK_ERROR_FORMAT_NOT_SUPPORTED: return ErrorCode::Unsupported;
        default: return ErrorCode::Internal;
    }
}

}  // namespace

std::string result_name(VkResult result) {
    switch (result) {
#define GNOMON_VK_NAME(name) \
    case name: return #name;
        GNOMON_VK_NAME(VK_SUCCESS)
        GNOMON_VK_NAME(VK_NOT_READY)
        GNOMON_VK_NAME(VK_TIMEOUT)
        GNOMON_VK_NAME(VK_SUBOPTIMAL_KHR)
        GNOMON_VK_NAME(VK_ERROR_OUT_OF_HOST_MEMORY)
        GNOMON_VK_NAME(VK_ERROR_OUT_OF_DEVICE_MEMORY)
        GNOMON_VK_NAME(VK_ERROR_INITIALIZATION_FAILED)
        GNOMON_VK_NAME(VK_ERROR_DEVICE_LOST)
        GNOMON_VK_NAME(VK_ERROR_MEMORY_MAP_FAILED)
        GNOMON_VK_NAME(VK_ERROR_LAYER_NOT_PRESENT)
        GNOMON_VK_NAME(VK_ERROR_EXTENSION_NOT_PRESENT)
        GNOMON_VK_NAME(VK_ERROR_FEATURE_NOT_PRESENT)
        GNOMON_VK_NAME(VK_ERROR_INCOMPATIBLE_DRIVER)
        GNOMON_VK_NAME(VK_ERROR_TOO_MANY_OBJECTS)
        GNOMON_VK_NAME(VK_ERROR_FORMAT_NOT_SUPPORTED)
        GNOMON_VK_NAME(VK_ERROR_FRAGMENTED_POOL)
        GNOMON_VK_NAME(VK_ERROR_OUT_OF_POOL_MEMORY)
        GNOMON_VK_NAME(VK_ERROR_SURFACE_LOST_KHR)
        GNOMON_VK_NAME(VK_ERROR_NATIVE_WINDOW_IN_USE_KHR)
        GNOMON_VK_NAME(VK_ERROR_OUT_OF_DATE_KHR)
#undef GNOMON_VK_NAME
        default: return fmt::format("VkResult {}", static_cast<int>(result));
    }
}

tl::unexpected<Error> failure(VkResult result, std::string_view call, std::string_view subject) {
    return fail(code_of(result),
                fmt::format("{} failed for {} with {}.", call, subject, result_name(result)));
}

}  // namespace gnomon::vk
