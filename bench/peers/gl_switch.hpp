// SPDX-License-Identifier: MIT
//
// A switch between an engine and its OpenGL. The programs that link this define the functions that
// draw and clear themselves, and the engines' libraries, which are bound to them by name, meet
// these first. They pass every call on, or, when dry, drop it: all that an engine does is then
// done, and nothing by the device. Exchanging buffers is dropped always: a frame is measured by
// glFinish(), and what a window system does with it afterwards is nobody's work here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::peers {

void set_dry(bool dry);

/// How many draws were passed on or dropped since the program began: none means that the switch
/// is not in the engine's way.
[[nodiscard]] std::uint64_t draws_seen();

/// Waits for the current context's device.
void finish();

/// The current context's back buffer: four bytes a pixel, row 0 on top.
[[nodiscard]] std::vector<std::byte> read_back_buffer(std::uint32_t width, std::uint32_t height);

/// The current context's renderer, as it names itself.
[[nodiscard]] const char* device_name();

}  // namespace gnomon::peers
