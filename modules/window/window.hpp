// SPDX-License-Identifier: MIT
//
// Window: a window, its input as plain data, and a device that shows pictures in it, on OpenGL or
// on Vulkan, exchanged while the program runs. GLFW does the work.
//
//     auto window = Window::open({.title = "game"});
//     while (!window->input().close_requested) {
//         window->poll();
//         if (window->is_minimised()) continue;
//         … draw into a texture of window->size_px() with window->device() …
//         if (const Status shown = window->present(picture); !shown) …
//     }
//
// Sizes are pixels of the framebuffer. Swapchains that are out of date are remade by present().
// Threads: windows, all of them, belong to the program's main thread.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/gpu/message_sink.hpp>
#include <gnomon/input/input.hpp>

namespace gnomon::window {

enum class Backend : std::uint8_t { Gl, Vk };
/// "gl", "vk".
[[nodiscard]] std::string_view name_of(Backend backend);
/// Those of this build, at least one; the first is what a program takes that was not told.
[[nodiscard]] std::vector<Backend> backends();

struct WindowDesc {
    std::string title = "gnomon";
    glm::uvec2 size_px{1280, 720};  ///< as far as the desktop agrees
    /// None: the first of backends() that works here.
    std::optional<Backend> backend = std::nullopt;
    /// Present waits for the screen. Vulkan always does (FIFO).
    bool vsync = true;
    gpu::MessageSink message_sink = {};
};

class Window {
public:
    /// Fails with ErrorCode::Unsupported where there is no display, or no such backend.
    [[nodiscard]] static Result<Window> open(const WindowDesc& desc);
    Window(Window&&) noexcept;
    Window& operator=(Window&&) noexcept;
    ~Window();

    /// Begins a frame of input with the events since the last call. `wait_s` > 0: waits that long
    /// for one, for programs that draw only when something happens. While the window is minimised
    /// it waits a tenth of a second in any case. Gamepads are read as Input::see_gamepad() says.
    const input::Input& poll(double wait_s = 0.0);
    [[nodiscard]] const input::Input& input() const;

    /// 0 x 0 while it is minimised.
    [[nodiscard]] glm::uvec2 size_px() const;
    [[nodiscard]] bool is_minimised() const;
    /// By how much the desktop wants text larger than on a plain screen: 1, 1.5, 2. Changes when
    /// the window goes to another monitor.
    [[nodiscard]] float content_scale() const;

    /// Stays at its address, whose device reopen() exchanges. Only while has_device().
    [[nodiscard]] gpu::Device& device();
    [[nodiscard]] Backend backend() const;
    /// Shows a texture (TextureUsage::CopySrc, single-sampled colour, already sRGB-encoded),
    /// stretched where the window's size has changed meanwhile; nothing while it is minimised.
    /// ErrorCode::DeviceLost: reopen() gives another device.
    [[nodiscard]] Status present(gpu::TextureId picture);

    /// Takes the device down and makes one of this backend; of the same one after the device was
    /// lost. Every object that was made on the old one is gone, and its owners may be dropped
    /// before or after. The window is made anew at its place, since GLFW binds a window to an API
    /// for life; what was held is let go. When it fails the backend before is tried again,
    /// and the error is returned all the same; only where that failed too, device() is invalid.
    [[nodiscard]] Status reopen(Backend backend);
    /// False only after a reopen() that found neither backend.
    [[nodiscard]] bool has_device() const;

    /// As WindowDesc::vsync; kept by reopen().
    void set_vsync(bool vsync);
    void set_title(const std::string& title);
    /// As far as the desktop agrees, and when it likes; nothing while it fills the screen.
    void set_size(const glm::uvec2& size_px);
    /// Over the whole of the monitor that holds most of it, or back as it was. Nothing where there
    /// is no monitor.
    void set_fullscreen(bool fullscreen);
    [[nodiscard]] bool is_fullscreen() const;
    /// Hidden and held within the window, so that motion never ends at an edge.
    void capture_cursor(bool captured);

private:
    struct State;
    explicit Window(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// Reopens a window on another backend, or after a device was lost on the same one, with all that
/// draws in it: `let_go` frees what the device before made, `attach` makes it anew. Where the other
/// backend has no window, or `attach` fails there but for a lost device, the one before takes over
/// again. Fails where no device is left to go on with; otherwise says why the backend did not
/// change, or nullopt.
[[nodiscard]] Result<std::optional<std::string>> exchange(Window& window, Backend backend,
                                                          const std::function<void()>& let_go,
                                                          const std::function<Status()>& attach);

}  // namespace gnomon::window
