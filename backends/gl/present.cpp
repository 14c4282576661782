// SPDX-License-Identifier: MIT
#include "internal/present.hpp"

#include <fmt/format.h>

namespace gnomon::gl {

Status present(const GlFunctions& gl, FramebufferCache& cache, Context& context,
               const TextureObject& texture) {
    const auto window = context.window_size();
    if (!window) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("[Texture \"{}\"] cannot be presented: this OpenGL context ({}) "
                                "has no window.",
                                texture.label, context.description()));
    }
    // A minimised window has no pixels, and nothing is wrong with that.
    if (window->width == 0 || window->height == 0) return context.swap_buffers();

    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    if (const Status bound = cache.bind_for_reading(gl, texture); !bound) return bound;
    gl.Disable(GL_SCISSOR_TEST);
    // The stored bytes are what the screen shows: no conversion in either direction.
    gl.Disable(GL_FRAMEBUFFER_SRGB);
    const auto width = static_cast<GLint>(texture.width);
    const auto height = static_cast<GLint>(texture.height);
    const auto window_width = static_cast<GLint>(window->width);
    const auto window_height = static_cast<GLint>(window->height);
    const bool same_size = width == window_width && height == window_height;
    gl.BlitFramebuffer(0, 0, width, height, 0, window_height, window_width, 0, GL_COLOR_BUFFER_BIT,
                       same_size ? GL_NEAREST : GL_LINEAR);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    return context.swap_buffers();
}

}  // namespace gnomon::gl
