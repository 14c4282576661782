// SPDX-License-Identifier: MIT
#include "tests/guest/vk_host.hpp"

#include <cstring>
#include <stdexcept>
#include <string_view>

#include <dlfcn.h>

namespace gnomon::test {

namespace {

constexpr VkFormat depth_format = VK_FORMAT_D32_SFLOAT_S8_UINT;
// One that gnomon's own interface does not know.
constexpr VkFormat color_format = VK_FORMAT_B8G8R8A8_UNORM;

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT types,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data,
                                          void* user) {
    if (types != VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT) {
        static_cast<VkHost*>(user)->messages.emplace_back(data->pMessage);
    }
    return VK_FALSE;
}

VkImageAspectFlags aspects_of(VkFormat format) {
    return format == depth_format ? VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT
                                  : VK_IMAGE_ASPECT_COLOR_BIT;
}

// What gnomon calls is counted: it asks the host for its functions.
struct Counting {
    PFN_vkGetInstanceProcAddr instance_proc_addr = nullptr;
    PFN_vkGetDeviceProcAddr device_proc_addr = nullptr;
    PFN_vkQueueSubmit submit = nullptr;
    PFN_vkCreateGraphicsPipelines create_pipelines = nullptr;
    std::size_t submissions = 0;
    std::size_t pipelines = 0;
};
Counting counting;

VKAPI_ATTR VkResult VKAPI_CALL counted_submit(VkQueue queue, std::uint32_t count,
                                              const VkSubmitInfo* infos, VkFence fence) {
    ++counting.submissions;
    return counting.submit(queue, count, infos, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL counted_pipelines(VkDevice device, VkPipelineCache cache,
                                                 std::uint32_t count,
                                                 const VkGraphicsPipelineCreateInfo* infos,
                                                 const VkAllocationCallbacks* allocator,
                                                 VkPipeline* pipelines) {
    counting.pipelines += count;
    return counting.create_pipelines(device, cache, count, infos, allocator, pipelines);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL counting_device_proc_addr(VkDevice device,
                                                                   const char* name) {
    const PFN_vkVoidFunction found = counting.device_proc_addr(device, name);
    const std::string_view wanted(name);
    if (wanted == "vkQueueSubmit") {
        counting.submit = reinterpret_cast<PFN_vkQueueSubmit>(found);
        return reinterpret_cast<PFN_vkVoidFunction>(&counted_submit);
    }
    if (wanted == "vkCreateGraphicsPipelines") {
        counting.create_pipelines = reinterpret_cast<PFN_vkCreateGraphicsPipelines>(found);
        return reinterpret_cast<PFN_vkVoidFunction>(&counted_pipelines);
    }
    return found;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL counting_instance_proc_addr(VkInstance instance,
                                                                     const char* name) {
    const PFN_vkVoidFunction found = counting.instance_proc_addr(instance, name);
    if (std::string_view(name) != "vkGetDeviceProcAddr") return found;
    counting.device_proc_addr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(found);
    return reinterpret_cast<PFN_vkVoidFunction>(&counting_device_proc_addr);
}

bool offers_validation_features(PFN_vkGetInstanceProcAddr find, const char* layer) {
    const auto enumerate = reinterpret_cast<PFN_vkEnumerateInstanceExtensionProperties>(
        find(nullptr, "vkEnumerateInstanceExtensionProperties"));
    std::uint32_t count = 0;
    if (enumerate(layer, &count, nullptr) != VK_SUCCESS) return false;
    std::vector<VkExtensionProperties> extensions(count);
    enumerate(layer, &count, extensions.data());
    for (const VkExtensionProperties& extension : extensions) {
        if (std::string_view(extension.extensionName) == VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME)
            return true;
    }
    return false;
}

}  // namespace

std::size_t VkHost::submissions() { return counting.submissions; }
std::size_t VkHost::pipelines() { return counting.pipelines; }

void check_vk(VkResult result, const char* call) {
    if (result != VK_SUCCESS)
        throw std::runtime_error(std::string("The host's ") + call + " failed.");
}

Result<std::unique_ptr<VkHost>> VkHost::create(const VkHostWay& way) {
    std::unique_ptr<VkHost> self{new VkHost(way)};
    if (const Status made = self->make_instance(); !made) return forward_error(made);
    if (const Status chosen = self->choose_device(); !chosen) return forward_error(chosen);
    self->make_device();
    self->depth_ = self->make_image(
        depth_format, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
        way.samples);
    if (way.in_pass != InPass::No) {
        self->color_ =
            self->make_image(color_format, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, way.samples);
    }
    if (way.in_pass != InPass::Dynamic) self->make_render_pass();
    self->make_pipeline();
    return self;
}

VkHost::~VkHost() {
    if (device_ != VK_NULL_HANDLE) wait();
    while (!frees_.empty()) {
        frees_.back()();
        frees_.pop_back();
    }
}

Status VkHost::make_instance() {
    static void* const library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) return fail(ErrorCode::Unsupported, "There is no Vulkan loader.");
    get_instance_proc_addr_ =
        reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
    const auto create = reinterpret_cast<PFN_vkCreateInstance>(
        get_instance_proc_addr_(nullptr, "vkCreateInstance"));
    auto application = vk_info<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.apiVersion =
        way_.in_pass == InPass::Dynamic ? VK_API_VERSION_1_3 : VK_API_VERSION_1_1;
    const char* layer = "VK_LAYER_KHRONOS_validation";
    counting = {.instance_proc_addr = get_instance_proc_addr_};
    std::vector<const char*> extensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
    // Also looks for accesses that wait for nothing.
    const VkValidationFeatureEnableEXT synchronization =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    auto validation = vk_info<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
    validation.enabledValidationFeatureCount = 1;
    validation.pEnabledValidationFeatures = &synchronization;
    auto info = vk_info<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    info.pApplicationInfo = &application;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &layer;
    if (offers_validation_features(get_instance_proc_addr_, layer)) {
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
        info.pNext = &validation;
    }
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    if (create(&info, nullptr, &instance_) != VK_SUCCESS) {
        return fail(ErrorCode::Unsupported, "There is no Vulkan instance with a validation layer.");
    }
#define GNOMON_HOST_LOAD(name) \
    name = reinterpret_cast<PFN_vk##name>(get_instance_proc_addr_(instance_, "vk" #name));
    GNOMON_HOST_INSTANCE_FUNCTIONS(GNOMON_HOST_LOAD)
#undef GNOMON_HOST_LOAD
    at_the_end([this] { DestroyInstance(instance_, nullptr); });
    auto messenger = vk_info<VkDebugUtilsMessengerCreateInfoEXT>(
        VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                                VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                            VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    messenger.pfnUserCallback = on_message;
    messenger.pUserData = this;
    check_vk(CreateDebugUtilsMessengerEXT(instance_, &messenger, nullptr, &messenger_),
             "messenger");
    at_the_end([this] { DestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr); });
    return {};
}

Status VkHost::choose_device() {
    const std::uint32_t version =
        way_.in_pass == InPass::Dynamic ? VK_API_VERSION_1_3 : VK_API_VERSION_1_1;
    std::uint32_t count = 0;
    EnumeratePhysicalDevices(instance_, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    EnumeratePhysicalDevices(instance_, &count, devices.data());
    for (VkPhysicalDevice device : devices) {
        VkPhysicalDeviceProperties properties{};
        GetPhysicalDeviceProperties(device, &properties);
        VkFormatProperties depth{};
        GetPhysicalDeviceFormatProperties(device, depth_format, &depth);
        VkPhysicalDeviceFeatures features{};
        GetPhysicalDeviceFeatures(device, &features);
        const bool fits =
            properties.apiVersion >= version &&
            (depth.optimalTilingFeatures & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) != 0 &&
            features.depthClamp == VK_TRUE &&
            (way_.samples == 1 || !way_.sample_shading || features.sampleRateShading == VK_TRUE);
        std::uint32_t families = 0;
        GetPhysicalDeviceQueueFamilyProperties(device, &families, nullptr);
        std::vector<VkQueueFamilyProperties> family(families);
        GetPhysicalDeviceQueueFamilyProperties(device, &families, family.data());
        for (std::uint32_t i = 0; fits && i < families; ++i) {
            if ((family[i].queueFlags & VK_QUEUE_GRAPHICS_BIT) == 0) continue;
            physical_ = device;
            family_ = i;
            return {};
        }
    }
    return fail(ErrorCode::Unsupported,
                "No Vulkan device has D32_SFLOAT_S8_UINT, depth clamp and what else is wanted.");
}

void VkHost::make_device() {
    const float priority = 1.0F;
    auto queue = vk_info<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queue.queueFamilyIndex = family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkPhysicalDeviceFeatures features{};
    features.depthClamp = VK_TRUE;
    features.sampleRateShading = way_.samples > 1 && way_.sample_shading ? VK_TRUE : VK_FALSE;
    auto of_1_3 = vk_info<VkPhysicalDeviceVulkan13Features>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
    of_1_3.dynamicRendering = VK_TRUE;
    auto info = vk_info<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    if (way_.in_pass == InPass::Dynamic) info.pNext = &of_1_3;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.pEnabledFeatures = &features;
    check_vk(CreateDevice(physical_, &info, nullptr, &device_), "device");
#define GNOMON_HOST_LOAD(name) \
    name = reinterpret_cast<PFN_vk##name>(GetDeviceProcAddr(device_, "vk" #name));
    GNOMON_HOST_DEVICE_FUNCTIONS(GNOMON_HOST_LOAD)
#undef GNOMON_HOST_LOAD
    at_the_end([this] { DestroyDevice(device_, nullptr); });
    GetDeviceQueue(device_, family_, 0, &queue_);
    auto pool = vk_info<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    pool.queueFamilyIndex = family_;
    check_vk(CreateCommandPool(device_, &pool, nullptr, &pool_), "command pool");
    at_the_end([this] { DestroyCommandPool(device_, pool_, nullptr); });
}

std::uint32_t VkHost::memory_type(std::uint32_t allowed, VkMemoryPropertyFlags wanted) const {
    VkPhysicalDeviceMemoryProperties properties{};
    GetPhysicalDeviceMemoryProperties(physical_, &properties);
    for (std::uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
        const bool fits = (properties.memoryTypes[i].propertyFlags & wanted) == wanted;
        if ((allowed >> i & 1U) != 0 && fits) return i;
    }
    throw std::runtime_error("The host finds no memory.");
}

VkHost::Image VkHost::make_image(VkFormat format, VkImageUsageFlags usage, std::uint32_t samples) {
    Image image;
    image.aspects = aspects_of(format);
    image.samples = samples;
    auto info = vk_info<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {row_width, row_height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = static_cast<VkSampleCountFlagBits>(samples);
    info.usage = usage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    check_vk(CreateImage(device_, &info, nullptr, &image.handle), "image");
    VkMemoryRequirements needs{};
    GetImageMemoryRequirements(device_, image.handle, &needs);
    auto memory = vk_info<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    memory.allocationSize = needs.size;
    memory.memoryTypeIndex = memory_type(needs.memoryTypeBits, 0);
    VkDeviceMemory allocated = VK_NULL_HANDLE;
    check_vk(AllocateMemory(device_, &memory, nullptr, &allocated), "memory");
    at_the_end([this, allocated, handle = image.handle] {
        DestroyImage(device_, handle, nullptr);
        FreeMemory(device_, allocated, nullptr);
    });
    check_vk(BindImageMemory(device_, image.handle, allocated, 0), "image memory");
    image.view = make_view(image.handle, format, image.aspects);
    if (format == depth_format) {
        image.stencil_view = make_view(image.handle, format, VK_IMAGE_ASPECT_STENCIL_BIT);
    }
    return image;
}

VkImageView VkHost::make_view(VkImage image, VkFormat format, VkImageAspectFlags aspects) {
    auto info = vk_info<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    info.image = image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange = {aspects, 0, 1, 0, 1};
    VkImageView view = VK_NULL_HANDLE;
    check_vk(CreateImageView(device_, &info, nullptr, &view), "image view");
    at_the_end([this, view] { DestroyImageView(device_, view, nullptr); });
    return view;
}

VkHost::Buffer VkHost::make_buffer(const void* data, VkDeviceSize size, VkBufferUsageFlags usage) {
    Buffer buffer;
    auto info = vk_info<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = size;
    info.usage = usage;
    check_vk(CreateBuffer(device_, &info, nullptr, &buffer.handle), "buffer");
    VkMemoryRequirements needs{};
    GetBufferMemoryRequirements(device_, buffer.handle, &needs);
    auto memory = vk_info<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    memory.allocationSize = needs.size;
    memory.memoryTypeIndex =
        memory_type(needs.memoryTypeBits,
                    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    check_vk(AllocateMemory(device_, &memory, nullptr, &buffer.memory), "memory");
    check_vk(BindBufferMemory(device_, buffer.handle, buffer.memory, 0), "buffer memory");
    if (data != nullptr) {
        void* mapped = nullptr;
        check_vk(MapMemory(device_, buffer.memory, 0, size, 0, &mapped), "mapping");
        std::memcpy(mapped, data, size);
        UnmapMemory(device_, buffer.memory);
    }
    return buffer;
}

void VkHost::free_buffer(const Buffer& buffer) {
    DestroyBuffer(device_, buffer.handle, nullptr);
    FreeMemory(device_, buffer.memory, nullptr);
}

vk::HostDevice VkHost::device() const {
    vk::HostDevice device{
        .get_instance_proc_addr = reinterpret_cast<void*>(&counting_instance_proc_addr),
        .instance = instance_,
        .physical_device = physical_,
        .device = device_,
        .queue = queue_,
        .queue_family = family_,
        .enabled_features = {"depthClamp"}};
    if (way_.samples > 1 && way_.sample_shading) {
        device.enabled_features.emplace_back("sampleRateShading");
    }
    if (way_.in_pass == InPass::Dynamic) device.enabled_features.emplace_back("dynamicRendering");
    return device;
}

vk::HostImage VkHost::image() const {
    return {reinterpret_cast<std::uint64_t>(depth_.handle),
            static_cast<std::uint32_t>(way_.layout)};
}

vk::HostRenderPass VkHost::render_pass() const {
    return {.render_pass = reinterpret_cast<std::uint64_t>(render_pass_),
            .subpass = way_.in_pass == InPass::Classic ? 1U : 0U,
            .color_formats = {color_format}};
}

shadows::HostConventions VkHost::conventions() const {
    return {shadows::HostDepth::ZeroToOne, way_.reversed};
}

VkHost::Camera VkHost::camera_of(const Setting& setting) const {
    glm::dmat4 clip = setting.view.clip_from_view;
    // Nearer, forward depth has too few steps: the bias of caps would reach through contacts.
    constexpr double near_m = 0.05;
    clip[3][2] = near_m;
    if (way_.finite) {
        constexpr double far_m = 60.0;
        clip[2][2] = near_m / (far_m - near_m);
        clip[3][2] = near_m * far_m / (far_m - near_m);
    }
    for (int c = 0; c < 4; ++c) {
        if (!way_.reversed) clip[c][2] = clip[c][3] - clip[c][2];
        clip[c][1] = -clip[c][1];  // y points down, as hosts on Vulkan have it
    }
    return {glm::mat4(setting.view.view_from_world), glm::mat4(clip)};
}

VkCommandBuffer VkHost::begin() {
    auto allocate =
        vk_info<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocate.commandPool = pool_;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    check_vk(AllocateCommandBuffers(device_, &allocate, &commands_), "command buffer");
    auto info = vk_info<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check_vk(BeginCommandBuffer(commands_, &info), "command buffer's beginning");
    return commands_;
}

void VkHost::end() {
    check_vk(EndCommandBuffer(commands_), "command buffer's end");
    auto info = vk_info<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands_;
    check_vk(QueueSubmit(queue_, 1, &info, VK_NULL_HANDLE), "submission");
    submitted_.push_back(commands_);
    if (waits) wait();
}

void VkHost::wait() {
    check_vk(QueueWaitIdle(queue_), "waiting");
    for (VkCommandBuffer commands : submitted_) {
        FreeCommandBuffers(device_, pool_, 1, &commands);
    }
    submitted_.clear();
    for (const Buffer& buffer : read_by_submitted_) free_buffer(buffer);
    read_by_submitted_.clear();
}

}  // namespace gnomon::test
