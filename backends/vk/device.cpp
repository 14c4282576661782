// SPDX-License-Identifier: MIT
//
// Makes the logical device.
#include "internal/device.hpp"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "internal/error.hpp"

namespace gnomon::vk {

Result<std::unique_ptr<Device>> Device::create(const BackendOptions& options) {
    std::unique_ptr<Device> self{new Device};
    self->y_up = options.y_up;
    Result<std::unique_ptr<Instance>> instance = Instance::create(options);
    if (!instance) {
        return forward_error(instance);
    }
    self->instance = std::move(*instance);
    Result<Adapter> adapter = choose_adapter(*self->instance, options);
    if (!adapter) {
        return forward_error(adapter);
    }
    self->adapter = std::move(*adapter);

    const float priority = 1.0F;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = self->adapter.queue_family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = static_cast<std::uint32_t>(self->adapter.extensions.size());
    info.ppEnabledExtensionNames = self->adapter.extensions.data();
    info.pEnabledFeatures = &self->adapter.enabled;
    if (const VkResult result =
            self->instance->fn.CreateDevice(self->adapter.handle, &info, nullptr, &self->handle);
        result != VK_SUCCESS) {
        self->handle = VK_NULL_HANDLE;
        return failure(result, "vkCreateDevice",
                       fmt::format("adapter '{}'", self->adapter.properties.deviceName));
    }
    self->fn = load_device_functions(self->instance->fn, self->handle);
    self->fn.GetDeviceQueue(self->handle, self->adapter.queue_family, 0, &self->queue);
    self->instance->report(gpu::Severity::Info,
                           fmt::format("gnomon::vk draws on {}.", self->adapter.caps.adapter));
    return self;
}

Result<std::unique_ptr<Device>> Device::adopt(const HostDevice& host) {
    const std::array<std::pair<const void*, const char*>, 5> handles{
        {{host.get_instance_proc_addr, "get_instance_proc_addr"},
         {host.instance, "instance"},
         {host.physical_device, "physical_device"},
         {host.device, "device"},
         {host.queue, "queue"}}};
    for (const auto& [handle, name] : handles) {
        if (handle == nullptr) {
            return fail(ErrorCode::InvalidInput,
                        fmt::format("HostDevice::{} is null: there is nothing to adopt.", name));
        }
    }
    std::unique_ptr<Device> self{new Device};
    self->owned_ = false;
    Result<std::unique_ptr<Instance>> instance = Instance::adopt(host);
    if (!instance) {
        return forward_error(instance);
    }
    self->instance = std::move(*instance);
    Result<Adapter> adapter = adopt_adapter(*self->instance, host);
    if (!adapter) {
        return forward_error(adapter);
    }
    self->adapter = std::move(*adapter);
    self->handle = static_cast<VkDevice>(host.device);
    self->fn = load_device_functions(self->instance->fn, self->handle);
    self->queue = static_cast<VkQueue>(host.queue);
    return self;
}

Device::~Device() {
    if (handle != VK_NULL_HANDLE && owned_) {
        fn.DestroyDevice(handle, nullptr);
    }
}

void Device::set_name_of(VkObjectType type, std::uint64_t object, const std::string& name) const {
    if (instance->fn.SetDebugUtilsObjectNameEXT == nullptr || name.empty()) {
        return;
    }
    VkDebugUtilsObjectNameInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
    info.objectType = type;
    info.objectHandle = object;
    info.pObjectName = name.c_str();
    // A name that does not stick costs a tool's comfort, nothing else.
    static_cast<void>(instance->fn.SetDebugUtilsObjectNameEXT(handle, &info));
}

}  // namespace gnomon::vk
