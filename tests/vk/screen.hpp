// SPDX-License-Identifier: MIT
//
// What an X server shows of a window. Apart from the test because Xlib's macros clash with gnomon's
// words.
#pragma once

struct GLFWwindow;

namespace gnomon::vk_test {

/// 0xRRGGBB of a pixel of the window, or all bits set when the server does not say.
[[nodiscard]] unsigned long pixel_on_screen(GLFWwindow* window, int x, int y);

}  // namespace gnomon::vk_test
