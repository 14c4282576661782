// SPDX-License-Identifier: MIT
//
// The context of a window that the host made with GLFW. The host polls events and keeps the window
// alive; GLFW itself knows which context is current, so a host may bind its own in between.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "internal/current_context.hpp"

#include <gnomon/gl/context.hpp>

namespace gnomon::gl {
namespace {

class GlfwContext final : public Context, private CurrentContext {
public:
    explicit GlfwContext(GLFWwindow* window) : window_(window) {}
    ~GlfwContext() override { leave(); }

    Status make_current() override { return take(); }
    [[nodiscard]] void* get_proc_address(const char* name) const override {
        return reinterpret_cast<void*>(glfwGetProcAddress(name));
    }
    [[nodiscard]] std::string description() const override { return "GLFW window"; }
    [[nodiscard]] std::optional<Extent> window_size() const override {
        int width = 0;
        int height = 0;
        glfwGetFramebufferSize(window_, &width, &height);
        return Extent{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
    }
    Status swap_buffers() override {
        glfwSwapBuffers(window_);
        return check("glfwSwapBuffers");
    }

private:
    static Status check(const char* function) {
        const char* reason = nullptr;
        if (glfwGetError(&reason) == GLFW_NO_ERROR) return {};
        return fail(ErrorCode::Internal,
                    std::string(function) +
                        " failed: " + (reason != nullptr ? reason : "no reason given") + ".");
    }
    Status bind() override {
        glfwMakeContextCurrent(window_);
        return check("glfwMakeContextCurrent");
    }
    void unbind() override { glfwMakeContextCurrent(nullptr); }
    [[nodiscard]] bool is_bound() const override { return glfwGetCurrentContext() == window_; }

    GLFWwindow* window_;
};

}  // namespace

Result<std::unique_ptr<Context>> create_glfw_context(GLFWwindow* window) {
    if (window == nullptr) {
        return fail(ErrorCode::InvalidInput,
                    "There is no GLFW window (null) to take an OpenGL context from.");
    }
    if (glfwGetWindowAttrib(window, GLFW_CLIENT_API) != GLFW_OPENGL_API) {
        return fail(ErrorCode::Unsupported,
                    "The GLFW window has no OpenGL context: its hint GLFW_CLIENT_API was not "
                    "GLFW_OPENGL_API.");
    }
    auto context = std::make_unique<GlfwContext>(window);
    if (const Status bound = context->make_current(); !bound) return forward_error(bound);
    return context;
}

}  // namespace gnomon::gl
