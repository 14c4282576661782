// SPDX-License-Identifier: MIT
//
// Windows on both backends: what is presented is on the screen, whatever the window's size does,
// and a backend takes over from the other while the program runs.
#include <gtest/gtest.h>
#include <gnomon/window/window.hpp>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/devices.hpp"
#include "tests/support/share.hpp"
#include "tests/window/screen.hpp"

namespace gnomon::window {
namespace {

using test::must;

struct Rgb {
    std::uint8_t r, g, b;
    [[nodiscard]] unsigned long packed() const {
        return static_cast<unsigned long>(r) << 16U | static_cast<unsigned long>(g) << 8U | b;
    }
};

gpu::Texture filled(gpu::Device& device, const Rgb& color) {
    gpu::Texture texture = must(device.create_texture(
        {.label = "picture",
         .width = 64,
         .height = 48,
         .format = gpu::Format::Rgba8Unorm,
         .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc}));
    gpu::CommandEncoder encoder = device.create_command_encoder("fill");
    encoder
        .begin_render_pass({.label = "fill",
                            .color_attachments = {{.texture = texture,
                                                   .load_op = gpu::LoadOp::Clear,
                                                   .clear_value = {color.r / 255.0, color.g / 255.0,
                                                                   color.b / 255.0, 1.0}}}})
        .end();
    must(device.submit(must(encoder.finish())));
    return texture;
}

// Presents until the window's pixel has the colour; a presentation is not finished when the call
// returns.
void expect_on_screen(Window& window, const Rgb& color) {
    const gpu::Texture picture = filled(window.device(), color);
    unsigned long seen = 0;
    for (int i = 0; i < 150; ++i) {
        must(window.present(picture));
        window.poll();
        const glm::uvec2 size = window.size_px();
        seen = test::pixel_on_screen(static_cast<int>(size.x) - 2, static_cast<int>(size.y) - 2);
        if (seen == color.packed()) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ADD_FAILURE() << std::hex << "The screen shows " << seen << " instead of " << color.packed();
}

class WindowOn : public testing::TestWithParam<Backend> {
protected:
    // The window, or none where this machine has no display or no such backend.
    std::optional<Window> open(const WindowDesc& desc = {}) {
        WindowDesc wanted = desc;
        wanted.size_px = {160, 120};
        wanted.backend = GetParam();
        auto window = Window::open(wanted);
        if (!window && test::is_required(std::string(name_of(GetParam())))) {
            ADD_FAILURE() << window.error().message;
        }
        if (!window) {
            why_none_ = window.error().message;
            return std::nullopt;
        }
        return std::move(*window);
    }

    std::string why_none_;
};

TEST_P(WindowOn, shows_what_is_presented_at_any_size) {
    auto window = open();
    if (!window) GTEST_SKIP() << why_none_;
    EXPECT_EQ(window->backend(), GetParam());
    EXPECT_EQ(window->device().caps().backend, name_of(GetParam()));
    EXPECT_EQ(window->size_px(), glm::uvec2(160, 120));
    expect_on_screen(*window, {200, 30, 60});
    for (const glm::uvec2 size : {glm::uvec2(300, 90), glm::uvec2(64, 200), glm::uvec2(640, 480)}) {
        window->set_size(size);
        for (int i = 0; i < 100 && window->size_px() != size; ++i) window->poll(0.01);
        ASSERT_EQ(window->size_px(), size);
        expect_on_screen(*window, {static_cast<std::uint8_t>(size.x / 4), 120, 40});
    }
}

TEST_P(WindowOn, gives_way_to_the_other_backend_and_comes_back) {
    auto window = open();
    if (!window) GTEST_SKIP() << why_none_;
    const std::vector<Backend> all = backends();
    if (all.size() < 2) GTEST_SKIP() << "There is one backend in this build.";
    const Backend other = GetParam() == Backend::Gl ? Backend::Vk : Backend::Gl;
    const int turns = test::thorough() ? 50 : 2;
    std::uint64_t objects = 0;
    for (int i = 0; i < turns; ++i) {
        for (const Backend backend : {other, GetParam()}) {
            // Kept beyond its device, as a program may.
            const gpu::Texture orphan = filled(window->device(), {1, 2, 3});
            if (i == 0 && backend == other) objects = window->device().counters().objects_alive;
            const Status opened = window->reopen(backend);
            ASSERT_TRUE(opened) << opened.error().message;
            EXPECT_EQ(window->backend(), backend);
            EXPECT_EQ(window->device().caps().backend, name_of(backend));
            EXPECT_EQ(window->size_px(), glm::uvec2(160, 120));
            EXPECT_EQ(window->device().counters().objects_alive, objects - 1) << "nothing of old";
            if (i < 2 || i + 1 == turns) {
                expect_on_screen(*window,
                                 {static_cast<std::uint8_t>(40 + i),
                                  static_cast<std::uint8_t>(backend == Backend::Gl ? 9 : 99), 250});
            }
        }
    }
}

TEST_P(WindowOn, reports_keys) {
    auto window = open();
    if (!window) GTEST_SKIP() << why_none_;
    expect_on_screen(*window, {10, 200, 30});  // it is there
    test::send_key(80, 60, 'w', true);
    bool seen = false;
    for (int i = 0; i < 100 && !seen; ++i) seen = window->poll(0.01).was_pressed(input::Key::W);
    EXPECT_TRUE(seen);
    EXPECT_TRUE(window->input().is_down(input::Key::W));
    EXPECT_FALSE(window->poll().was_pressed(input::Key::W));
    test::send_key(80, 60, 'w', false);
    for (int i = 0; i < 100 && window->input().is_down(input::Key::W); ++i) window->poll(0.01);
    EXPECT_FALSE(window->input().is_down(input::Key::W));
    EXPECT_FALSE(window->input().close_requested);
}

TEST_P(WindowOn, lets_go_and_says_so_when_the_keyboard_is_anothers) {
    auto window = open();
    if (!window) GTEST_SKIP() << why_none_;
    expect_on_screen(*window, {10, 200, 30});  // it is there
    test::give_focus(80, 60);
    for (int i = 0; i < 10; ++i) EXPECT_FALSE(window->poll(0.01).focus_lost);
    test::send_key(80, 60, 'w', true);
    for (int i = 0; i < 100 && !window->input().is_down(input::Key::W); ++i) window->poll(0.01);
    ASSERT_TRUE(window->input().is_down(input::Key::W));
    test::take_focus();
    bool lost = false;
    for (int i = 0; i < 100 && !lost; ++i) lost = window->poll(0.01).focus_lost;
    EXPECT_TRUE(lost);
    EXPECT_FALSE(window->input().is_down(input::Key::W));
    EXPECT_FALSE(window->poll().focus_lost) << "once";
}

TEST_P(WindowOn, fills_the_screen_and_comes_back) {
    auto window = open();
    if (!window) GTEST_SKIP() << why_none_;
    window->set_fullscreen(true);
    for (int i = 0; i < 100 && window->size_px().x != 1280; ++i) window->poll(0.01);
    // The screen that tests/window/CMakeLists.txt asks for.
    ASSERT_EQ(window->size_px(), glm::uvec2(1280, 1024));
    ASSERT_TRUE(window->is_fullscreen());
    expect_on_screen(*window, {0, 90, 180});
    window->set_size({300, 200});
    for (int i = 0; i < 10; ++i) window->poll(0.01);
    EXPECT_EQ(window->size_px(), glm::uvec2(1280, 1024)) << "it fills the screen";
    window->set_fullscreen(false);
    for (int i = 0; i < 100 && window->size_px().x != 160; ++i) window->poll(0.01);
    EXPECT_EQ(window->size_px(), glm::uvec2(160, 120));
    expect_on_screen(*window, {180, 90, 0});
}

INSTANTIATE_TEST_SUITE_P(Backends, WindowOn, testing::ValuesIn(backends()),
                         [](const auto& info) { return std::string(name_of(info.param)); });

TEST(WindowDesc, sizes_that_no_window_has_are_refused) {
    for (const glm::uvec2 size : {glm::uvec2(0, 100), glm::uvec2(100, 0), glm::uvec2(40000, 10)}) {
        const auto window = Window::open({.size_px = size});
        ASSERT_FALSE(window);
        EXPECT_EQ(window.error().code, ErrorCode::InvalidInput);
    }
}

}  // namespace
}  // namespace gnomon::window
