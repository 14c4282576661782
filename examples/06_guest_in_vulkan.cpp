// SPDX-License-Identifier: MIT
//
// gnomon as a guest in somebody else's Vulkan: a plain program with a device, images, pipelines and
// a command buffer of its own (Vulkan 1.3, dynamic rendering, no window). What gnomon adds to it is
// marked by "// guest". One render pass draws ambient light and depth, then the guest's volumes,
// recorded into it, then the lamp's light where the stencil is 0.
//
// Writes guest_in_vulkan.ppm and says how many pixels lie in shadow.
#include <vulkan/vulkan.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

#define GLM_FORCE_DEPTH_ZERO_TO_ONE  // this host's glm::perspective is Vulkan's
#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/shadow_pass/guest_pass.hpp>
#include <gnomon/vk/host_device.hpp>

#include "06_host_frag.h"
#include "06_host_vert.h"

namespace {

using namespace gnomon;

constexpr std::uint32_t width = 640;
constexpr std::uint32_t height = 360;
constexpr VkFormat color_format = VK_FORMAT_R8G8B8A8_UNORM;
constexpr VkFormat depth_format = VK_FORMAT_D32_SFLOAT_S8_UINT;
constexpr VkImageAspectFlags depth_and_stencil =
    VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;

// ---- The host: what a renderer has anyway.

void check(VkResult result, const char* what) {
    if (result != VK_SUCCESS) throw std::runtime_error(std::string(what) + " failed.");
}

template <class Info>
Info make(VkStructureType type) {
    Info info{};
    info.sType = type;
    return info;
}

struct Image {
    VkImage handle = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
};

struct Buffer {
    VkBuffer handle = VK_NULL_HANDLE;
    void* mapped = nullptr;
};

struct Thing {
    std::uint64_t id = 0;
    glm::vec3 albedo{1.0F};
    glm::mat4 model{1.0F};
};

struct PushConstants {
    glm::mat4 clip_from_local;
    std::array<glm::vec4, 3> world_from_local;
    glm::vec4 albedo;
};

std::vector<glm::vec3> cube_corners() {
    std::vector<glm::vec3> corners;
    for (unsigned i = 0; i < 8; ++i) {
        corners.emplace_back((i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1,
                             (i & 4U) != 0 ? 1 : -1);
    }
    return corners;
}

class Host {
public:
    Host() {
        make_device();
        color_ = make_image(color_format, VK_IMAGE_ASPECT_COLOR_BIT,
                            VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
        depth_ = make_image(depth_format, depth_and_stencil,
                            VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
        ambient_ = make_pipeline(false);
        lamp_ = make_pipeline(true);
        vertices_ =
            make_buffer(positions.size() * sizeof(glm::vec3), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
        std::memcpy(vertices_.mapped, positions.data(), positions.size() * sizeof(glm::vec3));
        indices_ = make_buffer(indices.size() * 4, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
        std::memcpy(indices_.mapped, indices.data(), indices.size() * 4);
        const auto place = [](const glm::vec3& middle, float turn, const glm::vec3& half) {
            return glm::scale(glm::rotate(glm::translate(glm::mat4(1.0F), middle), turn,
                                          glm::vec3(0.3F, 1.0F, 0.2F)),
                              half);
        };
        things = {{1, {0.5F, 0.55F, 0.5F}, place({0, -0.5F, 0}, 0.0F, {8, 0.5F, 8})},
                  {2, {0.8F, 0.4F, 0.3F}, place({-0.9F, 1.1F, 0.2F}, 0.7F, {0.6F, 0.6F, 0.6F})},
                  {3, {1, 1, 1}, place({1.2F, 0.9F, -0.4F}, 0.0F, {0.25F, 0.9F, 0.25F})}};
        projection[1] = -projection[1];  // y points down
    }
    ~Host() {
        if (device != VK_NULL_HANDLE) vkDeviceWaitIdle(device);
        while (!frees_.empty()) {
            frees_.back()();
            frees_.pop_back();
        }
    }
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    VkCommandBuffer begin() {
        auto allocate =
            make<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
        allocate.commandPool = pool_;
        allocate.commandBufferCount = 1;
        check(vkAllocateCommandBuffers(device, &allocate, &commands_), "vkAllocateCommandBuffers");
        auto info = make<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
        check(vkBeginCommandBuffer(commands_, &info), "vkBeginCommandBuffer");
        return commands_;
    }

    /// Begins the pass.
    void draw_depth_and_ambient_light() {
        move(color_, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
             VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
        move(depth_, depth_and_stencil, VK_IMAGE_LAYOUT_UNDEFINED,
             VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
        begin_rendering();
        draw(ambient_);
    }

    /// Once more, added up: where nothing but this surface is in front, and no shadow. Ends the
    /// pass.
    void add_lamp() {
        draw(lamp_);
        vkCmdEndRendering(commands_);
    }

    /// Submits, waits, and writes the picture.
    void end(const char* file) {
        const Buffer colors = make_buffer(4 * width * height, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
        const Buffer counts = make_buffer(width * height, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
        move(color_, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
             VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        copy(color_, VK_IMAGE_ASPECT_COLOR_BIT, colors);
        move(depth_, depth_and_stencil, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
             VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        copy(depth_, VK_IMAGE_ASPECT_STENCIL_BIT, counts);
        check(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
        auto info = make<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
        info.commandBufferCount = 1;
        info.pCommandBuffers = &commands_;
        check(vkQueueSubmit(queue, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit");
        check(vkQueueWaitIdle(queue), "vkQueueWaitIdle");

        std::size_t shadowed = 0;
        std::ofstream out(file, std::ios::binary);
        out << "P6 " << width << ' ' << height << " 255\n";
        for (std::size_t i = 0; i < std::size_t{width} * height; ++i) {
            shadowed += static_cast<const unsigned char*>(counts.mapped)[i] != 0 ? 1 : 0;
            out.write(static_cast<const char*>(colors.mapped) + 4 * i, 3);
        }
        std::printf("%zu of %u pixels lie in shadow\n", shadowed, width * height);
    }

    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    std::uint32_t queue_family = 0;

    std::vector<glm::vec3> positions = cube_corners();
    std::vector<std::uint32_t> indices{0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                       2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    std::vector<Thing> things;
    glm::mat4 view =
        glm::lookAt(glm::vec3(-1.5F, 3.0F, 5.5F), glm::vec3(0, 0.6F, 0), glm::vec3(0, 1, 0));
    glm::mat4 projection = glm::perspective(0.8F, 640.0F / 360.0F, 0.1F, 100.0F);

private:
    void at_the_end(std::function<void()> free) { frees_.push_back(std::move(free)); }

    void make_device() {
        auto application = make<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
        application.apiVersion = VK_API_VERSION_1_3;
        auto instance_info = make<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
        instance_info.pApplicationInfo = &application;
        check(vkCreateInstance(&instance_info, nullptr, &instance), "vkCreateInstance");
        at_the_end([this] { vkDestroyInstance(instance, nullptr); });
        std::uint32_t count = 0;
        vkEnumeratePhysicalDevices(instance, &count, nullptr);
        std::vector<VkPhysicalDevice> devices(count);
        vkEnumeratePhysicalDevices(instance, &count, devices.data());
        for (VkPhysicalDevice candidate : devices) {
            VkPhysicalDeviceProperties properties;
            vkGetPhysicalDeviceProperties(candidate, &properties);
            VkFormatProperties format;
            vkGetPhysicalDeviceFormatProperties(candidate, depth_format, &format);
            const bool fits = properties.apiVersion >= VK_API_VERSION_1_3 &&
                              (format.optimalTilingFeatures &
                               VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) != 0;
            std::uint32_t families = 0;
            vkGetPhysicalDeviceQueueFamilyProperties(candidate, &families, nullptr);
            std::vector<VkQueueFamilyProperties> family(families);
            vkGetPhysicalDeviceQueueFamilyProperties(candidate, &families, family.data());
            for (std::uint32_t i = 0; fits && physical_device == VK_NULL_HANDLE && i < families;
                 ++i) {
                if ((family[i].queueFlags & VK_QUEUE_GRAPHICS_BIT) == 0) continue;
                physical_device = candidate;
                queue_family = i;
            }
        }
        if (physical_device == VK_NULL_HANDLE) {
            throw std::runtime_error("No device has Vulkan 1.3 and D32_SFLOAT_S8_UINT.");
        }
        const float priority = 1.0F;
        auto queue_info = make<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
        queue_info.queueFamilyIndex = queue_family;
        queue_info.queueCount = 1;
        queue_info.pQueuePriorities = &priority;
        require_features();
        auto features13 = make<VkPhysicalDeviceVulkan13Features>(
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
        features13.dynamicRendering = VK_TRUE;
        VkPhysicalDeviceFeatures features{};
        features.depthClamp = VK_TRUE;  // guest: this camera has a far plane
        auto info = make<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
        info.pNext = &features13;
        info.queueCreateInfoCount = 1;
        info.pQueueCreateInfos = &queue_info;
        info.pEnabledFeatures = &features;
        check(vkCreateDevice(physical_device, &info, nullptr, &device), "vkCreateDevice");
        at_the_end([this] { vkDestroyDevice(device, nullptr); });
        vkGetDeviceQueue(device, queue_family, 0, &queue);
        auto pool = make<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
        pool.queueFamilyIndex = queue_family;
        check(vkCreateCommandPool(device, &pool, nullptr, &pool_), "vkCreateCommandPool");
        at_the_end([this] { vkDestroyCommandPool(device, pool_, nullptr); });
    }

    void require_features() const {
        auto of_1_3 = make<VkPhysicalDeviceVulkan13Features>(
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
        auto all = make<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
        all.pNext = &of_1_3;
        vkGetPhysicalDeviceFeatures2(physical_device, &all);
        if (of_1_3.dynamicRendering == VK_FALSE) {
            throw std::runtime_error(
                "The device lacks dynamicRendering, by which this host draws.");
        }
        if (all.features.depthClamp == VK_FALSE) {  // guest
            throw std::runtime_error(
                "The device lacks depthClamp, without which volumes end at this camera's far "
                "plane.");
        }
    }

    [[nodiscard]] VkDeviceMemory allocate(const VkMemoryRequirements& needs,
                                          VkMemoryPropertyFlags wanted) {
        VkPhysicalDeviceMemoryProperties properties;
        vkGetPhysicalDeviceMemoryProperties(physical_device, &properties);
        auto info = make<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
        info.allocationSize = needs.size;
        while ((needs.memoryTypeBits >> info.memoryTypeIndex & 1U) == 0 ||
               (properties.memoryTypes[info.memoryTypeIndex].propertyFlags & wanted) != wanted) {
            ++info.memoryTypeIndex;
        }
        VkDeviceMemory memory = VK_NULL_HANDLE;
        check(vkAllocateMemory(device, &info, nullptr, &memory), "vkAllocateMemory");
        at_the_end([this, memory] { vkFreeMemory(device, memory, nullptr); });
        return memory;
    }

    [[nodiscard]] Image make_image(VkFormat format, VkImageAspectFlags aspects,
                                   VkImageUsageFlags usage) {
        Image image;
        auto info = make<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = format;
        info.extent = {width, height, 1};
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = VK_SAMPLE_COUNT_1_BIT;
        info.usage = usage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        check(vkCreateImage(device, &info, nullptr, &image.handle), "vkCreateImage");
        at_the_end([this, image] { vkDestroyImage(device, image.handle, nullptr); });
        VkMemoryRequirements needs;
        vkGetImageMemoryRequirements(device, image.handle, &needs);
        check(vkBindImageMemory(device, image.handle, allocate(needs, 0), 0), "vkBindImageMemory");
        auto view_info = make<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
        view_info.image = image.handle;
        view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
        view_info.format = format;
        view_info.subresourceRange = {aspects, 0, 1, 0, 1};
        check(vkCreateImageView(device, &view_info, nullptr, &image.view), "vkCreateImageView");
        at_the_end([this, image] { vkDestroyImageView(device, image.view, nullptr); });
        return image;
    }

    [[nodiscard]] Buffer make_buffer(VkDeviceSize size, VkBufferUsageFlags usage) {
        Buffer buffer;
        auto info = make<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
        info.size = size;
        info.usage = usage;
        check(vkCreateBuffer(device, &info, nullptr, &buffer.handle), "vkCreateBuffer");
        at_the_end([this, buffer] { vkDestroyBuffer(device, buffer.handle, nullptr); });
        VkMemoryRequirements needs;
        vkGetBufferMemoryRequirements(device, buffer.handle, &needs);
        VkDeviceMemory memory = allocate(
            needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
        check(vkBindBufferMemory(device, buffer.handle, memory, 0), "vkBindBufferMemory");
        check(vkMapMemory(device, memory, 0, size, 0, &buffer.mapped), "vkMapMemory");
        return buffer;
    }

    /// Ambient light writes depth; the lamp adds to it where the stencil is 0.
    [[nodiscard]] VkPipeline make_pipeline(bool lamp) {
        const auto stage = [&](VkShaderStageFlagBits which, const std::uint32_t* code,
                               std::size_t bytes) {
            auto info = make<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
            info.codeSize = bytes;
            info.pCode = code;
            auto result = make<VkPipelineShaderStageCreateInfo>(
                VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
            result.stage = which;
            result.pName = "main";
            check(vkCreateShaderModule(device, &info, nullptr, &result.module),
                  "vkCreateShaderModule");
            at_the_end([this, result] { vkDestroyShaderModule(device, result.module, nullptr); });
            return result;
        };
        std::array stages{stage(VK_SHADER_STAGE_VERTEX_BIT, host_vert, sizeof host_vert),
                          stage(VK_SHADER_STAGE_FRAGMENT_BIT, host_frag, sizeof host_frag)};
        const VkBool32 shines = lamp ? VK_TRUE : VK_FALSE;
        const VkSpecializationMapEntry entry{0, 0, sizeof shines};
        const VkSpecializationInfo constants{1, &entry, sizeof shines, &shines};
        stages[1].pSpecializationInfo = &constants;
        if (layout_ == VK_NULL_HANDLE) {
            const VkPushConstantRange range{
                VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                sizeof(PushConstants)};
            auto info =
                make<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
            info.pushConstantRangeCount = 1;
            info.pPushConstantRanges = &range;
            check(vkCreatePipelineLayout(device, &info, nullptr, &layout_),
                  "vkCreatePipelineLayout");
            at_the_end([this] { vkDestroyPipelineLayout(device, layout_, nullptr); });
        }
        const VkVertexInputBindingDescription binding{0, sizeof(glm::vec3),
                                                      VK_VERTEX_INPUT_RATE_VERTEX};
        const VkVertexInputAttributeDescription attribute{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0};
        auto input = make<VkPipelineVertexInputStateCreateInfo>(
            VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
        input.vertexBindingDescriptionCount = 1;
        input.pVertexBindingDescriptions = &binding;
        input.vertexAttributeDescriptionCount = 1;
        input.pVertexAttributeDescriptions = &attribute;
        auto assembly = make<VkPipelineInputAssemblyStateCreateInfo>(
            VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
        assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
        const VkViewport viewport{0, 0, width, height, 0, 1};
        const VkRect2D scissor{{0, 0}, {width, height}};
        auto viewports = make<VkPipelineViewportStateCreateInfo>(
            VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
        viewports.viewportCount = viewports.scissorCount = 1;
        viewports.pViewports = &viewport;
        viewports.pScissors = &scissor;
        auto raster = make<VkPipelineRasterizationStateCreateInfo>(
            VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
        raster.lineWidth = 1.0F;
        auto samples = make<VkPipelineMultisampleStateCreateInfo>(
            VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
        samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
        auto depth = make<VkPipelineDepthStencilStateCreateInfo>(
            VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
        depth.depthTestEnable = VK_TRUE;
        depth.depthWriteEnable = lamp ? VK_FALSE : VK_TRUE;
        depth.depthCompareOp = lamp ? VK_COMPARE_OP_EQUAL : VK_COMPARE_OP_LESS;
        depth.stencilTestEnable = lamp ? VK_TRUE : VK_FALSE;
        depth.front.compareOp = VK_COMPARE_OP_EQUAL;  // with the reference, which is 0
        depth.front.compareMask = 0xFF;
        depth.back = depth.front;
        VkPipelineColorBlendAttachmentState blend{};
        blend.colorWriteMask = 0xF;
        blend.blendEnable = lamp ? VK_TRUE : VK_FALSE;
        blend.srcColorBlendFactor = blend.dstColorBlendFactor = VK_BLEND_FACTOR_ONE;
        auto blends = make<VkPipelineColorBlendStateCreateInfo>(
            VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
        blends.attachmentCount = 1;
        blends.pAttachments = &blend;
        auto rendering =
            make<VkPipelineRenderingCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO);
        rendering.colorAttachmentCount = 1;
        rendering.pColorAttachmentFormats = &color_format;
        rendering.depthAttachmentFormat = rendering.stencilAttachmentFormat = depth_format;
        auto info =
            make<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
        info.pNext = &rendering;
        info.stageCount = stages.size();
        info.pStages = stages.data();
        info.pVertexInputState = &input;
        info.pInputAssemblyState = &assembly;
        info.pViewportState = &viewports;
        info.pRasterizationState = &raster;
        info.pMultisampleState = &samples;
        info.pDepthStencilState = &depth;
        info.pColorBlendState = &blends;
        info.layout = layout_;
        VkPipeline pipeline = VK_NULL_HANDLE;
        check(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
              "vkCreateGraphicsPipelines");
        at_the_end([this, pipeline] { vkDestroyPipeline(device, pipeline, nullptr); });
        return pipeline;
    }

    void begin_rendering() const {
        auto color = make<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
        color.imageView = color_.view;
        color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        color.clearValue.color = {{0.05F, 0.06F, 0.08F, 1.0F}};
        VkRenderingAttachmentInfo depth = color;
        depth.imageView = depth_.view;
        depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
        depth.clearValue.depthStencil = {1.0F, 0};
        auto rendering = make<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
        rendering.renderArea = {{0, 0}, {width, height}};
        rendering.layerCount = 1;
        rendering.colorAttachmentCount = 1;
        rendering.pColorAttachments = &color;
        rendering.pDepthAttachment = rendering.pStencilAttachment = &depth;
        vkCmdBeginRendering(commands_, &rendering);
    }

    void draw(VkPipeline pipeline) const {
        vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        const VkDeviceSize zero = 0;
        vkCmdBindVertexBuffers(commands_, 0, 1, &vertices_.handle, &zero);
        vkCmdBindIndexBuffer(commands_, indices_.handle, 0, VK_INDEX_TYPE_UINT32);
        for (const Thing& thing : things) {
            const glm::mat4 rows = glm::transpose(thing.model);
            const PushConstants constants{projection * view * thing.model,
                                          {rows[0], rows[1], rows[2]},
                                          glm::vec4(thing.albedo, 1.0F)};
            vkCmdPushConstants(commands_, layout_,
                               VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                               sizeof constants, &constants);
            vkCmdDrawIndexed(commands_, static_cast<std::uint32_t>(indices.size()), 1, 0, 0, 0);
        }
    }

    /// Everything before it, then everything after it: the plainest barrier.
    void move(const Image& image, VkImageAspectFlags aspects, VkImageLayout from,
              VkImageLayout to) const {
        auto barrier = make<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
        barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
        barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
        barrier.oldLayout = from;
        barrier.newLayout = to;
        barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.image = image.handle;
        barrier.subresourceRange = {aspects, 0, 1, 0, 1};
        vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                             VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, 1,
                             &barrier);
    }

    void copy(const Image& image, VkImageAspectFlags aspect, const Buffer& to) const {
        VkBufferImageCopy region{};
        region.imageSubresource = {aspect, 0, 0, 1};
        region.imageExtent = {width, height, 1};
        vkCmdCopyImageToBuffer(commands_, image.handle, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                               to.handle, 1, &region);
    }

    std::vector<std::function<void()>> frees_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    Image color_, depth_;
    Buffer vertices_, indices_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline ambient_ = VK_NULL_HANDLE, lamp_ = VK_NULL_HANDLE;
};

// ---- The guest: all that the host does for its shadows.

Status draw_a_frame(Host& host) {
    // Once: the device, the pass, the conventions, the mesh.
    auto adopted =
        vk::adopt_device({.get_instance_proc_addr = reinterpret_cast<void*>(&vkGetInstanceProcAddr),
                          .instance = host.instance,
                          .physical_device = host.physical_device,
                          .device = host.device,
                          .queue = host.queue,
                          .queue_family = host.queue_family,
                          .enabled_features = {"depthClamp", "dynamicRendering"}});
    if (!adopted) return forward_error(adopted);
    gpu::Device device(std::move(adopted->backend));
    const auto target = device.import_texture({.label = "depth",
                                               .width = width,
                                               .height = height,
                                               .format = gpu::Format::Depth32FloatStencil8,
                                               .usage = gpu::TextureUsage::RenderAttachment},
                                              vk::HostRenderPass{.color_formats = {color_format}});
    if (!target) return forward_error(target);
    const shadows::HostConventions conventions{shadows::HostDepth::ZeroToOne, false};
    auto pass = shadow_pass::GuestPass::create(device, {.target = *target,
                                                        .size = {width, height},
                                                        .format = gpu::Format::Depth32FloatStencil8,
                                                        .conventions = conventions});
    if (!pass) return forward_error(pass);
    auto system = shadows::ShadowSystem::create();
    if (!system) return forward_error(system);
    const auto mesh = shadows::ShadowMesh::build(
        {.positions = reinterpret_cast<const std::byte*>(host.positions.data()),
         .vertex_count = host.positions.size(),
         .indices = host.indices});
    if (!mesh) return forward_error(mesh);

    // Each frame: what casts and what shines; then the volumes, in the midst of the host's pass.
    const auto view = shadows::view_of_host(host.view, host.projection, conventions);
    if (!view) return forward_error(view);
    auto frame = system->begin_frame();
    for (const Thing& thing : host.things) {
        frame.caster({.key = thing.id, .mesh = *mesh, .world_from_local = glm::dmat4(thing.model)});
    }
    frame.light({.key = 1, .position_world = {2.0, 4.0, 2.5, 1.0}});
    const shadows::DrawList& list = std::move(frame).finish(view->view);
    if (const Status prepared = pass->prepare(list, *view); !prepared) return prepared;

    adopted->commands->command_buffer = host.begin();
    host.draw_depth_and_ambient_light();
    if (const Status counted = pass->count(0); !counted) return counted;
    adopted->commands->command_buffer = nullptr;  // no more goes into it
    host.add_lamp();
    host.end("guest_in_vulkan.ppm");
    return {};
}

}  // namespace

int main() {
    try {
        Host host;
        const Status status = draw_a_frame(host);
        if (!status) std::fprintf(stderr, "%s\n", status.error().message.c_str());
        return status ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
