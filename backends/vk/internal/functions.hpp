// SPDX-License-Identifier: MIT
//
// The Vulkan functions this backend calls, loaded at run time into plain tables. Volk is not used:
// it defines global symbols named like the functions of libvulkan, which breaks a host that links
// libvulkan, or volk, itself. The tables belong to one instance and one device each, so that
// several backends can live side by side.
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan.h>

namespace gnomon::vk {

#define GNOMON_VK_GLOBAL_FUNCTIONS(X)   \
    X(CreateInstance)                   \
    X(EnumerateInstanceLayerProperties) \
    X(EnumerateInstanceExtensionProperties)

#define GNOMON_VK_INSTANCE_FUNCTIONS(X)       \
    X(DestroyInstance)                        \
    X(EnumeratePhysicalDevices)               \
    X(GetPhysicalDeviceProperties)            \
    X(GetPhysicalDeviceProperties2)           \
    X(GetPhysicalDeviceFeatures)              \
    X(GetPhysicalDeviceFormatProperties)      \
    X(GetPhysicalDeviceImageFormatProperties) \
    X(GetPhysicalDeviceMemoryProperties)      \
    X(GetPhysicalDeviceQueueFamilyProperties) \
    X(EnumerateDeviceExtensionProperties)     \
    X(CreateDevice)                           \
    X(GetDeviceProcAddr)

// Null where the extension is not enabled.
#define GNOMON_VK_INSTANCE_EXTENSION_FUNCTIONS(X) \
    X(CreateDebugUtilsMessengerEXT)               \
    X(DestroyDebugUtilsMessengerEXT)              \
    X(SetDebugUtilsObjectNameEXT)                 \
    X(CmdBeginDebugUtilsLabelEXT)                 \
    X(CmdEndDebugUtilsLabelEXT)                   \
    X(DestroySurfaceKHR)                          \
    X(GetPhysicalDeviceSurfaceSupportKHR)         \
    X(GetPhysicalDeviceSurfaceCapabilitiesKHR)    \
    X(GetPhysicalDeviceSurfaceFormatsKHR)

#define GNOMON_VK_DEVICE_FUNCTIONS(X) \
    X(AllocateCommandBuffers)         \
    X(AllocateDescriptorSets)         \
    X(AllocateMemory)                 \
    X(BeginCommandBuffer)             \
    X(BindBufferMemory)               \
    X(BindImageMemory)                \
    X(CmdBeginQuery)                  \
    X(CmdBeginRenderPass)             \
    X(CmdBindDescriptorSets)          \
    X(CmdBindIndexBuffer)             \
    X(CmdBindPipeline)                \
    X(CmdBindVertexBuffers)           \
    X(CmdBlitImage)                   \
    X(CmdClearAttachments)            \
    X(CmdClearColorImage)             \
    X(CmdClearDepthStencilImage)      \
    X(CmdCopyBuffer)                  \
    X(CmdCopyBufferToImage)           \
    X(CmdCopyImageToBuffer)           \
    X(CmdDraw)                        \
    X(CmdDrawIndexed)                 \
    X(CmdEndQuery)                    \
    X(CmdEndRenderPass)               \
    X(CmdFillBuffer)                  \
    X(CmdPipelineBarrier)             \
    X(CmdResetQueryPool)              \
    X(CmdSetBlendConstants)           \
    X(CmdSetDepthBounds)              \
    X(CmdSetScissor)                  \
    X(CmdSetStencilReference)         \
    X(CmdSetViewport)                 \
    X(CmdWriteTimestamp)              \
    X(CreateBuffer)                   \
    X(CreateCommandPool)              \
    X(CreateDescriptorPool)           \
    X(CreateDescriptorSetLayout)      \
    X(CreateFence)                    \
    X(CreateFramebuffer)              \
    X(CreateGraphicsPipelines)        \
    X(CreateImage)                    \
    X(CreateImageView)                \
    X(CreatePipelineCache)            \
    X(CreatePipelineLayout)           \
    X(CreateQueryPool)                \
    X(CreateRenderPass)               \
    X(CreateSampler)                  \
    X(CreateSemaphore)                \
    X(CreateShaderModule)             \
    X(DestroyBuffer)                  \
    X(DestroyCommandPool)             \
    X(DestroyDescriptorPool)          \
    X(DestroyDescriptorSetLayout)     \
    X(DestroyDevice)                  \
    X(DestroyFence)                   \
    X(DestroyFramebuffer)             \
    X(DestroyImage)                   \
    X(DestroyImageView)               \
    X(DestroyPipeline)                \
    X(DestroyPipelineCache)           \
    X(DestroyPipelineLayout)          \
    X(DestroyQueryPool)               \
    X(DestroyRenderPass)              \
    X(DestroySampler)                 \
    X(DestroySemaphore)               \
    X(DestroyShaderModule)            \
    X(DeviceWaitIdle)                 \
    X(EndCommandBuffer)               \
    X(FreeDescriptorSets)             \
    X(FreeMemory)                     \
    X(GetBufferMemoryRequirements)    \
    X(GetDeviceQueue)                 \
    X(GetFenceStatus)                 \
    X(GetImageMemoryRequirements)     \
    X(GetQueryPoolResults)            \
    X(MapMemory)                      \
    X(QueueSubmit)                    \
    X(QueueWaitIdle)                  \
    X(ResetFences)                    \
    X(UpdateDescriptorSets)           \
    X(WaitForFences)

// Null without VK_KHR_swapchain.
#define GNOMON_VK_SWAPCHAIN_FUNCTIONS(X) \
    X(AcquireNextImageKHR)               \
    X(CreateSwapchainKHR)                \
    X(DestroySwapchainKHR)               \
    X(GetSwapchainImagesKHR)             \
    X(QueuePresentKHR)

#define GNOMON_VK_DECLARE(name) PFN_vk##name name = nullptr;

struct GlobalFunctions {
    PFN_vkGetInstanceProcAddr GetInstanceProcAddr = nullptr;
    PFN_vkEnumerateInstanceVersion EnumerateInstanceVersion = nullptr;  ///< null: Vulkan 1.0
    GNOMON_VK_GLOBAL_FUNCTIONS(GNOMON_VK_DECLARE)
};

struct InstanceFunctions {
    GNOMON_VK_INSTANCE_FUNCTIONS(GNOMON_VK_DECLARE)
    GNOMON_VK_INSTANCE_EXTENSION_FUNCTIONS(GNOMON_VK_DECLARE)
};

struct DeviceFunctions {
    GNOMON_VK_DEVICE_FUNCTIONS(GNOMON_VK_DECLARE)
    GNOMON_VK_SWAPCHAIN_FUNCTIONS(GNOMON_VK_DECLARE)
};

#undef GNOMON_VK_DECLARE

/// Opens the Vulkan loader on first use and keeps it open: drivers do not survive being unloaded
/// while their threads run. Null when there is no loader on this machine. Thread-safe.
[[nodiscard]] const GlobalFunctions* load_global_functions();
[[nodiscard]] InstanceFunctions load_instance_functions(const GlobalFunctions& global,
                                                        VkInstance instance);
[[nodiscard]] DeviceFunctions load_device_functions(const InstanceFunctions& instance_functions,
                                                    VkDevice device);

}  // namespace gnomon::vk
