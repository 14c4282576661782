// SPDX-License-Identifier: MIT
//
// The little of OpenGL and GLFW that the guides call, so that their blocks compile where neither
// has headers. Declarations alone: nothing is linked.
#pragma once

extern "C" {
void (*glfwGetProcAddress(const char*))();
void glEnable(unsigned);
void glStencilFunc(unsigned, int, unsigned);
void glBlendFunc(unsigned, unsigned);
void glDepthFunc(unsigned);
void glDepthMask(unsigned char);
}
enum : unsigned { GL_FALSE, GL_ONE, GL_BLEND, GL_EQUAL, GL_STENCIL_TEST };
