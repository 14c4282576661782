// SPDX-License-Identifier: MIT
#pragma once

#include <gnomon/gl/host_target.hpp>

#include "internal/adapter.hpp"
#include "internal/objects.hpp"

namespace gnomon::gl {

/// Looks at what the host has there; ErrorCode::Unsupported where shadows cannot be counted in it,
/// InvalidInput where `desc` says something else than GL.
[[nodiscard]] Result<TextureObject> import_host_target(const Adapter& adapter,
                                                       const gpu::TextureDesc& desc,
                                                       const HostTarget& host);

/// gpu::Backend::takes_colors_beside().
[[nodiscard]] Status takes_colors_beside(const TextureObject& texture);

/// That a framebuffer of the host's still has for depth and stencil what it had when it was
/// imported, which is what is attached to framebuffers of ours. It is bound afterwards.
[[nodiscard]] Status check_still_attached(const GlFunctions& gl, const TextureObject& texture);

}  // namespace gnomon::gl
