// SPDX-License-Identifier: MIT
#include "internal/framebuffer_cache.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::gl {
namespace {

FramebufferKey key_of(const TextureObject& texture, GLint level) {
    FramebufferKey key;
    key.level = level;
    if (gpu::has_color(texture.format)) {
        key.colors = {texture.name};
    } else {
        key.depth_stencil = texture.name;
    }
    return key;
}

}  // namespace

Result<GLuint> FramebufferCache::find_or_make(const GlFunctions& gl, const FramebufferKey& key,
                                              GLenum target, gpu::Format depth_stencil_format,
                                              const std::string& label) {
    if (const auto found = framebuffers_.find(key); found != framebuffers_.end()) {
        return found->second;
    }
    GLuint name = 0;
    gl.GenFramebuffers(1, &name);
    gl.BindFramebuffer(GL_FRAMEBUFFER, name);
    std::vector<GLenum> draw_buffers;
    for (std::size_t i = 0; i < key.colors.size(); ++i) {
        const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
        if (key.colors[i] != 0) {
            gl.FramebufferTexture2D(GL_FRAMEBUFFER, attachment, target, key.colors[i], key.level);
        }
        draw_buffers.push_back(key.colors[i] != 0 ? attachment : GLenum{GL_NONE});
    }
    if (key.depth_stencil != 0) {
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, depth_stencil_attachment(depth_stencil_format),
                                target, key.depth_stencil, key.level);
    }
    if (key.host.renderbuffer != 0) {
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                                   key.host.renderbuffer);
    } else if (key.host.texture != 0) {
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, target,
                                key.host.texture, key.host.level);
    }
    if (draw_buffers.empty()) draw_buffers.push_back(GL_NONE);
    gl.DrawBuffers(static_cast<GLsizei>(draw_buffers.size()), draw_buffers.data());
    gl.ReadBuffer(draw_buffers.front());

    if (const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
        status != GL_FRAMEBUFFER_COMPLETE) {
        gl.DeleteFramebuffers(1, &name);
        return fail(ErrorCode::Unsupported,
                    fmt::format("The OpenGL driver cannot draw to the attachments of {} "
                                "(framebuffer status 0x{:04X}).",
                                label, status));
    }
    framebuffers_.emplace(key, name);
    return name;
}

Status FramebufferCache::bind(const GlFunctions& gl, const FramebufferKey& key, GLenum target,
                              gpu::Format depth_stencil_format, const std::string& label) {
    const auto name = find_or_make(gl, key, target, depth_stencil_format, label);
    if (!name) return forward_error(name);
    gl.BindFramebuffer(GL_FRAMEBUFFER, *name);
    return {};
}

Status FramebufferCache::bind(const GlFunctions& gl, const TextureObject& texture, GLint level) {
    return bind(gl, key_of(texture, level), texture.target, texture.format,
                fmt::format("[Texture \"{}\"]", texture.label));
}

Status FramebufferCache::bind_for_reading(const GlFunctions& gl, const TextureObject& texture) {
    GLint drawn_to = 0;
    gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &drawn_to);
    const auto name = find_or_make(gl, key_of(texture, 0), texture.target, texture.format,
                                   fmt::format("[Texture \"{}\"]", texture.label));
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(drawn_to));
    if (!name) return forward_error(name);
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, *name);
    return {};
}

template <class Predicate>
void FramebufferCache::forget(const GlFunctions& gl, const Predicate& uses_it) {
    for (auto entry = framebuffers_.begin(); entry != framebuffers_.end();) {
        if (uses_it(entry->first)) {
            gl.DeleteFramebuffers(1, &entry->second);
            entry = framebuffers_.erase(entry);
        } else {
            ++entry;
        }
    }
}

void FramebufferCache::forget_texture(const GlFunctions& gl, GLuint texture) {
    forget(gl, [texture](const FramebufferKey& key) {
        return key.depth_stencil == texture ||
               std::find(key.colors.begin(), key.colors.end(), texture) != key.colors.end();
    });
}

void FramebufferCache::forget_host(const GlFunctions& gl, const HostDepthStencil& host) {
    forget(gl, [&host](const FramebufferKey& key) { return key.host == host; });
}

void FramebufferCache::clear(const GlFunctions& gl) {
    for (const auto& [key, name] : framebuffers_) gl.DeleteFramebuffers(1, &name);
    framebuffers_.clear();
}

}  // namespace gnomon::gl
