// SPDX-License-Identifier: MIT
//
// Context: where an OpenGL context comes from. One file per platform; nothing else of gnomon::gl
// knows which one it runs on. A backend owns its context and makes it current whenever it is
// called.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <gnomon/core/result.hpp>

struct GLFWwindow;

#pragma GCC visibility push(default)
namespace gnomon::gl {

/// A size in pixels.
struct Extent {
    std::uint32_t width = 0;   ///< pixels
    std::uint32_t height = 0;  ///< pixels
};

/// An OpenGL context, wherever it came from.
class Context {
public:
    virtual ~Context() = default;

    /// Makes it current on this thread.
    virtual Status make_current() = 0;
    /// A function of OpenGL's; null where there is none.
    [[nodiscard]] virtual void* get_proc_address(const char* name) const = 0;
    [[nodiscard]] virtual std::string description()
        const = 0;  ///< "OSMesa", "EGL surfaceless", "GLFW window"

    /// Pixels of the window's framebuffer; nothing where there is no window.
    [[nodiscard]] virtual std::optional<Extent> window_size() const { return std::nullopt; }
    /// Whether OpenGL's state is a host's, which finds it after each call as it was before.
    [[nodiscard]] virtual bool restores_state() const { return false; }
    /// Whether a host made it and uses it between two calls.
    [[nodiscard]] virtual bool is_adopted() const { return false; }
    /// Shows what was drawn; ErrorCode::Unsupported without a window.
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

/// As wglGetProcAddress, eglGetProcAddress, glfwGetProcAddress and their kin: null where there is
/// no such function.
using GetProcAddress = std::function<void*(const char* name)>;

/// What a host finds of OpenGL's state after a call of gnomon's.
enum class HostState : std::uint8_t {
    Restored,  ///< what it was. All that drawing touches is queried for each submission, which may
               ///< make a threaded driver wait; a few bindings for other calls
    /// After what was submitted OpenGL's defaults, in switches, write masks, framebuffer, program,
    /// vertex array, culling, depth range, provoking vertex and clip control. The functions of
    /// depth, stencil and blending, polygon mode and offset, viewport, scissor, pixel store and the
    /// bindings of textures and buffers are anybody's guess: for hosts that set what they use.
    Defaults,
};

/// The context that is current on this thread, of any platform, core or compatibility profile. It
/// stays the host's, who has it current whenever the backend or an object of its device is used,
/// destroyed or freed, and keeps it for as long. While gnomon is called no query, conditional
/// rendering or transform feedback is under way and no program is current that was deleted. Errors
/// of the host's that it has not asked for (glGetError) are lost, never taken for gnomon's; with
/// HostState::Defaults those before a submission or a write stay, which asks for no errors, its own
/// neither, so that nothing waits.
[[nodiscard]] Result<std::unique_ptr<Context>> adopt_current_context(
    GetProcAddress get_proc_address, HostState state = HostState::Restored);

/// The context of a GLFW window that the host made and keeps alive. Only in gnomon::gl_glfw.
[[nodiscard]] Result<std::unique_ptr<Context>> create_glfw_context(GLFWwindow* window);

}  // namespace gnomon::gl
#pragma GCC visibility pop
