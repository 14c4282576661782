// SPDX-License-Identifier: MIT
//
// gnomon::vk: the GPU interface on Vulkan 1.1 and later. The loader is opened at run time: a
// program that links this starts on a machine without Vulkan and gets one sentence when it asks for
// a device.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/backend.hpp>
#include <gnomon/gpu/message_sink.hpp>

#pragma GCC visibility push(default)
namespace gnomon::vk {

/// A size in pixels.
struct Extent {
    std::uint32_t width = 0;   ///< pixels
    std::uint32_t height = 0;  ///< pixels
};

/// What the host's window library has to lend. GLFW: glfwGetRequiredInstanceExtensions,
/// glfwCreateWindowSurface, glfwGetFramebufferSize. Nothing here names a window library.
struct Window {
    std::vector<std::string> instance_extensions;  ///< that its surfaces need
    /// Takes a VkInstance, gives a VkSurfaceKHR (0 when it fails); both as their raw values.
    std::function<std::uint64_t(void* instance)> create_surface;
    /// in pixels, as it is when called
    std::function<Extent()> framebuffer_size;
};

/// What turns y up. Pictures are the same but for the last bits of vertices that clipping makes.
enum class YUp : std::uint8_t {
    VertexStages,  ///< they negate it, so that Vulkan clips the very coordinates that OpenGL does
    /// A viewport of negative height, as browsers draw WebGPU: masks then equal those of
    /// gnomon::webgpu on the same driver. Only for vertex stages that gnomon's build compiled,
    /// which take their sign from specialization constant 100.
    Viewport,
};

/// What a backend is made with.
struct BackendOptions {
    std::string adapter =
        {};  ///< part of the wanted device's name; default: discrete, integrated, then software
    bool validation = false;  ///< the Khronos validation layer; its messages go to the sink
    /// Treated as absent, for tests of fallbacks: "depthClamp", "depthBiasClamp", "depthBounds",
    /// "independentBlend", "occlusionQueryPrecise", "sampleRate", "timestamps",
    /// "D32_SFLOAT_S8_UINT", "D24_UNORM_S8_UINT", "sampledStencil".
    std::vector<std::string> disabled_features = {};
    gpu::MessageSink message_sink = {};           ///< gets what the driver says; empty: it is lost
    std::optional<Window> window = std::nullopt;  ///< to present in; none: headless
    YUp y_up = YUp::VertexStages;                 ///< as OpenGL clips, or as browsers do
};

/// Fails with ErrorCode::Unsupported, naming what is missing, or with ErrorCode::InvalidInput when
/// a disabled feature is none of those above.
[[nodiscard]] Result<std::unique_ptr<gpu::Backend>> create_backend(
    const BackendOptions& options = {});

}  // namespace gnomon::vk
#pragma GCC visibility pop
