// SPDX-License-Identifier: MIT
//
// Context: where an OpenGL context comes from. One file per platform; nothing else of gnomon::gl
// knows which one it runs on. A backend owns its context and makes it current whenever it is
// called.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <gnomon/core/result.hpp>

struct GLFWwindow;

namespace gnomon::gl {

struct Extent {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

class Context {
public:
    virtual ~Context() = default;

    virtual Status make_current() = 0;
    [[nodiscard]] virtual void* get_proc_address(const char* name) const = 0;
    [[nodiscard]] virtual std::string description()
        const = 0;  ///< "OSMesa", "EGL surfaceless", "GLFW window"

    /// Pixels of the window's framebuffer; nothing where there is no window.
    [[nodiscard]] virtual std::optional<Extent> window_size() const { return std::nullopt; }
    virtual Status swap_buffers() {
        return fail(ErrorCode::Unsupported,
                    "This OpenGL context (" + description() + ") has no window.");
    }
};

/// Mesa's off-screen renderer, loaded when called (libOSMesa.so.8). A compatibility context: it
/// alone offers EXT_stencil_two_side.
[[nodiscard]] Result<std::unique_ptr<Context>> create_osmesa_context();

/// EGL without any surface: works on a GPU without a display, and where Mesa no longer ships
/// OSMesa. The first device that EGL lists and that is no software, else Mesa's surfaceless
/// platform, else any device.
[[nodiscard]] Result<std::unique_ptr<Context>> create_egl_context();

/// The best there is without a window: EGL's where EGL lists a device of hardware, else OSMesa's
/// (it is there without any set-up, and has all three stencil paths), else EGL's on software.
[[nodiscard]] Result<std::unique_ptr<Context>> create_headless_context();

/// The context of a GLFW window that the host made and keeps alive. Only in gnomon::gl_glfw.
[[nodiscard]] Result<std::unique_ptr<Context>> create_glfw_context(GLFWwindow* window);

}  // namespace gnomon::gl
