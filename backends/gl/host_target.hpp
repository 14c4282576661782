// SPDX-License-Identifier: MIT
//
// HostTarget: what a host draws its scene into, for Device::import_texture(). Shadow volumes are
// counted in its stencil against its depth; it and all that is attached to it stay the host's.
#pragma once

#include <cstdint>
#include <optional>

namespace gnomon::gl {

/// The TextureDesc beside it says size, format and samples, which are checked, and has the usage
/// RenderAttachment alone. The format is Depth24UnormStencil8 for depth in normalised integers of
/// any width, Depth32FloatStencil8 for floats. The size is not checked of the window's framebuffer,
/// nor of a framebuffer with a texture other than the two below for depth.
struct HostTarget {
    enum class Kind : std::uint8_t {
        Framebuffer,  ///< with any colour attachments, which are left alone; 0 is the window's
        Texture,      ///< GL_TEXTURE_2D, or GL_TEXTURE_2D_MULTISAMPLE with several samples
        Renderbuffer,
    };
    Kind kind = Kind::Framebuffer;
    std::uint32_t name = 0;
    // What glClipControl() was told when the scene was drawn. Unset: what it was told last before
    // the import, which is right where that is done as the scene is drawn. Each call of gnomon's
    // takes it back to OpenGL's defaults with HostState::Defaults.
    std::optional<bool> clip_zero_to_one = std::nullopt;
    std::optional<bool> clip_upper_left = std::nullopt;
};

}  // namespace gnomon::gl
