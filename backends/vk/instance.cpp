// SPDX-License-Identifier: MIT
//
// Makes the instance: which layers and extensions are asked for, and where messages go.
#include "internal/instance.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "internal/error.hpp"

namespace gnomon::vk {

namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                          VkDebugUtilsMessageTypeFlagsEXT types,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data,
                                          void* user) {
    // What the loader says of drivers that it could not open is no fault of ours.
    const bool general = types == VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT;
    gpu::Severity level = gpu::Severity::Info;
    if (!general) {
        level = severity >= VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT ? gpu::Severity::Error
                                                                          : gpu::Severity::Warning;
    }
    static_cast<const Instance*>(user)->report(level, data->pMessage);
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(Instance* instance) {
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT |
                       VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                       VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = on_message;
    info.pUserData = instance;
    return info;
}

Result<bool> has_layer(const GlobalFunctions& global, const char* name) {
    std::uint32_t count = 0;
    VkResult result = global.EnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    if (result == VK_SUCCESS) {
        result = global.EnumerateInstanceLayerProperties(&count, layers.data());
    }
    if (result < VK_SUCCESS) {
        return failure(result, "vkEnumerateInstanceLayerProperties", "the Vulkan loader");
    }
    return std::any_of(layers.begin(), layers.end(), [name](const VkLayerProperties& layer) {
        return std::strcmp(layer.layerName, name) == 0;
    });
}

Result<std::vector<std::string>> instance_extensions(const GlobalFunctions& global) {
    std::uint32_t count = 0;
    VkResult result = global.EnumerateInstanceExtensionProperties(nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> properties(count);
    if (result == VK_SUCCESS) {
        result = global.EnumerateInstanceExtensionProperties(nullptr, &count, properties.data());
    }
    if (result < VK_SUCCESS) {
        return failure(result, "vkEnumerateInstanceExtensionProperties", "the Vulkan loader");
    }
    std::vector<std::string> names;
    for (const VkExtensionProperties& property : properties) {
        names.emplace_back(property.extensionName);
    }
    return names;
}

}  // namespace

Result<std::unique_ptr<Instance>> Instance::create(const BackendOptions& options) {
    const GlobalFunctions* global = load_global_functions();
    if (global == nullptr) {
        return fail(ErrorCode::Unsupported,
                    "Vulkan is not available: the loader libvulkan.so.1 cannot be opened.");
    }
    std::uint32_t version = VK_API_VERSION_1_0;
    if (global->EnumerateInstanceVersion != nullptr) {
        global->EnumerateInstanceVersion(&version);
    }
    if (version < VK_API_VERSION_1_1) {
        return fail(ErrorCode::Unsupported,
                    "The Vulkan loader offers version 1.0, but 1.1 is needed.");
    }

    std::vector<const char*> layers;
    if (options.validation) {
        const Result<bool> found = has_layer(*global, validation_layer);
        if (!found) {
            return forward_error(found);
        }
        if (!*found) {
            return fail(ErrorCode::Unsupported,
                        fmt::format("Validation was asked for, but the layer {} is not installed.",
                                    validation_layer));
        }
        layers.push_back(validation_layer);
    }

    const Result<std::vector<std::string>> available = instance_extensions(*global);
    if (!available) {
        return forward_error(available);
    }
    const auto offers = [&](std::string_view name) {
        return std::find(available->begin(), available->end(), name) != available->end();
    };
    std::vector<const char*> extensions;
    const bool debug_utils = offers(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (debug_utils) {
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    if (options.window) {
        for (const std::string& name : options.window->instance_extensions) {
            if (!offers(name)) {
                return fail(ErrorCode::Unsupported,
                            fmt::format("The window needs the Vulkan instance extension {}, which "
                                        "the loader does not offer.",
                                        name));
            }
            extensions.push_back(name.c_str());
        }
    }

    std::unique_ptr<Instance> self{new Instance};
    self->sink_ = options.message_sink;
    const VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(self.get());
    const bool listens = debug_utils && self->sink_ != nullptr;

    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pEngineName = "gnomon";
    application.apiVersion = VK_API_VERSION_1_1;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pNext = listens ? &messenger : nullptr;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = static_cast<std::uint32_t>(layers.size());
    info.ppEnabledLayerNames = layers.data();
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    if (const VkResult result = global->CreateInstance(&info, nullptr, &self->handle);
        result != VK_SUCCESS) {
        self->handle = VK_NULL_HANDLE;
        return failure(result, "vkCreateInstance", "this process");
    }
    self->fn = load_instance_functions(*global, self->handle);
    if (listens) {
        if (const VkResult result = self->fn.CreateDebugUtilsMessengerEXT(
                self->handle, &messenger, nullptr, &self->messenger_);
            result != VK_SUCCESS) {
            return failure(result, "vkCreateDebugUtilsMessengerEXT", "the message sink");
        }
    }
    if (options.window) {
        self->surface = reinterpret_cast<VkSurfaceKHR>(
            options.window->create_surface ? options.window->create_surface(self->handle) : 0);
        if (self->surface == VK_NULL_HANDLE) {
            return fail(ErrorCode::Unsupported,
                        "The window gave no Vulkan surface: Window::create_surface returned 0.");
        }
    }
    return self;
}

Result<std::unique_ptr<Instance>> Instance::adopt(const HostDevice& host) {
    std::unique_ptr<Instance> self{new Instance};
    self->owned_ = false;
    self->handle = static_cast<VkInstance>(host.instance);
    GlobalFunctions global;
    global.GetInstanceProcAddr =
        reinterpret_cast<PFN_vkGetInstanceProcAddr>(host.get_instance_proc_addr);
    self->fn = load_instance_functions(global, self->handle);
    if (self->fn.GetPhysicalDeviceProperties2 == nullptr || self->fn.GetDeviceProcAddr == nullptr) {
        return fail(ErrorCode::Unsupported,
                    "The host's Vulkan instance does not know what Vulkan 1.1 has: make it with an "
                    "apiVersion of VK_API_VERSION_1_1 or later.");
    }
    return self;
}

Instance::~Instance() {
    if (handle == VK_NULL_HANDLE || !owned_) {
        return;
    }
    if (surface != VK_NULL_HANDLE) {
        fn.DestroySurfaceKHR(handle, surface, nullptr);
    }
    if (messenger_ != VK_NULL_HANDLE) {
        fn.DestroyDebugUtilsMessengerEXT(handle, messenger_, nullptr);
    }
    fn.DestroyInstance(handle, nullptr);
}

void Instance::report(gpu::Severity severity, std::string_view message) const {
    if (!sink_) {
        return;
    }
    try {
        sink_(severity, message);
    } catch (...) {
        // The caller is a driver written in C: nothing may pass through it, and a failing sink
        // leaves nobody to tell.
    }
}

}  // namespace gnomon::vk
