// SPDX-License-Identifier: MIT
#include "internal/events.hpp"

#include <cstddef>
#include <optional>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace gnomon::window::internal {

namespace {

using input::Key;
using input::MouseButton;

Key offset(Key first, int by) { return static_cast<Key>(static_cast<int>(first) + by); }

std::optional<Key> key_of(int key) {
    if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z) return offset(Key::A, key - GLFW_KEY_A);
    if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return offset(Key::Digit0, key - GLFW_KEY_0);
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) {
        return offset(Key::Digit0, key - GLFW_KEY_KP_0);
    }
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return offset(Key::F1, key - GLFW_KEY_F1);
    switch (key) {
        case GLFW_KEY_LEFT: return Key::Left;
        case GLFW_KEY_RIGHT: return Key::Right;
        case GLFW_KEY_UP: return Key::Up;
        case GLFW_KEY_DOWN: return Key::Down;
        case GLFW_KEY_HOME: return Key::Home;
        case GLFW_KEY_END: return Key::End;
        case GLFW_KEY_PAGE_UP: return Key::PageUp;
        case GLFW_KEY_PAGE_DOWN: return Key::PageDown;
        case GLFW_KEY_SPACE: return Key::Space;
        case GLFW_KEY_ENTER:
        case GLFW_KEY_KP_ENTER: return Key::Enter;
        case GLFW_KEY_ESCAPE: return Key::Escape;
        case GLFW_KEY_TAB: return Key::Tab;
        case GLFW_KEY_BACKSPACE: return Key::Backspace;
        case GLFW_KEY_INSERT: return Key::Insert;
        case GLFW_KEY_DELETE: return Key::Delete;
        case GLFW_KEY_MINUS:
        case GLFW_KEY_KP_SUBTRACT: return Key::Minus;
        case GLFW_KEY_EQUAL:
        case GLFW_KEY_KP_ADD: return Key::Equal;
        case GLFW_KEY_COMMA: return Key::Comma;
        case GLFW_KEY_PERIOD: return Key::Period;
        case GLFW_KEY_SLASH: return Key::Slash;
        case GLFW_KEY_LEFT_SHIFT: return Key::LeftShift;
        case GLFW_KEY_RIGHT_SHIFT: return Key::RightShift;
        case GLFW_KEY_LEFT_CONTROL: return Key::LeftControl;
        case GLFW_KEY_RIGHT_CONTROL: return Key::RightControl;
        case GLFW_KEY_LEFT_ALT: return Key::LeftAlt;
        case GLFW_KEY_RIGHT_ALT: return Key::RightAlt;
        default: return std::nullopt;
    }
}

std::optional<MouseButton> button_of(int button) {
    switch (button) {
        case GLFW_MOUSE_BUTTON_LEFT: return MouseButton::Left;
        case GLFW_MOUSE_BUTTON_RIGHT: return MouseButton::Right;
        case GLFW_MOUSE_BUTTON_MIDDLE: return MouseButton::Middle;
        default: return std::nullopt;
    }
}

input::Input& input_of(GLFWwindow* window) {
    return *static_cast<input::Input*>(glfwGetWindowUserPointer(window));
}

void on_key(GLFWwindow* window, int key, int, int action, int) {
    const auto known = key_of(key);
    if (!known) return;
    switch (action) {
        case GLFW_PRESS: input_of(window).press(*known); break;
        case GLFW_REPEAT: input_of(window).repeat(*known); break;
        default: input_of(window).release(*known);
    }
}

void on_button(GLFWwindow* window, int button, int action, int) {
    const auto known = button_of(button);
    if (!known) return;
    if (action == GLFW_RELEASE) {
        input_of(window).release(*known);
    } else {
        input_of(window).press(*known);
    }
}

// GLFW counts in the desktop's units, of which a pixel may be a part.
void on_cursor(GLFWwindow* window, double x, double y) {
    int width = 0;
    int height = 0;
    int pixel_width = 0;
    int pixel_height = 0;
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &pixel_width, &pixel_height);
    if (width <= 0 || height <= 0) return;
    input_of(window).move_cursor({x * pixel_width / width, y * pixel_height / height});
}

}  // namespace

void report_events(GLFWwindow* window, input::Input& input) {
    glfwSetWindowUserPointer(window, &input);
    glfwSetKeyCallback(window, on_key);
    glfwSetMouseButtonCallback(window, on_button);
    glfwSetCursorPosCallback(window, on_cursor);
    glfwSetScrollCallback(
        window, [](GLFWwindow* w, double x, double y) { input_of(w).scroll += glm::dvec2(x, y); });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned int character) {
        input_of(w).text.push_back(static_cast<char32_t>(character));
    });
    glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
        input_of(w).dropped_files.insert(input_of(w).dropped_files.end(), paths, paths + count);
    });
    glfwSetWindowRefreshCallback(window,
                                 [](GLFWwindow* w) { input_of(w).redraw_requested = true; });
    glfwSetWindowCloseCallback(window, [](GLFWwindow* w) { input_of(w).close_requested = true; });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
        if (focused == GLFW_FALSE) input_of(w).lose_focus();
    });
}

std::optional<input::Gamepad> read_gamepad() {
    GLFWgamepadstate state;
    // Other joysticks, or what only looks like one, may come before the first gamepad.
    int joystick = GLFW_JOYSTICK_1;
    while (glfwGetGamepadState(joystick, &state) == GLFW_FALSE) {
        if (++joystick > GLFW_JOYSTICK_LAST) return std::nullopt;
    }
    input::Gamepad pad;
    pad.left_stick = {state.axes[GLFW_GAMEPAD_AXIS_LEFT_X], state.axes[GLFW_GAMEPAD_AXIS_LEFT_Y]};
    pad.right_stick = {state.axes[GLFW_GAMEPAD_AXIS_RIGHT_X],
                       state.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y]};
    // GLFW's triggers rest at -1.
    pad.left_trigger = (state.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER] + 1.0F) / 2.0F;
    pad.right_trigger = (state.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] + 1.0F) / 2.0F;
    for (std::size_t i = 0; i < pad.buttons.size(); ++i) {
        pad.buttons[i] = state.buttons[i] == GLFW_PRESS;
    }
    return pad;
}

}  // namespace gnomon::window::internal
