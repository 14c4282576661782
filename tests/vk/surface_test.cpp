// SPDX-License-Identifier: MIT
//
// A surface that is lost. No driver loses one when it is asked to, so functions in the device's own
// table are replaced by ones that say so once.
#include <gmock/gmock.h>

#include "internal/swapchain.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "tests/vk/fixture.hpp"

namespace gnomon::vk {
namespace {

using testing::HasSubstr;

int losses_due = 0;

/// Loses the surface as often as is due, and then does what the driver does.
template <auto Member>
struct Losing {
    template <class... Arguments>
    static void put_into(DeviceFunctions& functions, VkResult(VKAPI_PTR*& function)(Arguments...)) {
        driver<Arguments...> = functions.*Member;
        function = lose<Arguments...>;
    }
    template <class... Arguments>
    static inline VkResult(VKAPI_PTR* driver)(Arguments...) = nullptr;
    template <class... Arguments>
    static VKAPI_ATTR VkResult VKAPI_CALL lose(Arguments... arguments) {
        if (losses_due > 0) {
            --losses_due;
            return VK_ERROR_SURFACE_LOST_KHR;
        }
        return driver<Arguments...>(arguments...);
    }
};

class Surface : public testing::Test {
protected:
    void SetUp() override {
        // Kept until the process ends, as a server without clients starts over.
        ASSERT_EQ(glfwInit(), GLFW_TRUE);
        glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
        window = glfwCreateWindow(64, 48, "gnomon test", nullptr, nullptr);
        ASSERT_NE(window, nullptr);
        std::uint32_t count = 0;
        const char** extensions = glfwGetRequiredInstanceExtensions(&count);
        BackendOptions options;
        options.message_sink = test::make_sink(log);
        options.validation = true;
        options.window = Window{.instance_extensions = {extensions, extensions + count},
                                .create_surface = [this](void* instance) -> std::uint64_t {
                                    ++surfaces;
                                    VkSurfaceKHR surface = VK_NULL_HANDLE;
                                    if (gives_surfaces) {
                                        glfwCreateWindowSurface(static_cast<VkInstance>(instance),
                                                                window, nullptr, &surface);
                                    }
                                    return reinterpret_cast<std::uint64_t>(surface);
                                },
                                .framebuffer_size =
                                    [] {
                                        return Extent{64, 48};
                                    }};
        Result<std::unique_ptr<Device>> made = Device::create(options);
        if (!made) {
            GTEST_SKIP() << made.error().message;
        }
        device = std::move(*made);
        memory.emplace(*device);
        queue.emplace(*device);
        ASSERT_TRUE(queue->initialise());
        swapchain.emplace(*device, *queue, *options.window);
        Result<Texture> picture = make_texture(
            *device, *memory,
            {.label = "picture",
             .width = 8,
             .height = 8,
             .format = gpu::Format::Rgba8Unorm,
             .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc});
        ASSERT_TRUE(picture);
        texture = std::move(*picture);
        ASSERT_TRUE(swapchain->present(texture));
        ASSERT_EQ(surfaces, 1);
        losses_due = 0;
    }
    void TearDown() override {
        if (queue) {
            EXPECT_TRUE(queue->finish());
        }
        swapchain.reset();
        if (memory) {
            free_texture(*device, *memory, texture);
        }
        queue.reset();
        memory.reset();
        device.reset();
        if (window != nullptr) {
            glfwDestroyWindow(window);
        }
    }

    GLFWwindow* window = nullptr;
    int surfaces = 0;  // that were asked for
    bool gives_surfaces = true;
    std::shared_ptr<test::MessageLog> log = std::make_shared<test::MessageLog>("vk surface");
    std::unique_ptr<Device> device;
    std::optional<Memory> memory;
    std::optional<Queue> queue;
    std::optional<Swapchain> swapchain;
    Texture texture;
};

TEST_F(Surface, ThatIsLostIsMadeAnewAndThePictureShown) {
    Losing<&DeviceFunctions::AcquireNextImageKHR>::put_into(device->fn,
                                                            device->fn.AcquireNextImageKHR);
    Losing<&DeviceFunctions::QueuePresentKHR>::put_into(device->fn, device->fn.QueuePresentKHR);
    Losing<&DeviceFunctions::CreateSwapchainKHR>::put_into(device->fn,
                                                           device->fn.CreateSwapchainKHR);
    for (int i = 0; i < 3; ++i) {
        losses_due = 1;
        const Status shown = swapchain->present(texture);
        EXPECT_TRUE(shown) << shown.error().message;
        EXPECT_EQ(losses_due, 0);
        EXPECT_EQ(surfaces, 2 + i);
        EXPECT_TRUE(swapchain->present(texture)) << "and from then on";
        EXPECT_EQ(surfaces, 2 + i);
    }
}

TEST_F(Surface, MayBeLostWhenAPictureIsShown) {
    Losing<&DeviceFunctions::QueuePresentKHR>::put_into(device->fn, device->fn.QueuePresentKHR);
    losses_due = 1;
    EXPECT_TRUE(swapchain->present(texture));
    EXPECT_EQ(losses_due, 0);
    EXPECT_EQ(surfaces, 2);
}

TEST_F(Surface, ThatIsLostAgainAndAgainLosesTheDevice) {
    Losing<&DeviceFunctions::CreateSwapchainKHR>::put_into(device->fn,
                                                           device->fn.CreateSwapchainKHR);
    Losing<&DeviceFunctions::AcquireNextImageKHR>::put_into(device->fn,
                                                            device->fn.AcquireNextImageKHR);
    losses_due = 1000;
    const Status lost = swapchain->present(texture);
    ASSERT_FALSE(lost);
    EXPECT_EQ(lost.error().code, ErrorCode::DeviceLost) << "which reopening the window cures";
    EXPECT_THAT(lost.error().message, HasSubstr("VK_ERROR_SURFACE_LOST_KHR"));
    losses_due = 0;
    EXPECT_TRUE(swapchain->present(texture)) << "where it comes back";
}

TEST_F(Surface, OfAWindowThatGivesNoOtherOneLosesTheDevice) {
    Losing<&DeviceFunctions::AcquireNextImageKHR>::put_into(device->fn,
                                                            device->fn.AcquireNextImageKHR);
    gives_surfaces = false;
    losses_due = 1;
    for (int i = 0; i < 2; ++i) {
        const Status lost = swapchain->present(texture);
        ASSERT_FALSE(lost);
        EXPECT_EQ(lost.error().code, ErrorCode::DeviceLost);
        EXPECT_THAT(lost.error().message, HasSubstr("the window gave no other one"));
    }
    gives_surfaces = true;
    EXPECT_TRUE(swapchain->present(texture));
}

}  // namespace
}  // namespace gnomon::vk
