// SPDX-License-Identifier: MIT
//
// What the X server shows. Apart from the tests because Xlib's macros clash with gnomon's words.
#pragma once

namespace gnomon::test {

/// 0xRRGGBB of a pixel of the screen, or all bits set when the server does not say.
[[nodiscard]] unsigned long pixel_on_screen(int x, int y);

/// Sends a key to the window below the pixel, as a keyboard would, through the server.
void send_key(int x, int y, unsigned long keysym, bool pressed);

/// Gives the keyboard to the window below the pixel, as a desktop would, or to none.
void give_focus(int x, int y);
void take_focus();

}  // namespace gnomon::test
