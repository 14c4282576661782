// SPDX-License-Identifier: MIT
//
// Chooses the physical device and fills in the caps.
#include "internal/adapter.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "internal/error.hpp"

namespace gnomon::vk {

namespace {

constexpr std::array<std::string_view, 10> feature_names = {
    "depthClamp",       "depthBiasClamp",        "depthBounds",
    "independentBlend", "occlusionQueryPrecise", "sampleRate",
    "timestamps",       "D32_SFLOAT_S8_UINT",    "D24_UNORM_S8_UINT",
    "sampledStencil"};

class Disabled {
public:
    explicit Disabled(const std::vector<std::string>& names) : names_(&names) {}
    [[nodiscard]] bool operator()(std::string_view name) const {
        return std::find(names_->begin(), names_->end(), name) != names_->end();
    }

private:
    const std::vector<std::string>* names_;
};

bool contains_ignoring_case(std::string_view text, std::string_view part) {
    return std::search(text.begin(), text.end(), part.begin(), part.end(), [](char a, char b) {
               return std::tolower(static_cast<unsigned char>(a)) ==
                      std::tolower(static_cast<unsigned char>(b));
           }) != text.end();
}

int rank(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU: return 0;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU: return 1;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU: return 2;
        case VK_PHYSICAL_DEVICE_TYPE_CPU: return 3;
        default: return 4;
    }
}

Result<std::vector<VkPhysicalDevice>> physical_devices(const Instance& instance) {
    std::uint32_t count = 0;
    VkResult result = instance.fn.EnumeratePhysicalDevices(instance.handle, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    if (result == VK_SUCCESS) {
        result = instance.fn.EnumeratePhysicalDevices(instance.handle, &count, devices.data());
    }
    if (result < VK_SUCCESS) {
        return failure(result, "vkEnumeratePhysicalDevices", "the Vulkan instance");
    }
    devices.resize(count);
    return devices;
}

Result<std::vector<std::string>> device_extensions(const Instance& instance,
                                                   VkPhysicalDevice device) {
    std::uint32_t count = 0;
    VkResult result =
        instance.fn.EnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> properties(count);
    if (result == VK_SUCCESS) {
        result = instance.fn.EnumerateDeviceExtensionProperties(device, nullptr, &count,
                                                                properties.data());
    }
    if (result < VK_SUCCESS) {
        return failure(result, "vkEnumerateDeviceExtensionProperties", "a physical device");
    }
    std::vector<std::string> names;
    for (const VkExtensionProperties& property : properties) {
        names.emplace_back(property.extensionName);
    }
    return names;
}

bool has_features(const Instance& instance, VkPhysicalDevice device, VkFormat format,
                  VkFormatFeatureFlags wanted) {
    VkFormatProperties properties{};
    instance.fn.GetPhysicalDeviceFormatProperties(device, format, &properties);
    return (properties.optimalTilingFeatures & wanted) == wanted;
}

std::optional<std::uint32_t> find_queue_family(const Instance& instance, VkPhysicalDevice device,
                                               std::optional<std::uint32_t> of_host,
                                               std::uint32_t& timestamp_bits) {
    std::uint32_t count = 0;
    instance.fn.GetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    instance.fn.GetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    for (std::uint32_t i = 0; i < count; ++i) {
        if ((families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT) == 0 || of_host.value_or(i) != i) {
            continue;
        }
        if (instance.surface != VK_NULL_HANDLE) {
            VkBool32 presents = VK_FALSE;
            if (instance.fn.GetPhysicalDeviceSurfaceSupportKHR(device, i, instance.surface,
                                                               &presents) != VK_SUCCESS ||
                presents == VK_FALSE) {
                continue;
            }
        }
        timestamp_bits = families[i].timestampValidBits;
        return i;
    }
    return std::nullopt;
}

std::string describe(const Instance& instance, const Adapter& adapter, bool driver_properties) {
    const VkPhysicalDeviceProperties& p = adapter.properties;
    std::string driver = fmt::format("driver version {:#x}", p.driverVersion);
    if (driver_properties) {
        VkPhysicalDeviceDriverProperties info{};
        info.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
        VkPhysicalDeviceProperties2 chain{};
        chain.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
        chain.pNext = &info;
        instance.fn.GetPhysicalDeviceProperties2(adapter.handle, &chain);
        driver = fmt::format("{} {}", info.driverName, info.driverInfo);
    }
    return fmt::format("{}, {}, Vulkan {}.{}.{}", p.deviceName, driver,
                       VK_API_VERSION_MAJOR(p.apiVersion), VK_API_VERSION_MINOR(p.apiVersion),
                       VK_API_VERSION_PATCH(p.apiVersion));
}

gpu::Features find_features(const Instance& instance, const Adapter& adapter,
                            const Disabled& disabled) {
    const VkPhysicalDeviceLimits& limits = adapter.properties.limits;
    const auto attachment = [&](VkFormat format) {
        return has_features(instance, adapter.handle, format,
                            VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT);
    };
    gpu::Features f;
    f.unclipped_depth = adapter.enabled.depthClamp == VK_TRUE;
    f.depth_bounds = adapter.enabled.depthBounds == VK_TRUE;
    f.occlusion_query = adapter.enabled.occlusionQueryPrecise == VK_TRUE;
    f.timestamp_query = adapter.timestamp_bits != 0 && limits.timestampPeriod > 0.0F;
    f.depth32float_stencil8 =
        attachment(VK_FORMAT_D32_SFLOAT_S8_UINT) && !disabled("D32_SFLOAT_S8_UINT");
    f.depth24unorm_stencil8 =
        attachment(VK_FORMAT_D24_UNORM_S8_UINT) && !disabled("D24_UNORM_S8_UINT");
    const VkFormat stencil_format =
        f.depth32float_stencil8 ? VK_FORMAT_D32_SFLOAT_S8_UINT : VK_FORMAT_D24_UNORM_S8_UINT;
    f.sampled_stencil = has_features(instance, adapter.handle, stencil_format,
                                     VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT) &&
                        !disabled("sampledStencil");
    const VkSampleCountFlags counts =
        limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts &
        limits.framebufferStencilSampleCounts & limits.sampledImageColorSampleCounts &
        limits.sampledImageDepthSampleCounts & limits.sampledImageStencilSampleCounts;
    f.multisample_4 = (counts & VK_SAMPLE_COUNT_4_BIT) != 0;
    f.multisample_32bit = f.multisample_4;
    f.sample_shading = adapter.enabled.sampleRateShading == VK_TRUE;
    f.exact_clip_space = true;
    return f;
}

gpu::Limits find_limits(const Instance& instance, const Adapter& adapter) {
    VkPhysicalDeviceMaintenance3Properties maintenance{};
    maintenance.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
    VkPhysicalDeviceProperties2 chain{};
    chain.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    chain.pNext = &maintenance;
    instance.fn.GetPhysicalDeviceProperties2(adapter.handle, &chain);

    const VkPhysicalDeviceLimits& from = adapter.properties.limits;
    gpu::Limits limits;
    limits.max_texture_dimension_2d =
        std::min({from.maxImageDimension2D, from.maxFramebufferWidth, from.maxFramebufferHeight});
    limits.max_color_attachments =
        std::min(from.maxColorAttachments, from.maxFragmentOutputAttachments);
    limits.max_vertex_buffers = from.maxVertexInputBindings;
    limits.max_vertex_attributes = from.maxVertexInputAttributes;
    limits.max_buffer_size = maintenance.maxMemoryAllocationSize;
    limits.max_uniform_buffer_binding_size = from.maxUniformBufferRange;
    limits.min_uniform_buffer_offset_alignment =
        static_cast<std::uint32_t>(from.minUniformBufferOffsetAlignment);
    return limits;
}

/// The adapter, or as the error's message why this device does not fit.
Result<Adapter> examine(const Instance& instance, VkPhysicalDevice device, const Disabled& disabled,
                        std::optional<std::uint32_t> queue_family_of_host = std::nullopt) {
    Adapter adapter;
    adapter.handle = device;
    instance.fn.GetPhysicalDeviceProperties(device, &adapter.properties);
    instance.fn.GetPhysicalDeviceMemoryProperties(device, &adapter.memory);
    const std::uint32_t version = adapter.properties.apiVersion;
    if (version < VK_API_VERSION_1_1) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("it has Vulkan {}.{}, but 1.1 is needed",
                                VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version)));
    }
    const std::optional<std::uint32_t> family =
        find_queue_family(instance, device, queue_family_of_host, adapter.timestamp_bits);
    if (!family && queue_family_of_host) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("its queue family {} has no graphics", *queue_family_of_host));
    }
    if (!family) {
        return fail(ErrorCode::Unsupported, instance.surface != VK_NULL_HANDLE
                                                ? "no graphics queue of it presents to the window"
                                                : "it has no graphics queue");
    }
    adapter.queue_family = *family;
    if (disabled("timestamps")) {
        adapter.timestamp_bits = 0;
    }

    const Result<std::vector<std::string>> available = device_extensions(instance, device);
    if (!available) {
        return forward_error(available);
    }
    const auto offers = [&](std::string_view name) {
        return std::find(available->begin(), available->end(), name) != available->end();
    };
    if (instance.surface != VK_NULL_HANDLE) {
        if (!offers(VK_KHR_SWAPCHAIN_EXTENSION_NAME)) {
            return fail(ErrorCode::Unsupported,
                        fmt::format("it lacks {}", VK_KHR_SWAPCHAIN_EXTENSION_NAME));
        }
        adapter.extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    }

    VkPhysicalDeviceFeatures has{};
    instance.fn.GetPhysicalDeviceFeatures(device, &has);
    const auto take = [&](VkBool32 VkPhysicalDeviceFeatures::*feature, std::string_view name) {
        adapter.enabled.*feature = disabled(name) ? VK_FALSE : has.*feature;
    };
    take(&VkPhysicalDeviceFeatures::depthClamp, "depthClamp");
    take(&VkPhysicalDeviceFeatures::depthBiasClamp, "depthBiasClamp");
    take(&VkPhysicalDeviceFeatures::depthBounds, "depthBounds");
    take(&VkPhysicalDeviceFeatures::independentBlend, "independentBlend");
    take(&VkPhysicalDeviceFeatures::occlusionQueryPrecise, "occlusionQueryPrecise");
    take(&VkPhysicalDeviceFeatures::sampleRateShading, "sampleRate");

    adapter.caps.backend = "vk";
    adapter.caps.adapter =
        describe(instance, adapter, offers(VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME));
    adapter.caps.stencil_path = "native";
    adapter.caps.features = find_features(instance, adapter, disabled);
    adapter.caps.limits = find_limits(instance, adapter);
    adapter.caps.limits.multisample_scissor_alignment =
        gpu::multisample_scissor_alignment_of(adapter.caps.adapter);
    if (!adapter.caps.features.depth24unorm_stencil8 &&
        !adapter.caps.features.depth32float_stencil8) {
        return fail(ErrorCode::Unsupported,
                    "it draws to neither D32_SFLOAT_S8_UINT nor D24_UNORM_S8_UINT");
    }
    return adapter;
}

Status check_names(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        if (std::find(feature_names.begin(), feature_names.end(), name) == feature_names.end()) {
            return fail(ErrorCode::InvalidInput,
                        fmt::format("'{}' cannot be disabled: the known features are {}.", name,
                                    fmt::join(feature_names, ", ")));
        }
    }
    return {};
}

}  // namespace

Result<Adapter> choose_adapter(const Instance& instance, const BackendOptions& options) {
    if (const Status known = check_names(options.disabled_features); !known) {
        return forward_error(known);
    }
    const Disabled disabled{options.disabled_features};
    const Result<std::vector<VkPhysicalDevice>> devices = physical_devices(instance);
    if (!devices) {
        return forward_error(devices);
    }
    std::optional<Adapter> best;
    std::vector<std::string> names;
    std::vector<std::string> reasons;
    for (VkPhysicalDevice device : *devices) {
        VkPhysicalDeviceProperties properties{};
        instance.fn.GetPhysicalDeviceProperties(device, &properties);
        const std::string_view name = properties.deviceName;
        names.push_back(fmt::format("'{}'", name));
        if (!contains_ignoring_case(name, options.adapter)) {
            continue;
        }
        Result<Adapter> adapter = examine(instance, device, disabled);
        if (!adapter) {
            reasons.push_back(fmt::format("'{}': {}", name, adapter.error().message));
        } else if (!best || rank(properties.deviceType) < rank(best->properties.deviceType)) {
            best = std::move(*adapter);
        }
    }
    if (best) {
        return std::move(*best);
    }
    if (names.empty()) {
        return fail(ErrorCode::Unsupported, "The Vulkan loader finds no device.");
    }
    if (reasons.empty()) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("No Vulkan device's name contains '{}': there is {}.",
                                options.adapter, fmt::join(names, ", ")));
    }
    return fail(ErrorCode::Unsupported,
                fmt::format("No Vulkan device fits: {}.", fmt::join(reasons, "; ")));
}

Result<Adapter> adopt_adapter(const Instance& instance, const HostDevice& host) {
    // By the names of the options that switch features off.
    constexpr std::array<std::pair<std::string_view, const char*>, 6> names{
        {{"depthClamp", "depthClamp"},
         {"depthBiasClamp", "depthBiasClamp"},
         {"depthBounds", "depthBounds"},
         {"independentBlend", "independentBlend"},
         {"occlusionQueryPrecise", "occlusionQueryPrecise"},
         {"sampleRateShading", "sampleRate"}}};
    const auto is_enabled = [&host](std::string_view name) {
        return std::find(host.enabled_features.begin(), host.enabled_features.end(), name) !=
               host.enabled_features.end();
    };
    std::vector<std::string> disabled;
    for (const auto& [name, option] : names) {
        if (!is_enabled(name)) {
            disabled.emplace_back(option);
        }
    }
    Result<Adapter> adapter = examine(instance, static_cast<VkPhysicalDevice>(host.physical_device),
                                      Disabled{disabled}, host.queue_family);
    if (!adapter) {
        return fail(adapter.error().code, fmt::format("The host's Vulkan device does not fit: {}.",
                                                      adapter.error().message));
    }
    adapter->dynamic_rendering = is_enabled("dynamicRendering");
    return adapter;
}

}  // namespace gnomon::vk
