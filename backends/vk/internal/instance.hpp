// SPDX-License-Identifier: MIT
//
// The VkInstance and what hangs on it: the debug messenger and the surface of the window.
#pragma once

#include <memory>

#include <gnomon/vk/backend.hpp>

#include "internal/functions.hpp"

namespace gnomon::vk {

class Instance {
public:
    [[nodiscard]] static Result<std::unique_ptr<Instance>> create(const BackendOptions& options);
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

    // The validation layer speaks until vkDestroyInstance has returned: the sink outlives it.
    gpu::MessageSink sink_;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

}  // namespace gnomon::vk
