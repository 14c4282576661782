// SPDX-License-Identifier: MIT
//
// A window on an X server of the test's own: what is presented arrives on the screen, whatever the
// window's size does.
#include <gmock/gmock.h>

#include <chrono>
#include <thread>

#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>

#include "tests/vk/fixture.hpp"
#include "tests/vk/screen.hpp"

namespace gnomon::vk_test {
namespace {

class WindowTest : public testing::Test {
protected:
    // Once: an X server without clients starts over, and refuses newcomers while it does.
    static void SetUpTestSuite() { ASSERT_EQ(glfwInit(), GLFW_TRUE); }
    static void TearDownTestSuite() { glfwTerminate(); }

    void SetUp() override {
        glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
        window = glfwCreateWindow(64, 48, "gnomon test", nullptr, nullptr);
        ASSERT_NE(window, nullptr);
        Result<gpu::Device> opened = open(log, options());
        if (!opened && !test::is_required("vk")) {
            GTEST_SKIP() << opened.error().message;
        }
        device = std::make_unique<gpu::Device>(must(std::move(opened)));
    }
    void TearDown() override {
        device.reset();
        if (window != nullptr) {
            glfwDestroyWindow(window);
        }
    }

    vk::BackendOptions options() {
        vk::BackendOptions result;
        std::uint32_t count = 0;
        const char** extensions = glfwGetRequiredInstanceExtensions(&count);
        result.window = vk::Window{.instance_extensions = {extensions, extensions + count},
                                   .create_surface = [this](void* instance) -> std::uint64_t {
                                       VkSurfaceKHR surface = VK_NULL_HANDLE;
                                       glfwCreateWindowSurface(static_cast<VkInstance>(instance),
                                                               window, nullptr, &surface);
                                       return reinterpret_cast<std::uint64_t>(surface);
                                   },
                                   .framebuffer_size =
                                       [this] {
                                           int width = 0;
                                           int height = 0;
                                           glfwGetFramebufferSize(window, &width, &height);
                                           if (minimised) {
                                               width = height = 0;
                                           }
                                           return vk::Extent{static_cast<std::uint32_t>(width),
                                                             static_cast<std::uint32_t>(height)};
                                       }};
        return result;
    }

    /// Presents until the pixel near the window's lower right corner has the colour; a presentation
    /// is not finished when the call returns.
    void expect_on_screen(const gpu::Texture& texture, unsigned long color) {
        int width = 0;
        int height = 0;
        unsigned long seen = 0;
        for (int i = 0; i < 100; ++i) {
            must(device->present(texture));
            glfwPollEvents();
            glfwGetFramebufferSize(window, &width, &height);
            seen = pixel_on_screen(window, width - 2, height - 2);
            if (seen == color) {
                return;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        ADD_FAILURE() << std::hex << "The screen shows " << seen << " instead of " << color
                      << std::dec << " at a size of " << width << " x " << height << ".";
    }

    GLFWwindow* window = nullptr;
    bool minimised = false;
    std::shared_ptr<test::MessageLog> log = std::make_shared<test::MessageLog>("vk window");
    std::unique_ptr<gpu::Device> device;
};

TEST_F(WindowTest, ShowsWhatIsPresented) {
    Painter painter{*device, 32, 32};
    const gpu::Texture target = painter.make_target();
    painter.set_color(1, 0, 0);
    painter.fill(target);
    expect_on_screen(target, 0xFF0000);
    painter.set_color(0, 0, 1);
    painter.fill(target);
    expect_on_screen(target, 0x0000FF);
    EXPECT_EQ(painter.read_uniform(target), (Rgba8{0, 0, 255, 255}));
}

TEST_F(WindowTest, FollowsItsSize) {
    Painter painter{*device, 32, 32};
    const gpu::Texture target = painter.make_target();
    for (int i = 0; i < 10; ++i) {
        SCOPED_TRACE(i);
        glfwSetWindowSize(window, 64 + 23 * i, 200 - 13 * i);
        glfwPollEvents();
        painter.set_color(static_cast<float>(20 * i + 10) / 255.0F, 1, 0);
        painter.fill(target);
        must(device->present(target));
        expect_on_screen(target, static_cast<unsigned long>(20 * i + 10) << 16U | 0xFF00UL);
    }
}

TEST_F(WindowTest, WithoutASizePresentsNothingAndComesBack) {
    Painter painter{*device, 32, 32};
    const gpu::Texture target = painter.make_target();
    painter.set_color(0, 1, 0);
    painter.fill(target);
    minimised = true;
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(device->present(target));
    }
    minimised = false;
    expect_on_screen(target, 0x00FF00);
}

TEST_F(WindowTest, ShowsSrgbTexturesByteForByte) {
    Painter linear{*device, 32, 32};
    Painter srgb{*device, 32, 32, gpu::Format::Rgba8UnormSrgb};
    const gpu::Texture encoded = srgb.make_target();
    srgb.set_color(0.5F, 0, 0);
    srgb.fill(encoded);
    const Rgba8 bytes = srgb.read_uniform(encoded);
    ASSERT_NEAR(bytes[0], 187.5, 0.5) << "0.5 in the sRGB encoding";
    expect_on_screen(encoded, static_cast<unsigned long>(bytes[0]) << 16U);
    const gpu::Texture plain = linear.make_target();
    linear.set_color(static_cast<float>(bytes[0]) / 255.0F, 0, 0);
    linear.fill(plain);
    expect_on_screen(plain, static_cast<unsigned long>(bytes[0]) << 16U);
}

TEST_F(WindowTest, KeepsManyFramesInOrder) {
    Painter painter{*device, 32, 32};
    const gpu::Texture target = painter.make_target();
    for (int i = 0; i < 60; ++i) {
        painter.set_color(0, static_cast<float>(i) / 255.0F, 0);
        painter.fill(target);
        must(device->present(target));
        glfwPollEvents();
    }
    expect_on_screen(target, 59U << 8U);
}

}  // namespace
}  // namespace gnomon::vk_test
