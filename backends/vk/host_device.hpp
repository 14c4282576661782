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

#pragma GCC visibility push(default)
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
    std::uint32_t queue_family = 0;  ///< of `queue`
    /// What the device was made with of VkPhysicalDeviceFeatures, by its names; of use are
    /// "depthClamp" (needed for cameras with a far plane), "depthBounds", "depthBiasClamp",
    /// "independentBlend", "occlusionQueryPrecise" and "sampleRateShading" (needed for light masks
    /// with bits of four samples, which are packed sample by sample, and for nothing else); and
    /// "dynamicRendering", of Vulkan 1.3 or VK_KHR_dynamic_rendering, where a
    /// HostRenderPass is begun by it.
    std::vector<std::string> enabled_features = {};
};

/// A VkCommandBuffer of the host's, or null: assign it. Counts how often that was done, since a
/// handle comes again when something else is recorded.
class HostCommandBuffer {
public:
    /// Null, or one that is being recorded.
    HostCommandBuffer& operator=(void* handle) {
        handle_ = handle;
        ++times_set_;
        return *this;
    }
    operator void*() const { return handle_; }                            ///< as Vulkan has it
    [[nodiscard]] std::uint64_t times_set() const { return times_set_; }  ///< so far

private:
    void* handle_ = nullptr;
    std::uint64_t times_set_ = 0;
};

/// Where what is submitted to an adopted device goes.
struct HostCommands {
    /// One that is being recorded: commands are recorded into it, and what is bound there, dynamic
    /// state included, is anybody's guess afterwards. It is outside of a render pass, since
    /// barriers are recorded as well; only what is drawn into a HostRenderPass is recorded within
    /// that one. The host submits it to HostDevice::queue, once, before it calls gnomon for the
    /// next frame or frees anything of gnomon's. Uploads are submitted by gnomon before, and within
    /// a render pass the barriers that wait for them, too. Null: all is submitted to the queue at
    /// once, in order.
    ///
    /// After the last count() or resolve() that goes into it, it is set to null or to the next,
    /// which says that no more does; until then what gnomon frees waits.
    ///
    /// Since uploads run before all of it, what a prepare() writes is the same for the whole
    /// buffer: one pass (GuestPass, LightMasks) a view, or a submission between two views. A
    /// prepare() that would change what the buffer reads already fails with
    /// ErrorCode::InvalidInput; not if this was set since, which cannot be told from another frame.
    HostCommandBuffer command_buffer = {};
};

/// What adopt_device() gives.
struct AdoptedDevice {
    std::unique_ptr<gpu::Backend> backend;   ///< for a gpu::Device
    std::shared_ptr<HostCommands> commands;  ///< the host may change it between two calls
};

/// Fails with ErrorCode::InvalidInput for a handle that is null, and with Unsupported, naming what
/// is missing, as create_backend() does.
[[nodiscard]] Result<AdoptedDevice> adopt_device(const HostDevice& host);

/// What Device::import_texture() takes: an image with one layer, of VkImageUsage
/// DEPTH_STENCIL_ATTACHMENT, or COLOR_ATTACHMENT for light masks, made with the format, size and
/// samples of the TextureDesc (usage RenderAttachment alone), none of which can be checked here.
struct HostImage {
    std::uint64_t image = 0;  ///< VkImage
    /// VkImageLayout that the image is in whenever it is drawn to, and in again afterwards. All of
    /// the host's accesses to it that came before on the queue are waited for, and what comes after
    /// sees gnomon's. A light mask is written whole, so before the first time it may be in
    /// UNDEFINED all the same.
    std::uint32_t layout = 0;
};

/// What Device::import_texture() takes in place of a HostImage: the depth and stencil of a render
/// pass that the host begins, draws its scene in, and lends for shadows before it goes on. What is
/// drawn into the texture is recorded at HostCommands::command_buffer, which is within that pass
/// then, as draws and a clear and nothing else. Pipelines are made for it with the GuestPass, so
/// the import comes first. The TextureDesc has the size of the render area, which begins at (0, 0),
/// the format and the samples of the depth-stencil attachment.
///
/// Pipelines are made once for all imports with equal render_pass, subpass, color_formats, format
/// and samples, while one of them is alive. Handles are compared: free the texture before the
/// VkRenderPass is destroyed.
///
/// The pass has a stencil that may be written and one view (no multiview). Between the host's
/// draws, the clear and the counting nothing has to be waited for: they are ordered by the pass.
struct HostRenderPass {
    /// VkRenderPass that is begun, or one compatible with it, alive for as long as the import; 0:
    /// vkCmdBeginRendering().
    std::uint64_t render_pass = 0;
    std::uint32_t subpass = 0;  ///< of `render_pass`
    /// VkFormat of each colour attachment, in order, VK_FORMAT_UNDEFINED for one that is not used.
    /// None is written. With a VkRenderPass only their number is looked at.
    std::vector<std::uint32_t> color_formats = {};
};

}  // namespace gnomon::vk
#pragma GCC visibility pop
