// SPDX-License-Identifier: MIT
//
// A device that a host made: adopted, drawn on and left alone. Handles are raw values, so that no
// Vulkan header is needed here; dispatchable ones are pointers, others 64-bit numbers.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/backend.hpp>

namespace gnomon::vk {

/// All of it stays the host's and outlives the backend.
struct HostDevice {
    void* get_instance_proc_addr = nullptr;  ///< PFN_vkGetInstanceProcAddr
    void* instance = nullptr;                ///< VkInstance, made with apiVersion 1.1 or later
    void* physical_device = nullptr;         ///< VkPhysicalDevice
    void* device = nullptr;                  ///< VkDevice
    /// VkQueue of `queue_family`, which has graphics. Nobody else submits to it while gnomon is
    /// called.
    void* queue = nullptr;
    std::uint32_t queue_family = 0;
    /// What the device was made with of VkPhysicalDeviceFeatures, by its names; of use are
    /// "depthClamp" (needed for cameras with a far plane), "depthBounds", "depthBiasClamp",
    /// "independentBlend", "occlusionQueryPrecise" and "sampleRateShading" (needed for four
    /// samples).
    std::vector<std::string> enabled_features = {};
};

/// Where what is submitted to an adopted device goes.
struct HostCommands {
    /// A VkCommandBuffer of the host's, being recorded, outside of a render pass: commands are
    /// recorded into it, barriers included, and what is bound there is anybody's guess afterwards.
    /// The host submits it to HostDevice::queue, once, before it calls gnomon for the next frame or
    /// frees anything of gnomon's. Uploads are submitted by gnomon before. Null: all is submitted
    /// to the queue at once, in order.
    void* command_buffer = nullptr;
};

struct AdoptedDevice {
    std::unique_ptr<gpu::Backend> backend;
    std::shared_ptr<HostCommands> commands;  ///< the host may change it between two calls
};

/// Fails with ErrorCode::InvalidInput for a handle that is null, and with Unsupported, naming what
/// is missing, as create_backend() does.
[[nodiscard]] Result<AdoptedDevice> adopt_device(const HostDevice& host);

/// What Device::import_texture() takes: an image with one layer, of VkImageUsage
/// DEPTH_STENCIL_ATTACHMENT, made with the format, size and samples of the TextureDesc (usage
/// RenderAttachment alone).
struct HostImage {
    std::uint64_t image = 0;  ///< VkImage
    /// VkImageLayout that the image is in whenever it is drawn to, and in again afterwards. All of
    /// the host's writes to it that came before on the queue are waited for, and what comes after
    /// sees gnomon's.
    std::uint32_t layout = 0;
};

}  // namespace gnomon::vk
