// SPDX-License-Identifier: MIT
//
// A host with a renderer of its own, in plain Vulkan: its instance, device, queue, depth-stencil
// image, render pass and pipeline. It draws depth, lends the image out, or its render pass, and
// reads what came of it back.
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <functional>
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
// The last two are null before Vulkan 1.3.
#define GNOMON_HOST_DEVICE_FUNCTIONS(X)                                                            \
    X(DestroyDevice) X(GetDeviceQueue) X(CreateCommandPool) X(DestroyCommandPool)                   \
    X(AllocateCommandBuffers) X(FreeCommandBuffers) X(BeginCommandBuffer) X(EndCommandBuffer)       \
    X(QueueSubmit) X(QueueWaitIdle) X(CreateImage) X(DestroyImage) X(GetImageMemoryRequirements)    \
    X(AllocateMemory) X(FreeMemory) X(BindImageMemory) X(CreateImageView) X(DestroyImageView)       \
    X(CreateRenderPass) X(DestroyRenderPass) X(CreateFramebuffer) X(DestroyFramebuffer)             \
    X(CreateShaderModule) X(DestroyShaderModule) X(CreatePipelineLayout) X(DestroyPipelineLayout)   \
    X(CreateGraphicsPipelines) X(DestroyPipeline) X(CreateBuffer) X(DestroyBuffer)                  \
    X(GetBufferMemoryRequirements) X(BindBufferMemory) X(MapMemory) X(UnmapMemory)                  \
    X(CreateSampler) X(DestroySampler) X(CreateDescriptorSetLayout) X(DestroyDescriptorSetLayout)   \
    X(CreateDescriptorPool) X(DestroyDescriptorPool) X(AllocateDescriptorSets)                      \
    X(UpdateDescriptorSets) X(CmdBindDescriptorSets) X(CmdDraw) X(CmdNextSubpass)                   \
    X(CmdBeginRenderPass) X(CmdEndRenderPass) X(CmdBindPipeline) X(CmdBindVertexBuffers)            \
    X(CmdBindIndexBuffer) X(CmdPushConstants) X(CmdDrawIndexed) X(CmdPipelineBarrier)               \
    X(CmdCopyImageToBuffer) X(CmdBeginRendering) X(CmdEndRendering)
// clang-format on

/// Throws where a call of the host's failed.
void check_vk(VkResult result, const char* call);

template <class Info>
[[nodiscard]] Info vk_info(VkStructureType type) {
    Info info{};
    info.sType = type;
    return info;
}

/// How its render pass is begun, in which gnomon draws.
enum class InPass : std::uint8_t {
    No,       ///< gnomon draws in passes of its own
    Classic,  ///< vkCmdBeginRenderPass()
    Dynamic,  ///< vkCmdBeginRendering()
};

struct VkHostWay {
    std::string name;
    bool reversed = true;
    bool finite = false;
    bool record_into_its_commands = false;
    /// In which its image waits between passes.
    VkImageLayout layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    /// With a colour attachment beside the depth then, and with Classic in a second subpass.
    InPass in_pass = InPass::No;
    std::uint32_t samples = 1;
    bool sample_shading = true;  ///< with four samples: its device has sampleRateShading
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
    [[nodiscard]] vk::HostRenderPass render_pass() const;
    [[nodiscard]] shadows::HostConventions conventions() const;

    struct Camera {
        glm::mat4 view_from_world{1.0F};
        glm::mat4 clip_from_view{1.0F};
    };
    [[nodiscard]] Camera camera_of(const Setting& setting) const;

    /// Clears and draws the scene's depth, with a stencil of 0x55, and submits that. What
    /// `in_pass` records follows in the pass.
    void draw(const Setting& setting,
              const std::function<void(VkCommandBuffer commands)>& in_pass = {});
    /// Begins a command buffer, or ends it, submits it and, where it `waits`, does.
    VkCommandBuffer begin();
    void end();
    /// Until the queue has done all.
    void wait();
    bool waits = true;
    /// One byte a pixel, row 0 on top.
    [[nodiscard]] std::vector<std::uint8_t> stencil();
    /// The same of one of four samples.
    [[nodiscard]] std::vector<std::uint8_t> stencil_sample(std::uint32_t sample);

    /// An image for light masks, VK_FORMAT_R32_UINT or VK_FORMAT_R8_UNORM, which is to wait in
    /// SHADER_READ_ONLY_OPTIMAL and is in UNDEFINED as yet. Numbers count from 0.
    std::size_t make_mask(VkFormat format, std::uint32_t samples = 1);
    [[nodiscard]] vk::HostImage mask(std::size_t number) const;
    /// Its texels, of one sample where there are four.
    [[nodiscard]] std::vector<std::uint32_t> read_bits(std::size_t number,
                                                       std::uint32_t sample = 0);
    [[nodiscard]] std::vector<std::uint8_t> read_bytes(std::size_t number);

    /// How often gnomon has called these since the last host was made.
    [[nodiscard]] static std::size_t submissions();
    [[nodiscard]] static std::size_t pipelines();

    /// What the validation layer said.
    std::vector<std::string> messages;

private:
    struct Image {
        VkImage handle = VK_NULL_HANDLE;
        VkImageView view = VK_NULL_HANDLE;
        VkImageView stencil_view = VK_NULL_HANDLE;
        VkImageAspectFlags aspects = 0;
        std::uint32_t samples = 1;
    };
    struct Buffer {
        VkBuffer handle = VK_NULL_HANDLE;
        VkDeviceMemory memory = VK_NULL_HANDLE;
    };
    /// What samples are fetched with, made when the first is.
    struct Fetching {
        Image target;
        VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
        VkDescriptorSet set = VK_NULL_HANDLE;
        VkSampler sampler = VK_NULL_HANDLE;
        VkRenderPass render_pass = VK_NULL_HANDLE;
        VkFramebuffer framebuffer = VK_NULL_HANDLE;
        VkPipelineLayout layout = VK_NULL_HANDLE;
        VkPipeline pipeline = VK_NULL_HANDLE;
    };

    explicit VkHost(VkHostWay way) : way_(std::move(way)) {}

    // vk_host.cpp
    Status make_instance();
    Status choose_device();
    void make_device();
    Image make_image(VkFormat format, VkImageUsageFlags usage, std::uint32_t samples);
    VkImageView make_view(VkImage image, VkFormat format, VkImageAspectFlags aspects);
    Buffer make_buffer(const void* data, VkDeviceSize size, VkBufferUsageFlags usage);
    void free_buffer(const Buffer& buffer);
    std::uint32_t memory_type(std::uint32_t allowed, VkMemoryPropertyFlags wanted) const;
    void at_the_end(std::function<void()> free) { frees_.push_back(std::move(free)); }

    // vk_host_drawing.cpp
    void make_render_pass();
    void make_pipeline();
    void begin_pass();
    void end_pass();

    // vk_host_reading.cpp
    void move_image(const Image& image, VkImageLayout from, VkImageLayout to);
    std::vector<std::byte> read(const Image& image, VkImageAspectFlags aspect, VkImageLayout layout,
                                std::size_t texel_bytes);
    std::vector<std::uint32_t> fetch_sample(const Image& image, VkImageView view,
                                            VkImageLayout layout, std::uint32_t sample);
    void make_fetching();
    void make_fetching_pass();
    void make_fetching_pipeline();

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
    std::vector<VkCommandBuffer> submitted_;  // not waited for as yet
    std::vector<Buffer> read_by_submitted_;
    Image depth_, color_;
    std::vector<Image> masks_;
    VkRenderPass render_pass_ = VK_NULL_HANDLE;
    VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    Fetching fetching_;
    std::vector<std::function<void()>> frees_;  // last first
};

}  // namespace gnomon::test
