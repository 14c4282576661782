// SPDX-License-Identifier: MIT
//
// Every translation of the interface's words into OpenGL's, side by side.
#pragma once

#include <gnomon/gpu/types.hpp>

#include "internal/gl_functions.hpp"

namespace gnomon::gl {

/// How a format is stored, and how its texels travel to and from the host.
struct GlFormat {
    GLenum internal = GL_NONE;
    GLenum transfer_format = GL_NONE;
    GLenum transfer_type = GL_NONE;
};

struct GlVertexFormat {
    GLint components = 0;
    GLenum type = GL_NONE;
    GLboolean normalized = GL_FALSE;
    bool integer = false;
};

[[nodiscard]] GlFormat to_gl(gpu::Format format);
[[nodiscard]] GlVertexFormat to_gl(gpu::VertexFormat format);
[[nodiscard]] GLenum to_gl(gpu::Compare compare);
[[nodiscard]] GLenum to_gl(gpu::StencilOp op);
[[nodiscard]] GLenum to_gl(gpu::PrimitiveTopology topology);
[[nodiscard]] GLenum to_gl(gpu::FrontFace face);
[[nodiscard]] GLenum to_gl(gpu::IndexFormat format);
/// A blend factor of alpha reads the alpha of what WebGPU calls Src, Dst and Constant.
[[nodiscard]] GLenum to_gl(gpu::BlendFactor factor, bool alpha);
[[nodiscard]] GLenum to_gl(gpu::BlendOperation operation);
[[nodiscard]] GLint to_gl(gpu::AddressMode mode);
[[nodiscard]] GLint to_gl(gpu::FilterMode filter);
/// GL has one word for the filter within a level and the one between levels.
[[nodiscard]] GLint minification(gpu::FilterMode within, gpu::FilterMode between);
/// The attachment point of a depth or depth-stencil format.
[[nodiscard]] GLenum depth_stencil_attachment(gpu::Format format);

}  // namespace gnomon::gl
