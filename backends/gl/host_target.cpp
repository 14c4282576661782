// SPDX-License-Identifier: MIT
#include "internal/host_target.hpp"

#include <optional>

#include <fmt/format.h>

#include "internal/conv.hpp"
#include "internal/debug_output.hpp"

namespace gnomon::gl {
namespace {

const char* word_of(HostTarget::Kind kind) {
    switch (kind) {
        case HostTarget::Kind::Texture: return "texture";
        case HostTarget::Kind::Renderbuffer: return "renderbuffer";
        case HostTarget::Kind::Framebuffer: break;
    }
    return "framebuffer";
}

std::string name_of(const gpu::TextureDesc& desc, const HostTarget& host) {
    return fmt::format("[Texture \"{}\"], the host's {} {},", desc.label, word_of(host.kind),
                       host.name);
}

struct Size {
    GLint width = 0;
    GLint height = 0;
};

// A framebuffer of ours about a texture or renderbuffer of the host's. Bound afterwards.
GLuint wrap(const GlFunctions& gl, const HostTarget& host, GLenum target, Size& size) {
    GLuint framebuffer = 0;
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    if (host.kind == HostTarget::Kind::Texture) {
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, target, host.name, 0);
        gl.BindTexture(target, host.name);
        gl.GetTexLevelParameteriv(target, 0, GL_TEXTURE_WIDTH, &size.width);
        gl.GetTexLevelParameteriv(target, 0, GL_TEXTURE_HEIGHT, &size.height);
    } else {
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                                   host.name);
        gl.BindRenderbuffer(GL_RENDERBUFFER, host.name);
        gl.GetRenderbufferParameteriv(GL_RENDERBUFFER, GL_RENDERBUFFER_WIDTH, &size.width);
        gl.GetRenderbufferParameteriv(GL_RENDERBUFFER, GL_RENDERBUFFER_HEIGHT, &size.height);
    }
    const GLenum none = GL_NONE;
    gl.DrawBuffers(1, &none);
    gl.ReadBuffer(GL_NONE);
    return framebuffer;
}

GLint attachment_value(const GlFunctions& gl, GLenum attachment, GLenum what) {
    GLint type = GL_NONE;
    gl.GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment,
                                           GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &type);
    if (type == GL_NONE) return 0;
    GLint value = 0;
    gl.GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment, what, &value);
    return value;
}

GLint ask_attachment(const GlFunctions& gl, GLenum attachment, GLenum what) {
    GLint value = 0;
    gl.GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment, what, &value);
    return value;
}

// Of the framebuffer that is bound; nothing where there is none.
std::optional<HostDepthStencil> attached_at(const GlFunctions& gl, GLenum attachment) {
    const GLint type = ask_attachment(gl, attachment, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE);
    if (type != GL_RENDERBUFFER && type != GL_TEXTURE) return std::nullopt;
    const auto name =
        static_cast<GLuint>(ask_attachment(gl, attachment, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME));
    if (type == GL_RENDERBUFFER) return HostDepthStencil{.renderbuffer = name};
    return HostDepthStencil{
        .texture = name,
        .level = ask_attachment(gl, attachment, GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_LEVEL)};
}

bool has_fixed_samples(const GlFunctions& gl, GLenum target, GLint level) {
    if (target != GL_TEXTURE_2D_MULTISAMPLE) return true;
    GLint fixed = GL_TRUE;
    gl.GetTexLevelParameteriv(target, level, GL_TEXTURE_FIXED_SAMPLE_LOCATIONS, &fixed);
    return fixed != GL_FALSE;
}

// What a framebuffer object has for depth and its size; the former is bound afterwards. Left alone
// where it cannot be asked by these targets.
void look_at(const GlFunctions& gl, GLenum target, Size& size, HostFramebuffer& host) {
    const auto depth = attached_at(gl, GL_DEPTH_ATTACHMENT);
    if (!depth) return;
    Size measured;
    if (depth->renderbuffer != 0) {
        gl.BindRenderbuffer(GL_RENDERBUFFER, depth->renderbuffer);
        gl.GetRenderbufferParameteriv(GL_RENDERBUFFER, GL_RENDERBUFFER_WIDTH, &measured.width);
        gl.GetRenderbufferParameteriv(GL_RENDERBUFFER, GL_RENDERBUFFER_HEIGHT, &measured.height);
    } else {
        drop_errors(gl);
        gl.BindTexture(target, depth->texture);
        if (gl.GetError() != GL_NO_ERROR) return;  // of another target
        gl.GetTexLevelParameteriv(target, depth->level, GL_TEXTURE_WIDTH, &measured.width);
        gl.GetTexLevelParameteriv(target, depth->level, GL_TEXTURE_HEIGHT, &measured.height);
        host.fixed_samples = has_fixed_samples(gl, target, depth->level);
    }
    size = measured;
    if (attached_at(gl, GL_STENCIL_ATTACHMENT) == depth) host.attached = depth;
}

// What glClipControl() was told, where the host does not say.
HostFramebuffer drawn_as(const GlFunctions& gl, const HostTarget& host) {
    GLint origin = GL_LOWER_LEFT;
    GLint depth = GL_NEGATIVE_ONE_TO_ONE;
    gl.GetIntegerv(GL_CLIP_ORIGIN, &origin);
    gl.GetIntegerv(GL_CLIP_DEPTH_MODE, &depth);
    const bool zero_to_one = host.clip_zero_to_one.value_or(depth == GL_ZERO_TO_ONE);
    return {.name = host.name,
            .owned = host.kind != HostTarget::Kind::Framebuffer,
            .upper_left = host.clip_upper_left.value_or(origin == GL_UPPER_LEFT),
            .clip_depth = zero_to_one ? GLenum{GL_ZERO_TO_ONE} : GLenum{GL_NEGATIVE_ONE_TO_ONE}};
}

Status check_samples(const gpu::TextureDesc& desc, const HostTarget& host, GLint samples) {
    samples = samples > 1 ? samples : 1;
    if (static_cast<std::uint32_t>(samples) == desc.sample_count) return {};
    return fail(ErrorCode::InvalidInput,
                fmt::format("{} has {} samples a pixel, not {}.", name_of(desc, host), samples,
                            desc.sample_count));
}

// The framebuffer is bound.
Status check_bits(const GlFunctions& gl, const gpu::TextureDesc& desc, const HostTarget& host,
                  bool is_window) {
    const GLenum depth = is_window ? GL_DEPTH : GL_DEPTH_ATTACHMENT;
    const GLenum stencil = is_window ? GL_STENCIL : GL_STENCIL_ATTACHMENT;
    const GLint stencil_bits =
        attachment_value(gl, stencil, GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE);
    if (stencil_bits < 8) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("{} has {} stencil bits, but shadows are counted in 8: {}.",
                                name_of(desc, host), stencil_bits,
                                is_window ? "ask for 8 when the window is made (GLFW_STENCIL_BITS)"
                                          : "attach depth and stencil of GL_DEPTH24_STENCIL8 or "
                                            "GL_DEPTH32F_STENCIL8"));
    }
    const GLint depth_bits = attachment_value(gl, depth, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE);
    if (depth_bits == 0) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("{} has no depth buffer, against which shadow volumes are held: "
                                "attach the one that the scene was drawn with.",
                                name_of(desc, host)));
    }
    const bool is_float =
        attachment_value(gl, depth, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == GL_FLOAT;
    if (is_float != (desc.format == gpu::Format::Depth32FloatStencil8)) {
        return fail(
            ErrorCode::InvalidInput,
            fmt::format("{} has depth in {} of {} bits, which is {}, not what was said.",
                        name_of(desc, host), is_float ? "floats" : "normalised integers",
                        depth_bits, is_float ? "Depth32FloatStencil8" : "Depth24UnormStencil8"));
    }
    GLint samples = 0;
    gl.GetIntegerv(GL_SAMPLES, &samples);
    return check_samples(desc, host, samples);
}

TextureObject described(const gpu::TextureDesc& desc) {
    return {
        .label = desc.label,
        .target = desc.sample_count > 1 ? GLenum{GL_TEXTURE_2D_MULTISAMPLE} : GLenum{GL_TEXTURE_2D},
        .format = desc.format,
        .width = desc.width,
        .height = desc.height};
}

Status check_size(const gpu::TextureDesc& desc, const HostTarget& host, const Size& size) {
    if (size.width == static_cast<GLint>(desc.width) &&
        size.height == static_cast<GLint>(desc.height)) {
        return {};
    }
    return fail(ErrorCode::InvalidInput,
                fmt::format("{} has {} x {} pixels, not {} x {}.", name_of(desc, host), size.width,
                            size.height, desc.width, desc.height));
}

// The framebuffer is bound.
Status check_framebuffer(const GlFunctions& gl, const gpu::TextureDesc& desc,
                         const HostTarget& host, bool is_window) {
    // Of a framebuffer that is not complete nothing but its attachments can be asked.
    if (const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
        status != GL_FRAMEBUFFER_COMPLETE) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("{} cannot be drawn to as depth and stencil (framebuffer status "
                                "0x{:04X}): complete it first, with depth and stencil of "
                                "GL_DEPTH24_STENCIL8 or GL_DEPTH32F_STENCIL8.",
                                name_of(desc, host), status));
    }
    return check_bits(gl, desc, host, is_window);
}

Result<TextureObject> import_depth_stencil(const GlFunctions& gl, const gpu::TextureDesc& desc,
                                           const HostTarget& host) {
    TextureObject texture = described(desc);
    texture.host = drawn_as(gl, host);
    Size size{static_cast<GLint>(desc.width), static_cast<GLint>(desc.height)};
    const bool is_framebuffer = host.kind == HostTarget::Kind::Framebuffer;
    if (is_framebuffer) {
        gl.BindFramebuffer(GL_FRAMEBUFFER, host.name);
    } else {
        texture.host->name = wrap(gl, host, texture.target, size);
        texture.host->attached = host.kind == HostTarget::Kind::Texture
                                     ? HostDepthStencil{.texture = host.name}
                                     : HostDepthStencil{.renderbuffer = host.name};
    }
    Status usable = check_errors(gl, fmt::format("Importing {}", name_of(desc, host)));
    const bool is_window = is_framebuffer && host.name == 0;
    if (usable) usable = check_framebuffer(gl, desc, host, is_window);
    if (usable && is_framebuffer && !is_window) look_at(gl, texture.target, size, *texture.host);
    if (usable) usable = check_size(desc, host, size);
    if (usable && host.kind == HostTarget::Kind::Texture) {
        texture.host->fixed_samples = has_fixed_samples(gl, texture.target, 0);
    }
    if (!usable) {
        if (texture.host->owned) gl.DeleteFramebuffers(1, &texture.host->name);
        return forward_error(usable);
    }
    return texture;
}

Result<TextureObject> import_color(const GlFunctions& gl, const gpu::TextureDesc& desc,
                                   const HostTarget& host) {
    if (host.kind != HostTarget::Kind::Texture) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("{} cannot be drawn to as colour: give a texture of the host's "
                                "(HostTarget::Kind::Texture).",
                                name_of(desc, host)));
    }
    if (gl.IsTexture(host.name) == GL_FALSE) {  // which compatibility contexts would make one
        return fail(ErrorCode::InvalidInput, fmt::format("{} is none.", name_of(desc, host)));
    }
    TextureObject texture = described(desc);
    texture.name = host.name;
    texture.borrowed = true;
    gl.BindTexture(texture.target, host.name);
    const Status bound = check_errors(gl, fmt::format("Importing {} as a 2D texture of {} samples",
                                                      name_of(desc, host), desc.sample_count));
    if (!bound) return fail(ErrorCode::InvalidInput, bound.error().message);
    const auto level = [&](GLenum what) {
        GLint value = 0;
        gl.GetTexLevelParameteriv(texture.target, 0, what, &value);
        return value;
    };
    const auto format = static_cast<GLenum>(level(GL_TEXTURE_INTERNAL_FORMAT));
    if (const GLenum wanted = to_gl(desc.format).internal; format != wanted) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{} has the internal format 0x{:04X}, not 0x{:04X}, which the "
                                "format that was said is.",
                                name_of(desc, host), format, wanted));
    }
    const Size size{level(GL_TEXTURE_WIDTH), level(GL_TEXTURE_HEIGHT)};
    if (const Status fits = check_size(desc, host, size); !fits) return forward_error(fits);
    if (const Status fits = check_samples(desc, host, level(GL_TEXTURE_SAMPLES)); !fits) {
        return forward_error(fits);
    }
    if (!has_fixed_samples(gl, texture.target, 0)) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{} has its samples anywhere, not where the depth beside it has "
                                "them: make it with fixedsamplelocations GL_TRUE.",
                                name_of(desc, host)));
    }
    return texture;
}

}  // namespace

Result<TextureObject> import_host_target(const Adapter& adapter, const gpu::TextureDesc& desc,
                                         const HostTarget& host) {
    const bool is_color = gpu::has_color(desc.format);
    if ((!is_color && !gpu::has_stencil(desc.format)) ||
        desc.usage != gpu::TextureUsage::RenderAttachment) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("{} can only be of a depth-stencil or colour format, with the "
                                "usage RenderAttachment and no other.",
                                name_of(desc, host)));
    }
    if (desc.mip_level_count != 1) {
        return fail(ErrorCode::Unsupported, fmt::format("{} can only have 1 mip level, not {}.",
                                                        name_of(desc, host), desc.mip_level_count));
    }
    if (host.kind != HostTarget::Kind::Framebuffer && host.name == 0) {
        return fail(ErrorCode::InvalidInput, fmt::format("{} is none: 0 names no {}.",
                                                         name_of(desc, host), word_of(host.kind)));
    }
    drop_errors(adapter.gl);  // of the host's
    return is_color ? import_color(adapter.gl, desc, host)
                    : import_depth_stencil(adapter.gl, desc, host);
}

Status takes_colors_beside(const TextureObject& texture) {
    if (!texture.host) return {};
    if (!texture.host->attached) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("[Texture \"{}\"] takes no colours beside it, such as light masks: "
                                "it is the depth and stencil of a framebuffer that has them in no "
                                "one 2D texture or renderbuffer of the host's, such as the "
                                "window's: draw the scene into a framebuffer that has.",
                                texture.label));
    }
    if (!texture.host->fixed_samples) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("[Texture \"{}\"] takes no colours beside it, such as light masks: "
                                "the host's depth has its samples anywhere, while those of masks "
                                "have fixed places: make it with fixedsamplelocations GL_TRUE.",
                                texture.label));
    }
    return {};
}

Status check_still_attached(const GlFunctions& gl, const TextureObject& texture) {
    gl.BindFramebuffer(GL_FRAMEBUFFER, texture.host->name);
    const auto& then = texture.host->attached;
    if (attached_at(gl, GL_DEPTH_ATTACHMENT) == then &&
        attached_at(gl, GL_STENCIL_ATTACHMENT) == then) {
        return {};
    }
    return fail(ErrorCode::InvalidInput,
                fmt::format("[Texture \"{}\"], the host's framebuffer {}, has another depth or "
                            "stencil than when it was imported: import it again after they are "
                            "attached, and make the light masks again.",
                            texture.label, texture.host->name));
}

}  // namespace gnomon::gl
