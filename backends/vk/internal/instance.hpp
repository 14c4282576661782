// SPDX-License-Identifier: MIT
//
// The VkInstance and what hangs on it: the debug messenger and the surface of the window.
#pragma once

#include <memory>

#include <gnomon/vk/backend.hpp>
#include <gnomon/vk/host_device.hpp>

#include "internal/functions.hpp"

namespace gnomon::vk {

class Instance {
public:
    [[nodiscard]] static Result<std::unique_ptr<Instance>> create(const BackendOptions& options);
    /// The host's, which is not destroyed here.
    [[nodiscard]] static Result<std::unique_ptr<Instance>> adopt(const HostDevice& host);
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    InstanceFunctions fn;
    VkInstance handle = VK_NULL_HANDLE;
    VkSurfaceKHR surface = VK_NULL_HANDLE;  ///< null without a window

    /// Hands a message to the host.
    void report(gpu::Severity severity, std::string_view message) const;

private:
    Instance() = default;

    bool owned_ = true;

    // The validation layer speaks until vkDestroyInstance has returned: the sink outlives it.
    gpu::MessageSink sink_;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

}  // namespace gnomon::vk
