// SPDX-License-Identifier: MIT
//
// A host with a renderer of its own, in plain Vulkan: its instance, device, queue, depth-stencil
// image, render pass and pipeline. It draws depth, lends the image out and reads its stencil back.
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/shadows/host_view.hpp>
#include <gnomon/vk/host_device.hpp>

#include "tests/rows/rows.hpp"

namespace gnomon::test {

// clang-format off
#define GNOMON_HOST_INSTANCE_FUNCTIONS(X)                                                          \
    X(DestroyInstance) X(EnumeratePhysicalDevices) X(GetPhysicalDeviceProperties)                   \
    X(GetPhysicalDeviceMemoryProperties) X(GetPhysicalDeviceQueueFamilyProperties)                  \
    X(GetPhysicalDeviceFormatProperties) X(GetPhysicalDeviceFeatures) X(CreateDevice)               \
    X(GetDeviceProcAddr) X(CreateDebugUtilsMessengerEXT) X(DestroyDebugUtilsMessengerEXT)
#define GNOMON_HOST_DEVICE_FUNCTIONS(X)                                                            \
    X(DestroyDevice) X(GetDeviceQueue) X(CreateCommandPool) X(DestroyCommandPool)                   \
    X(AllocateCommandBuffers) X(FreeCommandBuffers) X(BeginCommandBuffer) X(EndCommandBuffer)       \
    X(QueueSubmit) X(QueueWaitIdle) X(CreateImage) X(DestroyImage) X(GetImageMemoryRequirements)    \
    X(AllocateMemory) X(FreeMemory) X(BindImageMemory) X(CreateImageView) X(DestroyImageView)       \
    X(CreateRenderPass) X(DestroyRenderPass) X(CreateFramebuffer) X(DestroyFramebuffer)             \
    X(CreateShaderModule) X(DestroyShaderModule) X(CreatePipelineLayout) X(DestroyPipelineLayout)   \
    X(CreateGraphicsPipelines) X(DestroyPipeline) X(CreateBuffer) X(DestroyBuffer)                  \
    X(GetBufferMemoryRequirements) X(BindBufferMemory) X(MapMemory) X(UnmapMemory)                  \
    X(CmdBeginRenderPass) X(CmdEndRenderPass) X(CmdBindPipeline) X(CmdBindVertexBuffers)            \
    X(CmdBindIndexBuffer) X(CmdPushConstants) X(CmdDrawIndexed) X(CmdPipelineBarrier)               \
    X(CmdCopyImageToBuffer)
// clang-format on

struct VkHostWay {
    std::string name;
    bool reversed = true;
    bool finite = false;
    bool record_into_its_commands = false;
    /// In which its image waits between passes.
    VkImageLayout layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
};

class VkHost {
public:
    /// Fails where there is no Vulkan, no validation layer or no fitting device.
    [[nodiscard]] static Result<std::unique_ptr<VkHost>> create(const VkHostWay& way);
    ~VkHost();
    VkHost(const VkHost&) = delete;
    VkHost& operator=(const VkHost&) = delete;

    [[nodiscard]] vk::HostDevice device() const;
    [[nodiscard]] vk::HostImage image() const;
    [[nodiscard]] shadows::HostConventions conventions() const;

    struct Camera {
        glm::mat4 view_from_world{1.0F};
        glm::mat4 clip_from_view{1.0F};
    };
    [[nodiscard]] Camera camera_of(const Setting& setting) const;

    /// Clears and draws the scene's depth, with a stencil of 0x55, and submits that.
    void draw(const Setting& setting);
    /// Begins a command buffer, or ends it, submits it and waits.
    VkCommandBuffer begin();
    void end();
    /// One byte a pixel, row 0 on top.
    [[nodiscard]] std::vector<std::uint8_t> stencil();

    /// What the validation layer said.
    std::vector<std::string> messages;

private:
    explicit VkHost(VkHostWay way) : way_(std::move(way)) {}
    Status make_instance();
    Status choose_device();
    void make_device();
    void make_image();
    void make_render_pass();
    void make_pipeline();
    struct Buffer {
        VkBuffer handle = VK_NULL_HANDLE;
        VkDeviceMemory memory = VK_NULL_HANDLE;
    };
    Buffer make_buffer(const void* data, VkDeviceSize size, VkBufferUsageFlags usage);
    void free_buffer(const Buffer& buffer);
    std::uint32_t memory_type(std::uint32_t allowed, VkMemoryPropertyFlags wanted) const;
    void move_image(VkImageLayout from, VkImageLayout to);

    VkHostWay way_;
    PFN_vkGetInstanceProcAddr get_instance_proc_addr_ = nullptr;
#define GNOMON_HOST_MEMBER(name) PFN_vk##name name = nullptr;
    GNOMON_HOST_INSTANCE_FUNCTIONS(GNOMON_HOST_MEMBER)
    GNOMON_HOST_DEVICE_FUNCTIONS(GNOMON_HOST_MEMBER)
#undef GNOMON_HOST_MEMBER
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    std::uint32_t family_ = 0;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkImage image_ = VK_NULL_HANDLE;
    VkDeviceMemory image_memory_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
    VkRenderPass render_pass_ = VK_NULL_HANDLE;
    VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

}  // namespace gnomon::test
