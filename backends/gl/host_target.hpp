// SPDX-License-Identifier: MIT
//
// HostTarget: what a host draws into, for Device::import_texture(). Its depth and stencil, in which
// shadow volumes are counted, or a texture that light masks go to; it and all that is attached to
// it stay the host's.
#pragma once

#include <cstdint>
#include <optional>

#pragma GCC visibility push(default)
namespace gnomon::gl {

/// The TextureDesc beside it says size, format and samples, which are checked, and has the usage
/// RenderAttachment alone. For depth and stencil the format is Depth24UnormStencil8 with depth in
/// normalised integers of any width, Depth32FloatStencil8 with floats. The size is not checked of
/// the window's framebuffer, nor of a framebuffer with a texture other than the two below for
/// depth; with these, and where depth and stencil are not one object or have four samples at
/// places that are not fixed (fixedsamplelocations GL_FALSE), there are no light masks. A colour
/// format names a Texture of just that internal format, with row 0 where the framebuffer has it
/// that the scene is drawn into.
struct HostTarget {
    /// What the name names.
    enum class Kind : std::uint8_t {
        /// With any colour attachments, which are left alone; 0 is the window's. Light masks go
        /// beside the depth and stencil that it has when it is imported: they refuse it when it has
        /// others, until it is imported again.
        Framebuffer,
        Texture,       ///< GL_TEXTURE_2D, or GL_TEXTURE_2D_MULTISAMPLE with several samples
        Renderbuffer,  ///< of glGenRenderbuffers
    };
    Kind kind = Kind::Framebuffer;  ///< what `name` names
    std::uint32_t name = 0;         ///< as OpenGL gave it
    /// What glClipControl() was told of depth when the scene was drawn. Unset: what it was told
    /// last before the import, which is right where that is done as the scene is drawn. Each call
    /// of gnomon's takes it back to OpenGL's defaults with HostState::Defaults.
    std::optional<bool> clip_zero_to_one = std::nullopt;
    /// The same of the origin.
    std::optional<bool> clip_upper_left = std::nullopt;
};

}  // namespace gnomon::gl
#pragma GCC visibility pop
