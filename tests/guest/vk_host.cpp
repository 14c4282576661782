// SPDX-License-Identifier: MIT
#include "tests/guest/vk_host.hpp"

#include <array>
#include <cstring>
#include <stdexcept>

#include <dlfcn.h>

#include <gnomon/scene/scene.hpp>
#include <gnomon/scene/transforms.hpp>
#include <gnomon_shaders/guest.hpp>

namespace gnomon::test {

namespace {

constexpr VkFormat format = VK_FORMAT_D32_SFLOAT_S8_UINT;
constexpr VkImageAspectFlags both = VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;

void check(VkResult result, const char* call) {
    if (result != VK_SUCCESS)
        throw std::runtime_error(std::string("The host's ") + call + " failed.");
}

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT types,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data,
                                          void* user) {
    if (types != VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT) {
        static_cast<VkHost*>(user)->messages.emplace_back(data->pMessage);
    }
    return VK_FALSE;
}

// What its matrices move points by, in push constants.
struct Matrices {
    glm::mat4 clip_from_world;
    glm::mat4 world_from_local;
};

}  // namespace

Result<std::unique_ptr<VkHost>> VkHost::create(const VkHostWay& way) {
    std::unique_ptr<VkHost> self{new VkHost(way)};
    if (const Status made = self->make_instance(); !made) return forward_error(made);
    if (const Status chosen = self->choose_device(); !chosen) return forward_error(chosen);
    self->make_device();
    self->make_image();
    self->make_render_pass();
    self->make_pipeline();
    return self;
}

Status VkHost::make_instance() {
    static void* const library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) return fail(ErrorCode::Unsupported, "There is no Vulkan loader.");
    get_instance_proc_addr_ =
        reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
    const auto create = reinterpret_cast<PFN_vkCreateInstance>(
        get_instance_proc_addr_(nullptr, "vkCreateInstance"));
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.apiVersion = VK_API_VERSION_1_1;
    const char* layer = "VK_LAYER_KHRONOS_validation";
    const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &layer;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
    if (create(&info, nullptr, &instance_) != VK_SUCCESS) {
        return fail(ErrorCode::Unsupported, "There is no Vulkan instance with a validation layer.");
    }
#define GNOMON_HOST_LOAD(name) \
    name = reinterpret_cast<PFN_vk##name>(get_instance_proc_addr_(instance_, "vk" #name));
    GNOMON_HOST_INSTANCE_FUNCTIONS(GNOMON_HOST_LOAD)
#undef GNOMON_HOST_LOAD
    VkDebugUtilsMessengerCreateInfoEXT messenger{};
    messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                                VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                            VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    messenger.pfnUserCallback = on_message;
    messenger.pUserData = this;
    check(CreateDebugUtilsMessengerEXT(instance_, &messenger, nullptr, &messenger_), "messenger");
    return {};
}

Status VkHost::choose_device() {
    std::uint32_t count = 0;
    EnumeratePhysicalDevices(instance_, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    EnumeratePhysicalDevices(instance_, &count, devices.data());
    for (VkPhysicalDevice device : devices) {
        VkFormatProperties properties{};
        GetPhysicalDeviceFormatProperties(device, format, &properties);
        VkPhysicalDeviceFeatures features{};
        GetPhysicalDeviceFeatures(device, &features);
        const bool fits = (properties.optimalTilingFeatures &
                           VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) != 0 &&
                          features.depthClamp == VK_TRUE;
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
    return fail(ErrorCode::Unsupported, "No Vulkan device has D32_SFLOAT_S8_UINT and depth clamp.");
}

void VkHost::make_device() {
    const float priority = 1.0F;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkPhysicalDeviceFeatures features{};
    features.depthClamp = VK_TRUE;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.pEnabledFeatures = &features;
    check(CreateDevice(physical_, &info, nullptr, &device_), "device");
#define GNOMON_HOST_LOAD(name) \
    name = reinterpret_cast<PFN_vk##name>(GetDeviceProcAddr(device_, "vk" #name));
    GNOMON_HOST_DEVICE_FUNCTIONS(GNOMON_HOST_LOAD)
#undef GNOMON_HOST_LOAD
    GetDeviceQueue(device_, family_, 0, &queue_);
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.queueFamilyIndex = family_;
    check(CreateCommandPool(device_, &pool, nullptr, &pool_), "command pool");
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

void VkHost::make_image() {
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {row_width, row_height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                 VK_IMAGE_USAGE_SAMPLED_BIT;
    check(CreateImage(device_, &info, nullptr, &image_), "image");
    VkMemoryRequirements needs{};
    GetImageMemoryRequirements(device_, image_, &needs);
    VkMemoryAllocateInfo memory{};
    memory.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    memory.allocationSize = needs.size;
    memory.memoryTypeIndex = memory_type(needs.memoryTypeBits, 0);
    check(AllocateMemory(device_, &memory, nullptr, &image_memory_), "memory");
    check(BindImageMemory(device_, image_, image_memory_, 0), "image memory");
    VkImageViewCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view.image = image_;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format;
    view.subresourceRange = {both, 0, 1, 0, 1};
    check(CreateImageView(device_, &view, nullptr, &view_), "image view");
}

void VkHost::make_render_pass() {
    VkAttachmentDescription attachment{};
    attachment.format = format;
    attachment.samples = VK_SAMPLE_COUNT_1_BIT;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    attachment.finalLayout = way_.layout;
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.pDepthStencilAttachment = &reference;
    // Drawn to again and again: after all that came before.
    VkSubpassDependency before{};
    before.srcSubpass = VK_SUBPASS_EXTERNAL;
    before.srcStageMask = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    before.dstStageMask = VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT;
    before.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    before.dstAccessMask =
        VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 1;
    info.pAttachments = &attachment;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = 1;
    info.pDependencies = &before;
    check(CreateRenderPass(device_, &info, nullptr, &render_pass_), "render pass");
    VkFramebufferCreateInfo framebuffer{};
    framebuffer.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    framebuffer.renderPass = render_pass_;
    framebuffer.attachmentCount = 1;
    framebuffer.pAttachments = &view_;
    framebuffer.width = row_width;
    framebuffer.height = row_height;
    framebuffer.layers = 1;
    check(CreateFramebuffer(device_, &framebuffer, nullptr, &framebuffer_), "framebuffer");
}

void VkHost::make_pipeline() {
    VkShaderModuleCreateInfo module{};
    module.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    module.codeSize = guest::shaders::host_vert.spirv.size_bytes();
    module.pCode = guest::shaders::host_vert.spirv.data();
    VkShaderModule shader = VK_NULL_HANDLE;
    check(CreateShaderModule(device_, &module, nullptr, &shader), "shader");
    const VkPushConstantRange constants{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(Matrices)};
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &constants;
    check(CreatePipelineLayout(device_, &layout, nullptr, &layout_), "pipeline layout");
    VkPipelineShaderStageCreateInfo stage{};
    stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    stage.stage = VK_SHADER_STAGE_VERTEX_BIT;
    stage.module = shader;
    stage.pName = "main";
    const VkVertexInputBindingDescription binding{0, sizeof(glm::vec3),
                                                  VK_VERTEX_INPUT_RATE_VERTEX};
    const VkVertexInputAttributeDescription attribute{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0};
    VkPipelineVertexInputStateCreateInfo input{};
    input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    input.vertexBindingDescriptionCount = 1;
    input.pVertexBindingDescriptions = &binding;
    input.vertexAttributeDescriptionCount = 1;
    input.pVertexAttributeDescriptions = &attribute;
    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    const VkViewport viewport{0, 0, row_width, row_height, 0, 1};
    const VkRect2D scissor{{0, 0}, {row_width, row_height}};
    VkPipelineViewportStateCreateInfo viewports{};
    viewports.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewports.viewportCount = 1;
    viewports.pViewports = &viewport;
    viewports.scissorCount = 1;
    viewports.pScissors = &scissor;
    VkPipelineRasterizationStateCreateInfo raster{};
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.lineWidth = 1.0F;
    VkPipelineMultisampleStateCreateInfo samples{};
    samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = VK_TRUE;
    depth.depthWriteEnable = VK_TRUE;
    depth.depthCompareOp = way_.reversed ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_LESS;
    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.stageCount = 1;
    info.pStages = &stage;
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewports;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.layout = layout_;
    info.renderPass = render_pass_;
    check(CreateGraphicsPipelines(device_, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_),
          "pipeline");
    DestroyShaderModule(device_, shader, nullptr);
}

VkHost::Buffer VkHost::make_buffer(const void* data, VkDeviceSize size, VkBufferUsageFlags usage) {
    Buffer buffer;
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = size;
    info.usage = usage;
    check(CreateBuffer(device_, &info, nullptr, &buffer.handle), "buffer");
    VkMemoryRequirements needs{};
    GetBufferMemoryRequirements(device_, buffer.handle, &needs);
    VkMemoryAllocateInfo memory{};
    memory.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    memory.allocationSize = needs.size;
    memory.memoryTypeIndex =
        memory_type(needs.memoryTypeBits,
                    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    check(AllocateMemory(device_, &memory, nullptr, &buffer.memory), "memory");
    check(BindBufferMemory(device_, buffer.handle, buffer.memory, 0), "buffer memory");
    if (data != nullptr) {
        void* mapped = nullptr;
        check(MapMemory(device_, buffer.memory, 0, size, 0, &mapped), "mapping");
        std::memcpy(mapped, data, size);
        UnmapMemory(device_, buffer.memory);
    }
    return buffer;
}

void VkHost::free_buffer(const Buffer& buffer) {
    DestroyBuffer(device_, buffer.handle, nullptr);
    FreeMemory(device_, buffer.memory, nullptr);
}

VkHost::~VkHost() {
    if (device_ != VK_NULL_HANDLE) {
        QueueWaitIdle(queue_);
        DestroyPipeline(device_, pipeline_, nullptr);
        DestroyPipelineLayout(device_, layout_, nullptr);
        DestroyFramebuffer(device_, framebuffer_, nullptr);
        DestroyRenderPass(device_, render_pass_, nullptr);
        DestroyImageView(device_, view_, nullptr);
        DestroyImage(device_, image_, nullptr);
        FreeMemory(device_, image_memory_, nullptr);
        DestroyCommandPool(device_, pool_, nullptr);
        DestroyDevice(device_, nullptr);
    }
    if (instance_ != VK_NULL_HANDLE) {
        DestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
        DestroyInstance(instance_, nullptr);
    }
}

vk::HostDevice VkHost::device() const {
    return {.get_instance_proc_addr = reinterpret_cast<void*>(get_instance_proc_addr_),
            .instance = instance_,
            .physical_device = physical_,
            .device = device_,
            .queue = queue_,
            .queue_family = family_,
            .enabled_features = {"depthClamp"}};
}

vk::HostImage VkHost::image() const {
    return {reinterpret_cast<std::uint64_t>(image_), static_cast<std::uint32_t>(way_.layout)};
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
    VkCommandBufferAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocate.commandPool = pool_;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    check(AllocateCommandBuffers(device_, &allocate, &commands_), "command buffer");
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(BeginCommandBuffer(commands_, &info), "command buffer's beginning");
    return commands_;
}

void VkHost::end() {
    check(EndCommandBuffer(commands_), "command buffer's end");
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands_;
    check(QueueSubmit(queue_, 1, &info, VK_NULL_HANDLE), "submission");
    check(QueueWaitIdle(queue_), "waiting");
    FreeCommandBuffers(device_, pool_, 1, &commands_);
}

void VkHost::draw(const Setting& setting) {
    const Camera camera = camera_of(setting);
    begin();
    VkClearValue clear{};
    clear.depthStencil = {way_.reversed ? 0.0F : 1.0F, 0x55};
    VkRenderPassBeginInfo pass{};
    pass.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    pass.renderPass = render_pass_;
    pass.framebuffer = framebuffer_;
    pass.renderArea = {{0, 0}, {row_width, row_height}};
    pass.clearValueCount = 1;
    pass.pClearValues = &clear;
    CmdBeginRenderPass(commands_, &pass, VK_SUBPASS_CONTENTS_INLINE);
    CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
    std::vector<Buffer> buffers;
    setting.scene.registry.each<scene::Receiver, scene::MeshInstance, scene::WorldTransform>(
        [&](scene::Entity entity, const scene::Receiver&, const scene::MeshInstance& instance,
            const scene::WorldTransform& transform) {
            const scene::Geometry geometry =
                scene::geometry_of(setting.scene.registry, entity, instance, transform);
            const auto bytes = std::as_bytes(geometry.positions);
            const std::vector<std::uint32_t>& indices = instance.mesh->indices;
            buffers.push_back(
                make_buffer(bytes.data(), bytes.size(), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT));
            const VkDeviceSize zero = 0;
            CmdBindVertexBuffers(commands_, 0, 1, &buffers.back().handle, &zero);
            buffers.push_back(
                make_buffer(indices.data(), 4 * indices.size(), VK_BUFFER_USAGE_INDEX_BUFFER_BIT));
            CmdBindIndexBuffer(commands_, buffers.back().handle, 0, VK_INDEX_TYPE_UINT32);
            Matrices matrices{camera.clip_from_view * camera.view_from_world,
                              glm::mat4(geometry.world_from_positions)};
            // The build lets every vertex shader negate y at its end, this host's as well.
            for (int c = 0; c < 4; ++c) {
                matrices.clip_from_world[c][1] = -matrices.clip_from_world[c][1];
            }
            CmdPushConstants(commands_, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof matrices,
                             &matrices);
            CmdDrawIndexed(commands_, static_cast<std::uint32_t>(indices.size()), 1, 0, 0, 0);
        });
    CmdEndRenderPass(commands_);
    end();
    for (const Buffer& buffer : buffers) free_buffer(buffer);
}

void VkHost::move_image(VkImageLayout from, VkImageLayout to) {
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image_;
    barrier.subresourceRange = {both, 0, 1, 0, 1};
    CmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                       VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

std::vector<std::uint8_t> VkHost::stencil() {
    std::vector<std::uint8_t> rows(std::size_t{row_width} * row_height);
    const Buffer buffer = make_buffer(nullptr, rows.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    begin();
    move_image(way_.layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_STENCIL_BIT, 0, 0, 1};
    region.imageExtent = {row_width, row_height, 1};
    CmdCopyImageToBuffer(commands_, image_, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer.handle, 1,
                         &region);
    move_image(VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, way_.layout);
    end();
    void* mapped = nullptr;
    check(MapMemory(device_, buffer.memory, 0, rows.size(), 0, &mapped), "mapping");
    std::memcpy(rows.data(), mapped, rows.size());
    UnmapMemory(device_, buffer.memory);
    free_buffer(buffer);
    return rows;
}

}  // namespace gnomon::test
