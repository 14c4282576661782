// SPDX-License-Identifier: MIT
//
// The one file outside of the apps that knows both backends: a device for a window.
#pragma once

#include <string>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/window/window.hpp>

struct GLFWwindow;

namespace gnomon::window::internal {

/// The hints that a window for this backend is made with.
void set_window_hints(Backend backend);

/// The window was made with those hints and outlives the device.
[[nodiscard]] Result<gpu::Device> create_device(GLFWwindow* window, Backend backend, bool vsync,
                                                const gpu::MessageSink& message_sink);

/// What GLFW said last, as a sentence's end.
[[nodiscard]] std::string last_glfw_error();

}  // namespace gnomon::window::internal
