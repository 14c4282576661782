// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <gnomon/input/input.hpp>

struct GLFWwindow;

namespace gnomon::window::internal {

/// Has GLFW report the window's events to `input`, which outlives the window.
void report_events(GLFWwindow* window, input::Input& input);

[[nodiscard]] std::optional<input::Gamepad> read_gamepad();

}  // namespace gnomon::window::internal
