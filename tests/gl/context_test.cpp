// SPDX-License-Identifier: MIT
//
// Contexts: each platform's gives the same picture, several live side by side on one thread.
#include <gmock/gmock.h>
#include <gnomon/gl/backend.hpp>

#include <thread>

#include "tests/gl/small_scene.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::gl_tests {
namespace {

using test::must;
using testing::HasSubstr;

struct ContextCase {
    const char* device_name;  // as GNOMON_REQUIRE_DEVICES has it
    Result<std::unique_ptr<gl::Context>> (*create)();
    const char* description;
};

void PrintTo(const ContextCase& c, std::ostream* out) { *out << c.device_name; }

class Contexts : public testing::TestWithParam<ContextCase> {
protected:
    std::unique_ptr<gl::Context> create() {
        auto context = GetParam().create();
        if (!context) {
            EXPECT_FALSE(test::is_required(GetParam().device_name)) << context.error().message;
            reason_ = context.error().message;
            return nullptr;
        }
        return std::move(*context);
    }
    std::string reason_;
};

gpu::Device make_device(std::unique_ptr<gl::Context> context) {
    return gpu::Device(must(gl::create_backend(std::move(context), {.debug = true})));
}

void expect_small_scene(gpu::Device& device) {
    const SmallScene scene = draw_small_scene(device);
    const auto color = must(device.read_texture(scene.color));
    EXPECT_EQ(color[0], std::byte{255}) << "the top left corner is orange";
    EXPECT_EQ(color[color.size() - 2], std::byte{255}) << "the bottom right corner is blue";
    EXPECT_EQ(color[color.size() - 4], std::byte{0});
    const auto stencil = must(device.read_texture(scene.depth_stencil, gpu::Aspect::StencilOnly));
    EXPECT_EQ(stencil.front(), std::byte{1});
    EXPECT_EQ(stencil.back(), std::byte{0});
}

TEST_P(Contexts, DrawAPicture) {
    auto context = create();
    if (!context) GTEST_SKIP() << reason_;
    EXPECT_THAT(context->description(), HasSubstr(GetParam().description));
    gpu::Device device = make_device(std::move(context));
    EXPECT_EQ(device.caps().backend, "gl");
    EXPECT_THAT(device.caps().adapter, HasSubstr("OpenGL 4."));
    EXPECT_TRUE(device.caps().features.exact_clip_space);
    expect_small_scene(device);
}

TEST_P(Contexts, HaveNoWindow) {
    auto context = create();
    if (!context) GTEST_SKIP() << reason_;
    EXPECT_FALSE(context->window_size().has_value());
    const Status swapped = context->swap_buffers();
    ASSERT_FALSE(swapped);
    EXPECT_EQ(swapped.error().code, ErrorCode::Unsupported);
    gpu::Device device = make_device(std::move(context));
    const SmallScene scene = draw_small_scene(device);
    const Status presented = device.present(scene.color);
    ASSERT_FALSE(presented);
    EXPECT_EQ(presented.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(presented.error().message, HasSubstr("\"small colour\""));
    EXPECT_THAT(presented.error().message, HasSubstr("has no window"));
}

TEST_P(Contexts, LiveSideBySide) {
    auto first_context = create();
    if (!first_context) GTEST_SKIP() << reason_;
    gpu::Device first = make_device(std::move(first_context));
    gpu::Device second = make_device(create());
    // each call finds its own context, whoever was current before
    for (int round = 0; round < 3; ++round) {
        expect_small_scene(first);
        expect_small_scene(second);
    }
}

TEST_P(Contexts, MoveToAnotherThread) {
    auto context = create();
    if (!context) GTEST_SKIP() << reason_;
    context.reset();
    std::thread([this] {
        gpu::Device device = make_device(create());
        expect_small_scene(device);
    }).join();
    gpu::Device device = make_device(create());
    expect_small_scene(device);
}

INSTANTIATE_TEST_SUITE_P(Platforms, Contexts,
                         testing::Values(ContextCase{"gl_osmesa_separate",
                                                     gl::create_osmesa_context, "OSMesa"},
                                         ContextCase{"gl_egl", gl::create_egl_context, "EGL"}),
                         [](const auto& info) { return std::string(info.param.device_name); });

TEST(HeadlessContext, IsOfHardwareOrElseOsmesas) {
    auto context = gl::create_headless_context();
    if (!context) GTEST_SKIP() << context.error().message;
    const std::string description = (*context)->description();
    const gpu::Device device = make_device(std::move(*context));
    const std::string& adapter = device.caps().adapter;
    const bool is_software = adapter.find("llvmpipe") != std::string::npos;
    if (is_software && gl::create_osmesa_context()) {
        EXPECT_EQ(description, "OSMesa") << adapter;
    } else if (!is_software) {
        EXPECT_EQ(description, "EGL device") << adapter;
    }
}

TEST(MixedContexts, OsmesaAndEglTakeTurnsOnOneThread) {
    auto osmesa = gl::create_osmesa_context();
    if (!osmesa) GTEST_SKIP() << osmesa.error().message;
    auto egl = gl::create_egl_context();
    if (!egl) GTEST_SKIP() << egl.error().message;
    gpu::Device first = make_device(std::move(*osmesa));
    gpu::Device second = make_device(std::move(*egl));
    for (int round = 0; round < 3; ++round) {
        expect_small_scene(first);
        expect_small_scene(second);
    }
    { const gpu::Device gone = std::move(first); }
    expect_small_scene(second);
}

}  // namespace
}  // namespace gnomon::gl_tests
