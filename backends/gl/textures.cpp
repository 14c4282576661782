// SPDX-License-Identifier: MIT
#include "internal/textures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>

#include "internal/debug_output.hpp"

namespace gnomon::gl {
namespace {

void set_texture_parameters(const GlFunctions& gl, GLenum target) {
    // Without a sampler object a texture is only fetched; its own filters must then not make it
    // incomplete, which linear ones do for integers. Multisample textures have no such state.
    if (target == GL_TEXTURE_2D_MULTISAMPLE) return;
    gl.TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
    gl.TexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void allocate(const GlFunctions& gl, TextureObject& texture, const gpu::TextureDesc& desc) {
    const GLenum internal = to_gl(desc.format).internal;
    const auto width = static_cast<GLsizei>(desc.width);
    const auto height = static_cast<GLsizei>(desc.height);
    gl.GenTextures(1, &texture.name);
    gl.BindTexture(texture.target, texture.name);
    if (texture.target == GL_TEXTURE_2D_MULTISAMPLE) {
        gl.TexStorage2DMultisample(texture.target, static_cast<GLsizei>(desc.sample_count),
                                   internal, width, height, GL_TRUE);
    } else {
        gl.TexStorage2D(texture.target, static_cast<GLsizei>(desc.mip_level_count), internal, width,
                        height);
    }
    set_texture_parameters(gl, texture.target);
}

void make_stencil_view(const GlFunctions& gl, TextureObject& texture,
                       const gpu::TextureDesc& desc) {
    gl.GenTextures(1, &texture.stencil_view);
    gl.TextureView(texture.stencil_view, texture.target, texture.name, to_gl(desc.format).internal,
                   0, desc.mip_level_count, 0, 1);
    gl.BindTexture(texture.target, texture.stencil_view);
    gl.TexParameteri(texture.target, GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX);
    set_texture_parameters(gl, texture.target);
}

void clear_bound_framebuffer(const GlFunctions& gl, gpu::Format format) {
    if (gpu::is_uint(format)) {
        constexpr std::array<GLuint, 4> zero{};
        gl.ClearBufferuiv(GL_COLOR, 0, zero.data());
    } else if (gpu::has_color(format)) {
        constexpr std::array<GLfloat, 4> zero{};
        gl.ClearBufferfv(GL_COLOR, 0, zero.data());
    } else if (gpu::has_stencil(format)) {
        gl.ClearBufferfi(GL_DEPTH_STENCIL, 0, 0.0F, 0);
    } else {
        constexpr GLfloat zero = 0.0F;
        gl.ClearBufferfv(GL_DEPTH, 0, &zero);
    }
}

Status clear_to_zero(const Adapter& adapter, FramebufferCache& cache, const TextureObject& texture,
                     std::uint32_t mip_level_count) {
    open_for_clear(adapter);
    for (std::uint32_t level = 0; level < mip_level_count; ++level) {
        if (const Status bound = cache.bind(adapter.gl, texture, static_cast<GLint>(level));
            !bound) {
            return bound;
        }
        clear_bound_framebuffer(adapter.gl, texture.format);
    }
    return {};
}

}  // namespace

Result<TextureObject> make_texture(const Adapter& adapter, FramebufferCache& cache,
                                   const gpu::TextureDesc& desc) {
    const GlFunctions& gl = adapter.gl;
    const std::string action = fmt::format("Creating [Texture \"{}\"] of {} x {} pixels",
                                           desc.label, desc.width, desc.height);
    TextureObject texture{
        .label = desc.label,
        .target = desc.sample_count > 1 ? GLenum{GL_TEXTURE_2D_MULTISAMPLE} : GLenum{GL_TEXTURE_2D},
        .format = desc.format,
        .width = desc.width,
        .height = desc.height};
    allocate(gl, texture, desc);
    Status made = check_errors(gl, action);
    if (made) made = clear_to_zero(adapter, cache, texture, desc.mip_level_count);
    if (made && gpu::has_stencil(desc.format) && adapter.caps.features.sampled_stencil &&
        gpu::has(desc.usage, gpu::TextureUsage::TextureBinding)) {
        make_stencil_view(gl, texture, desc);
    }
    if (made) made = check_errors(gl, action);
    if (!made) {
        delete_texture(gl, cache, texture);
        return forward_error(made);
    }
    if (adapter.debug) set_label(gl, GL_TEXTURE, texture.name, desc.label);
    return texture;
}

void forget_framebuffers(const GlFunctions& gl, FramebufferCache& cache,
                         const TextureObject& texture) {
    if (!texture.host) {
        cache.forget_texture(gl, texture.name);
    } else if (texture.host->attached) {
        cache.forget_host(gl, *texture.host->attached);
    }
}

void delete_texture(const GlFunctions& gl, FramebufferCache& cache, const TextureObject& texture) {
    forget_framebuffers(gl, cache, texture);
    if (texture.host && texture.host->owned) gl.DeleteFramebuffers(1, &texture.host->name);
    if (texture.host || texture.borrowed) return;
    if (texture.stencil_view != 0) gl.DeleteTextures(1, &texture.stencil_view);
    gl.DeleteTextures(1, &texture.name);
}

void upload(const GlFunctions& gl, const TextureObject& texture, std::uint32_t mip_level,
            std::span<const std::byte> texels) {
    const GlFormat format = to_gl(texture.format);
    set_tight_pixel_store(gl);
    gl.BindTexture(texture.target, texture.name);
    gl.TexSubImage2D(texture.target, static_cast<GLint>(mip_level), 0, 0,
                     static_cast<GLsizei>(std::max(texture.width >> mip_level, 1U)),
                     static_cast<GLsizei>(std::max(texture.height >> mip_level, 1U)),
                     format.transfer_format, format.transfer_type, texels.data());
}

void set_tight_pixel_store(const GlFunctions& gl) {
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (const GLenum alignment :
         std::initializer_list<GLenum>{GL_UNPACK_ALIGNMENT, GL_PACK_ALIGNMENT}) {
        gl.PixelStorei(alignment, 1);
    }
    for (const GLenum off : std::initializer_list<GLenum>{
             GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SWAP_BYTES,
             GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_SWAP_BYTES}) {
        gl.PixelStorei(off, 0);
    }
}

void open_for_clear(const Adapter& adapter) {
    const GlFunctions& gl = adapter.gl;
    gl.Disable(GL_SCISSOR_TEST);
    gl.Disable(GL_RASTERIZER_DISCARD);
    gl.Enable(GL_FRAMEBUFFER_SRGB);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_TRUE);
    adapter.stencil->open_write_mask(gl);
}

}  // namespace gnomon::gl
