// SPDX-License-Identifier: MIT
#include "tests/window/screen.hpp"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

namespace gnomon::test {

unsigned long pixel_on_screen(int x, int y) {
    Display* display = XOpenDisplay(nullptr);
    if (display == nullptr) return ~0UL;
    XImage* image = XGetImage(display, DefaultRootWindow(display), x, y, 1, 1, AllPlanes, ZPixmap);
    unsigned long pixel = ~0UL;
    if (image != nullptr) {
        pixel = XGetPixel(image, 0, 0) & 0xFFFFFFUL;
        XDestroyImage(image);
    }
    XCloseDisplay(display);
    return pixel;
}

namespace {

Window child_below(Display* display, int x, int y) {
    const Window root = DefaultRootWindow(display);
    Window child = 0;
    int child_x = 0;
    int child_y = 0;
    XTranslateCoordinates(display, root, root, x, y, &child_x, &child_y, &child);
    return child;
}

void set_focus(Display* display, Window window) {
    XSetInputFocus(display, window, RevertToNone, CurrentTime);
    XSync(display, False);
    XCloseDisplay(display);
}

}  // namespace

void give_focus(int x, int y) {
    Display* display = XOpenDisplay(nullptr);
    if (display != nullptr) set_focus(display, child_below(display, x, y));
}

void take_focus() {
    Display* display = XOpenDisplay(nullptr);
    if (display != nullptr) set_focus(display, DefaultRootWindow(display));
}

void send_key(int x, int y, unsigned long keysym, bool pressed) {
    Display* display = XOpenDisplay(nullptr);
    if (display == nullptr) return;
    const Window root = DefaultRootWindow(display);
    const Window child = child_below(display, x, y);
    XEvent event{};
    event.xkey.type = pressed ? KeyPress : KeyRelease;
    event.xkey.display = display;
    event.xkey.window = child;
    event.xkey.root = root;
    event.xkey.time = CurrentTime;
    event.xkey.same_screen = True;
    event.xkey.keycode = XKeysymToKeycode(display, keysym);
    XSendEvent(display, child, True, pressed ? KeyPressMask : KeyReleaseMask, &event);
    XCloseDisplay(display);
}

}  // namespace gnomon::test
