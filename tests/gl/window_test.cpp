// SPDX-License-Identifier: MIT
//
// A window of GLFW's: the picture stands upright on it and is stretched to its size.
#define GLFW_INCLUDE_NONE
#include <GL/glcorearb.h>
#include <GLFW/glfw3.h>
#include <gmock/gmock.h>
#include <gnomon/gl/backend.hpp>

#include <array>
#include <cstdlib>
#include <vector>

#include "tests/gl/small_scene.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::gl_tests {
namespace {

using test::must;
using testing::HasSubstr;

constexpr int window_width = 64;
constexpr int window_height = 32;

using Pixel = std::array<unsigned char, 4>;

/// Takes a picture of the back buffer just before it is shown: what a screen holds cannot be read
/// reliably (software GLX reads nothing from GL_FRONT).
class CapturingContext final : public gl::Context {
public:
    explicit CapturingContext(std::unique_ptr<gl::Context> inner, std::vector<Pixel>& shown)
        : inner_(std::move(inner)), shown_(shown) {}

    Status make_current() override { return inner_->make_current(); }
    [[nodiscard]] void* get_proc_address(const char* name) const override {
        return inner_->get_proc_address(name);
    }
    [[nodiscard]] std::string description() const override { return inner_->description(); }
    [[nodiscard]] std::optional<gl::Extent> window_size() const override {
        return inner_->window_size();
    }
    Status swap_buffers() override {
        const auto read_pixels =
            reinterpret_cast<PFNGLREADPIXELSPROC>(get_proc_address("glReadPixels"));
        const gl::Extent size = *window_size();
        shown_.resize(std::size_t{size.width} * size.height);
        read_pixels(0, 0, static_cast<GLsizei>(size.width), static_cast<GLsizei>(size.height),
                    GL_RGBA, GL_UNSIGNED_BYTE, shown_.data());
        return inner_->swap_buffers();
    }

private:
    std::unique_ptr<gl::Context> inner_;
    std::vector<Pixel>& shown_;
};

class Window : public testing::Test {
protected:
    void SetUp() override {
        if (std::getenv("DISPLAY") == nullptr) GTEST_SKIP() << "DISPLAY is not set";
        ASSERT_EQ(glfwInit(), GLFW_TRUE);
        glfwWindowHint(GLFW_VISIBLE, GLFW_TRUE);
        glfwWindowHint(GLFW_DECORATED, GLFW_FALSE);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
        window_ = glfwCreateWindow(window_width, window_height, "gnomon", nullptr, nullptr);
        ASSERT_NE(window_, nullptr);
    }
    void TearDown() override {
        if (window_ != nullptr) glfwDestroyWindow(window_);
        glfwTerminate();
    }
    gpu::Device make_device() {
        return gpu::Device(
            must(gl::create_backend(must(gl::create_glfw_context(window_)), {.debug = true})));
    }
    GLFWwindow* window_ = nullptr;
};

TEST_F(Window, ShowsThePictureUprightAndStretched) {
    std::vector<Pixel> shown;  // row 0 at the bottom, as a window has it
    auto context =
        std::make_unique<CapturingContext>(must(gl::create_glfw_context(window_)), shown);
    gpu::Device device(must(gl::create_backend(std::move(context), {.debug = true})));
    const SmallScene scene = draw_small_scene(device);
    must(device.present(scene.color));
    must(device.wait_idle());
    const auto at = [&shown](int x, int y_from_top) {
        return shown[static_cast<std::size_t>((window_height - 1 - y_from_top) * window_width + x)];
    };
    ASSERT_EQ(shown.size(), std::size_t{window_width} * window_height);
    const Pixel orange = at(1, 1);
    EXPECT_EQ(orange[0], 255);
    EXPECT_NEAR(orange[1], 128, 1);
    EXPECT_EQ(orange[2], 0);
    const Pixel blue{0, 0, 255, 255};
    EXPECT_EQ(at(1, window_height - 2), blue);
    EXPECT_EQ(at(window_width - 2, window_height - 2), blue);
    EXPECT_EQ(at(window_width - 2, 1), blue);
    // the triangle's long leg lies on the middle row, stretched to the width of the window
    EXPECT_EQ(at(window_width / 2, window_height / 2 - 3)[0], 255);
    EXPECT_EQ(at(window_width / 2, window_height / 2 + 2), blue);
}

TEST_F(Window, BindsItsContextAgainAfterAHostUnboundIt) {
    gpu::Device device = make_device();
    const SmallScene scene = draw_small_scene(device);
    glfwMakeContextCurrent(nullptr);
    const SmallScene again = draw_small_scene(device);
    EXPECT_EQ(must(device.read_texture(scene.color)), must(device.read_texture(again.color)));
    must(device.present(again.color));
}

TEST_F(Window, KnowsItsSize) {
    const auto context = must(gl::create_glfw_context(window_));
    const auto size = context->window_size();
    ASSERT_TRUE(size.has_value());
    EXPECT_EQ(size->width, static_cast<std::uint32_t>(window_width));
    EXPECT_EQ(size->height, static_cast<std::uint32_t>(window_height));
}

TEST_F(Window, WithoutAContextIsRefused) {
    EXPECT_EQ(gl::create_glfw_context(nullptr).error().code, ErrorCode::InvalidInput);
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    GLFWwindow* bare = glfwCreateWindow(8, 8, "bare", nullptr, nullptr);
    ASSERT_NE(bare, nullptr);
    const auto context = gl::create_glfw_context(bare);
    ASSERT_FALSE(context);
    EXPECT_EQ(context.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(context.error().message, HasSubstr("GLFW_CLIENT_API"));
    glfwDestroyWindow(bare);
    glfwDefaultWindowHints();
}

}  // namespace
}  // namespace gnomon::gl_tests
