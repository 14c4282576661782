// SPDX-License-Identifier: MIT
//
// Fills the function tables.
#include "internal/functions.hpp"

#include <dlfcn.h>

namespace gnomon::vk {

namespace {

GlobalFunctions open_loader() {
    GlobalFunctions f;
    void* library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
        library = dlopen("libvulkan.so", RTLD_NOW | RTLD_LOCAL);
    }
    if (library == nullptr) {
        return f;
    }
    f.GetInstanceProcAddr =
        reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
    if (f.GetInstanceProcAddr == nullptr) {
        return f;
    }
#define GNOMON_VK_LOAD(name) \
    f.name = reinterpret_cast<PFN_vk##name>(f.GetInstanceProcAddr(nullptr, "vk" #name));
    GNOMON_VK_LOAD(EnumerateInstanceVersion)
    GNOMON_VK_GLOBAL_FUNCTIONS(GNOMON_VK_LOAD)
#undef GNOMON_VK_LOAD
    return f;
}

}  // namespace

const GlobalFunctions* load_global_functions() {
    static const GlobalFunctions functions = open_loader();
    return functions.GetInstanceProcAddr != nullptr ? &functions : nullptr;
}

InstanceFunctions load_instance_functions(const GlobalFunctions& global, VkInstance instance) {
    InstanceFunctions f;
#define GNOMON_VK_LOAD(name) \
    f.name = reinterpret_cast<PFN_vk##name>(global.GetInstanceProcAddr(instance, "vk" #name));
    GNOMON_VK_INSTANCE_FUNCTIONS(GNOMON_VK_LOAD)
    GNOMON_VK_INSTANCE_EXTENSION_FUNCTIONS(GNOMON_VK_LOAD)
#undef GNOMON_VK_LOAD
    return f;
}

DeviceFunctions load_device_functions(const InstanceFunctions& instance_functions,
                                      VkDevice device) {
    DeviceFunctions f;
#define GNOMON_VK_LOAD(name) \
    f.name =                 \
        reinterpret_cast<PFN_vk##name>(instance_functions.GetDeviceProcAddr(device, "vk" #name));
    GNOMON_VK_DEVICE_FUNCTIONS(GNOMON_VK_LOAD)
    GNOMON_VK_SWAPCHAIN_FUNCTIONS(GNOMON_VK_LOAD)
#undef GNOMON_VK_LOAD
    return f;
}

}  // namespace gnomon::vk
