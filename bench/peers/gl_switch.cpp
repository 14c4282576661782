// SPDX-License-Identifier: MIT
#include "gl_switch.hpp"

#include <algorithm>
#include <span>

#include <dlfcn.h>

#include <GL/gl.h>

namespace gnomon::peers {

namespace {

bool is_dry = false;
std::uint64_t draws = 0;

// The function of that name which the program would have without this file.
template <class F>
F* beyond(const char* name) {
    return reinterpret_cast<F*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

void set_dry(bool dry) { is_dry = dry; }
std::uint64_t draws_seen() { return draws; }
void finish() { ::glFinish(); }

std::vector<std::byte> read_back_buffer(std::uint32_t width, std::uint32_t height) {
    const std::size_t row = 4 * static_cast<std::size_t>(width);
    std::vector<std::byte> pixels(row * height);
    ::glPixelStorei(GL_PACK_ALIGNMENT, 4);
    ::glReadBuffer(GL_BACK);
    ::glReadPixels(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height), GL_RGBA,
                   GL_UNSIGNED_BYTE, pixels.data());
    for (std::size_t y = 0; y < height / 2; ++y) {
        std::ranges::swap_ranges(std::span(pixels).subspan(y * row, row),
                                 std::span(pixels).subspan((height - 1 - y) * row, row));
    }
    for (std::size_t i = 3; i < pixels.size(); i += 4) pixels[i] = std::byte{255};
    return pixels;
}

const char* device_name() { return reinterpret_cast<const char*>(::glGetString(GL_RENDERER)); }

}  // namespace gnomon::peers

// The names are OpenGL's; those who call them were compiled long ago.
extern "C" {

void glDrawElements(GLenum mode, GLsizei count, GLenum type, const GLvoid* indices) {
    static auto* const next = gnomon::peers::beyond<decltype(glDrawElements)>("glDrawElements");
    ++gnomon::peers::draws;
    if (!gnomon::peers::is_dry) next(mode, count, type, indices);
}

void glDrawArrays(GLenum mode, GLint first, GLsizei count) {
    static auto* const next = gnomon::peers::beyond<decltype(glDrawArrays)>("glDrawArrays");
    ++gnomon::peers::draws;
    if (!gnomon::peers::is_dry) next(mode, first, count);
}

void glBegin(GLenum mode) {
    static auto* const next = gnomon::peers::beyond<decltype(glBegin)>("glBegin");
    ++gnomon::peers::draws;
    if (!gnomon::peers::is_dry) next(mode);
}

void glEnd() {
    static auto* const next = gnomon::peers::beyond<decltype(glEnd)>("glEnd");
    if (!gnomon::peers::is_dry) next();
}

void glClear(GLbitfield mask) {
    static auto* const next = gnomon::peers::beyond<decltype(glClear)>("glClear");
    if (!gnomon::peers::is_dry) next(mask);
}

void glXSwapBuffers(void*, unsigned long) {}

}  // extern "C"
