// SPDX-License-Identifier: MIT
//
// The physical device: which one is taken, and what it can do once the options have switched parts
// of it off. Everything is asked once, here.
#pragma once

#include <vector>

#include <gnomon/gpu/caps.hpp>

#include "internal/instance.hpp"

namespace gnomon::vk {

struct Adapter {
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    VkPhysicalDeviceProperties properties{};
    VkPhysicalDeviceMemoryProperties memory{};
    VkPhysicalDeviceFeatures enabled{};  ///< what the logical device is made with
    bool dynamic_rendering = false;      ///< a host's alone: nothing here needs it
    std::vector<const char*> extensions;
    std::uint32_t queue_family = 0;
    std::uint32_t timestamp_bits = 0;  ///< 0: the queue has no timestamps
    gpu::Caps caps;
};

/// Fails with ErrorCode::Unsupported when no device fits, with the reason for each that was looked
/// at, and with ErrorCode::InvalidInput when a disabled feature has a name that is not known here.
[[nodiscard]] Result<Adapter> choose_adapter(const Instance& instance,
                                             const BackendOptions& options);

/// The host's, with the features that it says are enabled and no others.
[[nodiscard]] Result<Adapter> adopt_adapter(const Instance& instance, const HostDevice& host);

}  // namespace gnomon::vk
