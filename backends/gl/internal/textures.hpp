// SPDX-License-Identifier: MIT
//
// Textures: immutable storage, zero contents, uploads.
#pragma once

#include <cstddef>
#include <span>

#include "internal/adapter.hpp"
#include "internal/framebuffer_cache.hpp"
#include "internal/objects.hpp"

namespace gnomon::gl {

/// All texels are zero afterwards. A failure leaves nothing behind.
[[nodiscard]] Result<TextureObject> make_texture(const Adapter& adapter, FramebufferCache& cache,
                                                 const gpu::TextureDesc& desc);
/// Those that it is attached to: before its name goes, and when a host's comes.
void forget_framebuffers(const GlFunctions& gl, FramebufferCache& cache,
                         const TextureObject& texture);
void delete_texture(const GlFunctions& gl, FramebufferCache& cache, const TextureObject& texture);

void upload(const GlFunctions& gl, const TextureObject& texture, std::uint32_t mip_level,
            std::span<const std::byte> texels);

/// Rows without padding and nothing skipped, whatever a host that shares the context has set.
void set_tight_pixel_store(const GlFunctions& gl);

/// Sets all that a clear depends on so that it reaches every pixel, bit and channel.
void open_for_clear(const Adapter& adapter);

}  // namespace gnomon::gl
