// SPDX-License-Identifier: MIT
//
// Framebuffer objects by what is attached to them. GL wants one per combination; WebGPU has none.
#pragma once

#include <map>
#include <span>
#include <vector>

#include <gnomon/core/result.hpp>

#include "internal/objects.hpp"

namespace gnomon::gl {

/// Names of textures and the mip level that is drawn to; 0 names nothing.
struct FramebufferKey {
    std::vector<GLuint> colors;
    GLuint depth_stencil = 0;
    GLint level = 0;
    HostDepthStencil host = {};  ///< in place of depth_stencil
    auto operator<=>(const FramebufferKey&) const = default;
};

class FramebufferCache {
public:
    /// Finds or makes the framebuffer and binds it to GL_FRAMEBUFFER. All textures have one target
    /// (WebGPU: attachments share the sample count). `label` names what it is for.
    [[nodiscard]] Status bind(const GlFunctions& gl, const FramebufferKey& key, GLenum target,
                              gpu::Format depth_stencil_format, const std::string& label);
    /// Of one texture alone, for clears, read-back and blits.
    [[nodiscard]] Status bind(const GlFunctions& gl, const TextureObject& texture, GLint level = 0);
    /// Binds one texture alone to GL_READ_FRAMEBUFFER and leaves the one drawn to as it is.
    [[nodiscard]] Status bind_for_reading(const GlFunctions& gl, const TextureObject& texture);

    /// Must run before the texture's name is deleted, since GL hands names out again.
    void forget_texture(const GlFunctions& gl, GLuint texture);
    /// The same for what a host has for depth and stencil.
    void forget_host(const GlFunctions& gl, const HostDepthStencil& host);
    void clear(const GlFunctions& gl);

private:
    [[nodiscard]] Result<GLuint> find_or_make(const GlFunctions& gl, const FramebufferKey& key,
                                              GLenum target, gpu::Format depth_stencil_format,
                                              const std::string& label);

    template <class Predicate>
    void forget(const GlFunctions& gl, const Predicate& uses_it);

    std::map<FramebufferKey, GLuint> framebuffers_;
};

}  // namespace gnomon::gl
