// SPDX-License-Identifier: MIT
//
// Reads the screen through Xlib.
#include "tests/vk/screen.hpp"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

// As <GLFW/glfw3native.h> has them, which asks for the headers of XRandR as well.
extern "C" Display* glfwGetX11Display();
extern "C" Window glfwGetX11Window(GLFWwindow* window);

namespace gnomon::vk_test {

unsigned long pixel_on_screen(GLFWwindow* window, int x, int y) {
    Display* display = glfwGetX11Display();
    XSync(display, False);
    XImage* image = XGetImage(display, glfwGetX11Window(window), x, y, 1, 1, AllPlanes, ZPixmap);
    if (image == nullptr) {
        return ~0UL;
    }
    const unsigned long pixel = XGetPixel(image, 0, 0) & 0xFFFFFFUL;
    XDestroyImage(image);
    return pixel;
}

}  // namespace gnomon::vk_test
