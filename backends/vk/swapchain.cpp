// SPDX-License-Identifier: MIT
//
// Makes and remakes the swapchain, and presents.
#include "internal/swapchain.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "internal/conv.hpp"
#include "internal/error.hpp"

namespace gnomon::vk {

namespace {

constexpr const char* subject = "the window";

/// A window that is resized all the time may outrun this many swapchains; the next frame tries
/// again.
constexpr int max_attempts = 4;

bool is_lost(VkResult result) { return result == VK_ERROR_OUT_OF_DATE_KHR; }

}  // namespace

Swapchain::~Swapchain() {
    device_.fn.DeviceWaitIdle(device_.handle);
    destroy_images();
    destroy_swapchain();
}

void Swapchain::destroy_swapchain() {
    if (handle_ != VK_NULL_HANDLE) {
        device_.fn.DestroySwapchainKHR(device_.handle, handle_, nullptr);
    }
    handle_ = VK_NULL_HANDLE;
    stale_ = true;
}

tl::unexpected<Error> Swapchain::failed(VkResult result, const char* call) {
    surface_lost_ = surface_lost_ || result == VK_ERROR_SURFACE_LOST_KHR;
    return failure(result, call, subject);
}

Status Swapchain::renew_surface() {
    if (const Status finished = queue_.finish(); !finished) {
        return finished;
    }
    if (const VkResult result = device_.fn.DeviceWaitIdle(device_.handle); result != VK_SUCCESS) {
        return failure(result, "vkDeviceWaitIdle", subject);
    }
    destroy_images();
    destroy_swapchain();
    Instance& instance = *device_.instance;
    if (instance.surface != VK_NULL_HANDLE) {
        instance.fn.DestroySurfaceKHR(instance.handle, instance.surface, nullptr);
    }
    instance.surface = reinterpret_cast<VkSurfaceKHR>(window_.create_surface(instance.handle));
    if (instance.surface == VK_NULL_HANDLE) {
        return fail(ErrorCode::DeviceLost,
                    "The window's Vulkan surface was lost, and the window gave no other one: "
                    "Window::create_surface returned 0.");
    }
    VkBool32 presents = VK_FALSE;
    const VkResult result = instance.fn.GetPhysicalDeviceSurfaceSupportKHR(
        device_.adapter.handle, device_.adapter.queue_family, instance.surface, &presents);
    if (result != VK_SUCCESS) {
        return failure(result, "vkGetPhysicalDeviceSurfaceSupportKHR", subject);
    }
    if (presents == VK_FALSE) {
        return fail(ErrorCode::DeviceLost,
                    "The window's Vulkan surface was lost, and the device cannot present to the "
                    "other one that the window gave.");
    }
    surface_lost_ = false;
    return {};
}

void Swapchain::destroy_images() {
    for (const Image& image : images_) {
        device_.fn.DestroySemaphore(device_.handle, image.drawn, nullptr);
    }
    for (VkSemaphore semaphore : acquired_) {
        device_.fn.DestroySemaphore(device_.handle, semaphore, nullptr);
    }
    images_.clear();
    acquired_.clear();
}

Result<VkSemaphore> Swapchain::make_semaphore() const {
    VkSemaphoreCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    VkSemaphore semaphore = VK_NULL_HANDLE;
    if (const VkResult result =
            device_.fn.CreateSemaphore(device_.handle, &info, nullptr, &semaphore);
        result != VK_SUCCESS) {
        return failure(result, "vkCreateSemaphore", subject);
    }
    return semaphore;
}

Result<VkSurfaceFormatKHR> Swapchain::choose_format(bool srgb) {
    const auto get_formats = device_.instance->fn.GetPhysicalDeviceSurfaceFormatsKHR;
    std::uint32_t count = 0;
    VkResult result =
        get_formats(device_.adapter.handle, device_.instance->surface, &count, nullptr);
    std::vector<VkSurfaceFormatKHR> formats(count);
    if (result == VK_SUCCESS) {
        result =
            get_formats(device_.adapter.handle, device_.instance->surface, &count, formats.data());
    }
    if (result < VK_SUCCESS) {
        return failed(result, "vkGetPhysicalDeviceSurfaceFormatsKHR");
    }
    // A blit converts between linear and sRGB where the two formats differ in that, and the bytes
    // are to arrive as they are: an sRGB texture takes an sRGB swapchain, any other one that is
    // not.
    const std::array<VkFormat, 2> wanted =
        srgb ? std::array{VK_FORMAT_B8G8R8A8_SRGB, VK_FORMAT_R8G8B8A8_SRGB}
             : std::array{VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM};
    for (const VkFormat format : wanted) {
        for (const VkSurfaceFormatKHR& offered : formats) {
            if (offered.format == format &&
                offered.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) {
                return offered;
            }
        }
    }
    return fail(ErrorCode::Unsupported,
                srgb ? "The window's surface has no 8-bit sRGB format, which presenting an sRGB "
                       "texture needs."
                     : "The window's surface has neither B8G8R8A8_UNORM nor R8G8B8A8_UNORM.");
}

Result<bool> Swapchain::prepare(bool srgb) {
    const Extent size = window_.framebuffer_size();
    if (size.width == 0 || size.height == 0) {
        return false;
    }
    if (!stale_ && srgb == srgb_ && extent_.width == size.width && extent_.height == size.height) {
        return true;
    }
    VkSurfaceCapabilitiesKHR capabilities{};
    if (const VkResult result = device_.instance->fn.GetPhysicalDeviceSurfaceCapabilitiesKHR(
            device_.adapter.handle, device_.instance->surface, &capabilities);
        result != VK_SUCCESS) {
        return failed(result, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    }
    VkExtent2D extent = capabilities.currentExtent;
    if (extent.width == std::numeric_limits<std::uint32_t>::max()) {
        extent.width = std::clamp(size.width, capabilities.minImageExtent.width,
                                  capabilities.maxImageExtent.width);
        extent.height = std::clamp(size.height, capabilities.minImageExtent.height,
                                   capabilities.maxImageExtent.height);
    }
    if (extent.width == 0 || extent.height == 0) {
        return false;
    }
    const bool same_extent = extent.width == extent_.width && extent.height == extent_.height;
    if (!stale_ && srgb == srgb_ && same_extent) {
        return true;  // the window library is ahead of the surface, or behind it
    }
    if (const Status made = recreate(capabilities, extent, srgb); !made) {
        return forward_error(made);
    }
    return true;
}

Status Swapchain::recreate(const VkSurfaceCapabilitiesKHR& capabilities, VkExtent2D extent,
                           bool srgb) {
    const Result<VkSurfaceFormatKHR> format = choose_format(srgb);
    if (!format) {
        return forward_error(format);
    }
    if ((capabilities.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT) == 0) {
        return fail(ErrorCode::Unsupported, "The window's surface cannot be copied to.");
    }
    if (const Status finished = queue_.finish(); !finished) {
        return finished;
    }
    // Fences do not cover what the presentation engine still does with the semaphores.
    if (const VkResult result = device_.fn.DeviceWaitIdle(device_.handle); result != VK_SUCCESS) {
        return failure(result, "vkDeviceWaitIdle", subject);
    }
    destroy_images();

    std::uint32_t image_count = capabilities.minImageCount + 1;
    if (capabilities.maxImageCount != 0) {
        image_count = std::min(image_count, capabilities.maxImageCount);
    }
    const bool opaque =
        (capabilities.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0;
    VkSwapchainCreateInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
    info.surface = device_.instance->surface;
    info.minImageCount = image_count;
    info.imageFormat = format->format;
    info.imageColorSpace = format->colorSpace;
    info.imageExtent = extent;
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.preTransform = capabilities.currentTransform;
    info.compositeAlpha =
        opaque ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
    info.clipped = VK_TRUE;
    info.oldSwapchain = handle_;
    VkSwapchainKHR fresh = VK_NULL_HANDLE;
    const VkResult result = device_.fn.CreateSwapchainKHR(device_.handle, &info, nullptr, &fresh);
    destroy_swapchain();
    if (result != VK_SUCCESS) {
        return failed(result, "vkCreateSwapchainKHR");
    }
    handle_ = fresh;
    format_ = format->format;
    extent_ = extent;
    srgb_ = srgb;
    if (const Status taken = take_images(); !taken) {
        return taken;
    }
    stale_ = false;
    return {};
}

Status Swapchain::take_images() {
    std::uint32_t count = 0;
    VkResult result = device_.fn.GetSwapchainImagesKHR(device_.handle, handle_, &count, nullptr);
    std::vector<VkImage> handles(count);
    if (result == VK_SUCCESS) {
        result = device_.fn.GetSwapchainImagesKHR(device_.handle, handle_, &count, handles.data());
    }
    if (result != VK_SUCCESS) {
        return failure(result, "vkGetSwapchainImagesKHR", subject);
    }
    for (VkImage handle : handles) {
        const Result<VkSemaphore> drawn = make_semaphore();
        if (!drawn) {
            return forward_error(drawn);
        }
        images_.push_back({handle, *drawn, {}});
    }
    for (std::size_t i = 0; i < handles.size() + 1; ++i) {
        const Result<VkSemaphore> acquired = make_semaphore();
        if (!acquired) {
            return forward_error(acquired);
        }
        acquired_.push_back(*acquired);
    }
    turn_ = 0;
    return {};
}

Status Swapchain::blit(Texture& texture, Image& image) {
    const Result<VkCommandBuffer> commands = queue_.commands();
    if (!commands) {
        return forward_error(commands);
    }
    define_contents(device_, *commands, texture);
    image.tracker.acquired(VK_PIPELINE_STAGE_TRANSFER_BIT);
    BarrierBatch barriers;
    Dependency dependency;
    use_texture(texture, Usage::CopySource, barriers);
    if (image.tracker.use_image(Usage::CopyDestination, VK_IMAGE_ASPECT_COLOR_BIT, dependency)) {
        barriers.add_image(dependency, image.handle, VK_IMAGE_ASPECT_COLOR_BIT);
    }
    barriers.flush(device_.fn, *commands);

    const auto corner = [](std::uint32_t width, std::uint32_t height) {
        return VkOffset3D{static_cast<std::int32_t>(width), static_cast<std::int32_t>(height), 1};
    };
    VkImageBlit region{};
    region.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.srcOffsets[1] = corner(texture.width, texture.height);
    region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.dstOffsets[1] = corner(extent_.width, extent_.height);
    VkFormatProperties properties{};
    device_.instance->fn.GetPhysicalDeviceFormatProperties(device_.adapter.handle,
                                                           to_vk(texture.format), &properties);
    const bool filters =
        (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT) != 0;
    device_.fn.CmdBlitImage(*commands, texture.handle, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                            image.handle, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region,
                            filters ? VK_FILTER_LINEAR : VK_FILTER_NEAREST);

    if (image.tracker.use_image(Usage::PresentSource, VK_IMAGE_ASPECT_COLOR_BIT, dependency)) {
        barriers.add_image(dependency, image.handle, VK_IMAGE_ASPECT_COLOR_BIT);
    }
    barriers.flush(device_.fn, *commands);
    return {};
}

Status Swapchain::present(Texture& texture) {
    if (!surface_lost_) {
        const Status shown = try_to_present(texture);
        if (!surface_lost_) {
            return shown;
        }
    }
    if (const Status renewed = renew_surface(); !renewed) {
        return renewed;
    }
    return try_to_present(texture);
}

Status Swapchain::try_to_present(Texture& texture) {
    std::uint32_t index = 0;
    for (int attempt = 0;; ++attempt) {
        const Result<bool> ready = prepare(texture.format == gpu::Format::Rgba8UnormSrgb);
        if (!ready) {
            return forward_error(ready);
        }
        if (!*ready || attempt == max_attempts) {
            return {};
        }
        const VkResult result = device_.fn.AcquireNextImageKHR(
            device_.handle, handle_, std::numeric_limits<std::uint64_t>::max(), acquired_[turn_],
            VK_NULL_HANDLE, &index);
        if (result == VK_SUCCESS || result == VK_SUBOPTIMAL_KHR) {
            stale_ = result == VK_SUBOPTIMAL_KHR;
            break;
        }
        stale_ = true;
        if (!is_lost(result)) {
            return failed(result, "vkAcquireNextImageKHR");
        }
    }
    Image& image = images_[index];
    const VkSemaphore acquired = acquired_[turn_];
    turn_ = (turn_ + 1) % acquired_.size();
    if (const Status drawn = blit(texture, image); !drawn) {
        return drawn;
    }
    if (const Status submitted = queue_.submit({.wait = acquired, .signal = image.drawn});
        !submitted) {
        return submitted;
    }
    VkPresentInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &image.drawn;
    info.swapchainCount = 1;
    info.pSwapchains = &handle_;
    info.pImageIndices = &index;
    const VkResult result = device_.fn.QueuePresentKHR(device_.queue, &info);
    if (result == VK_SUBOPTIMAL_KHR || is_lost(result)) {
        stale_ = true;
    } else if (result != VK_SUCCESS) {
        return failed(result, "vkQueuePresentKHR");
    }
    return {};
}

}  // namespace gnomon::vk
