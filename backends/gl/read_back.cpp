// SPDX-License-Identifier: MIT
#include "internal/read_back.hpp"

#include "internal/textures.hpp"

namespace gnomon::gl {
namespace {

GlFormat transfer_of(gpu::Format format, gpu::Aspect aspect) {
    switch (aspect) {
        case gpu::Aspect::DepthOnly: return {GL_NONE, GL_DEPTH_COMPONENT, GL_FLOAT};
        case gpu::Aspect::StencilOnly: return {GL_NONE, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE};
        case gpu::Aspect::Color: break;
    }
    return to_gl(format);
}

}  // namespace

void read_buffer(const GlFunctions& gl, const BufferObject& buffer, std::uint64_t offset,
                 std::span<std::byte> out) {
    gl.BindBuffer(GL_COPY_READ_BUFFER, buffer.name);
    gl.GetBufferSubData(GL_COPY_READ_BUFFER, static_cast<GLintptr>(offset),
                        static_cast<GLsizeiptr>(out.size()), out.data());
}

Status read_texture(const GlFunctions& gl, FramebufferCache& cache, const TextureObject& texture,
                    gpu::Aspect aspect, std::span<std::byte> out) {
    if (Status bound = cache.bind(gl, texture); !bound) return bound;
    const GlFormat format = transfer_of(texture.format, aspect);
    set_tight_pixel_store(gl);
    gl.ReadPixels(0, 0, static_cast<GLsizei>(texture.width), static_cast<GLsizei>(texture.height),
                  format.transfer_format, format.transfer_type, out.data());
    return {};
}

std::vector<std::uint64_t> read_query_set(const GlFunctions& gl, const QuerySetObject& set) {
    std::vector<std::uint64_t> values(set.names.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!set.written[i]) continue;
        GLuint64 value = 0;
        gl.GetQueryObjectui64v(set.names[i], GL_QUERY_RESULT, &value);
        values[i] = value;
    }
    return values;
}

}  // namespace gnomon::gl
