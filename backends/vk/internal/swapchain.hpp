// SPDX-License-Identifier: MIT
//
// The window's swapchain. Presenting blits a finished texture onto the next image; the swapchain
// follows the window's size by itself, and a surface that is lost is made anew.
#pragma once

#include <vector>

#include "internal/queue.hpp"
#include "internal/textures.hpp"

namespace gnomon::vk {

class Swapchain {
public:
    Swapchain(Device& device, Queue& queue, Window window)
        : device_(device), queue_(queue), window_(std::move(window)) {}
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    /// Does nothing and succeeds while the window is minimised. ErrorCode::DeviceLost also where
    /// the surface was lost and the window gives no other one.
    [[nodiscard]] Status present(Texture& texture);

private:
    struct Image {
        VkImage handle = VK_NULL_HANDLE;
        VkSemaphore drawn = VK_NULL_HANDLE;  // presenting waits for it
        Tracker tracker;
    };

    [[nodiscard]] Status try_to_present(Texture& texture);
    /// Another surface of the same window; the swapchain is to be made anew.
    [[nodiscard]] Status renew_surface();
    /// The error of a call; remembers that the surface was lost.
    [[nodiscard]] tl::unexpected<Error> failed(VkResult result, const char* call);
    void destroy_swapchain();
    /// True when there is a swapchain of the window's size that holds the texture's kind of bytes.
    [[nodiscard]] Result<bool> prepare(bool srgb);
    [[nodiscard]] Status recreate(const VkSurfaceCapabilitiesKHR& capabilities, VkExtent2D extent,
                                  bool srgb);
    [[nodiscard]] Result<VkSurfaceFormatKHR> choose_format(bool srgb);
    [[nodiscard]] Status take_images();
    [[nodiscard]] Result<VkSemaphore> make_semaphore() const;
    void destroy_images();
    [[nodiscard]] Status blit(Texture& texture, Image& image);

    Device& device_;
    Queue& queue_;
    Window window_;
    VkSwapchainKHR handle_ = VK_NULL_HANDLE;
    VkFormat format_ = VK_FORMAT_UNDEFINED;
    VkExtent2D extent_{};
    bool srgb_ = false;
    bool stale_ = true;
    bool surface_lost_ = false;
    std::vector<Image> images_;
    std::vector<VkSemaphore> acquired_;  // taken in turn, one more than there are images
    std::size_t turn_ = 0;
};

}  // namespace gnomon::vk
