// SPDX-License-Identifier: MIT
#include "internal/devices.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#define GLFW_INCLUDE_NONE
#if GNOMON_HAS_VK
#include <vulkan/vulkan.h>  // before GLFW, which then declares what it has for Vulkan
#endif
#include <GLFW/glfw3.h>

#if GNOMON_HAS_GL
#include <gnomon/gl/backend.hpp>
#endif
#if GNOMON_HAS_VK
#include <gnomon/vk/backend.hpp>
#endif

namespace gnomon::window {

std::string_view name_of(Backend backend) { return backend == Backend::Gl ? "gl" : "vk"; }

std::vector<Backend> backends() {
    std::vector<Backend> built;
#if GNOMON_HAS_GL
    built.push_back(Backend::Gl);
#endif
#if GNOMON_HAS_VK
    built.push_back(Backend::Vk);
#endif
    return built;
}

namespace internal {

namespace {

Result<gpu::Device> device_of(Result<std::unique_ptr<gpu::Backend>> backend) {
    if (!backend) return forward_error(backend);
    return gpu::Device(std::move(*backend));
}

#if GNOMON_HAS_GL
Result<gpu::Device> create_gl(GLFWwindow* window, bool vsync, const gpu::MessageSink& sink) {
    auto context = gl::create_glfw_context(window);
    if (!context) return forward_error(context);
    // The context is current now, and the interval is its own.
    glfwSwapInterval(vsync ? 1 : 0);
    gl::BackendOptions options;
    options.message_sink = sink;
    return device_of(gl::create_backend(std::move(*context), options));
}
#endif

#if GNOMON_HAS_VK
Result<gpu::Device> create_vk(GLFWwindow* window, const gpu::MessageSink& sink) {
    std::uint32_t count = 0;
    const char** extensions = glfwGetRequiredInstanceExtensions(&count);
    if (extensions == nullptr) {
        return fail(
            ErrorCode::Unsupported,
            fmt::format("Vulkan cannot show anything in a window here: {}", last_glfw_error()));
    }
    vk::BackendOptions options;
    options.message_sink = sink;
    options.window = vk::Window{.instance_extensions = {extensions, extensions + count},
                                .create_surface = [window](void* instance) -> std::uint64_t {
                                    VkSurfaceKHR surface = VK_NULL_HANDLE;
                                    glfwCreateWindowSurface(static_cast<VkInstance>(instance),
                                                            window, nullptr, &surface);
                                    return reinterpret_cast<std::uint64_t>(surface);
                                },
                                .framebuffer_size =
                                    [window] {
                                        int width = 0;
                                        int height = 0;
                                        glfwGetFramebufferSize(window, &width, &height);
                                        return vk::Extent{static_cast<std::uint32_t>(width),
                                                          static_cast<std::uint32_t>(height)};
                                    }};
    return device_of(vk::create_backend(options));
}
#endif

}  // namespace

std::string last_glfw_error() {
    const char* reason = nullptr;
    if (glfwGetError(&reason) == GLFW_NO_ERROR || reason == nullptr) return "GLFW gives no reason.";
    return fmt::format("{}.", reason);
}

void set_window_hints(Backend backend) {
    glfwDefaultWindowHints();
    if (backend == Backend::Vk) {
        glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
        return;
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    // The scene is drawn into textures; the window takes a copy of the picture alone.
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
}

Result<gpu::Device> create_device(GLFWwindow* window, Backend backend, [[maybe_unused]] bool vsync,
                                  const gpu::MessageSink& sink) {
#if GNOMON_HAS_GL
    if (backend == Backend::Gl) return create_gl(window, vsync, sink);
#endif
#if GNOMON_HAS_VK
    if (backend == Backend::Vk) return create_vk(window, sink);
#endif
    return fail(ErrorCode::Unsupported,
                fmt::format("This build has no backend \"{}\".", name_of(backend)));
}

}  // namespace internal
}  // namespace gnomon::window
