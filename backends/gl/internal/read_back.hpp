// SPDX-License-Identifier: MIT
//
// From the GPU to the host. All of it blocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "internal/adapter.hpp"
#include "internal/framebuffer_cache.hpp"
#include "internal/objects.hpp"

namespace gnomon::gl {

void read_buffer(const GlFunctions& gl, const BufferObject& buffer, std::uint64_t offset,
                 std::span<std::byte> out);
/// Rows come as they lie in the texture: row 0 on top, since everything was drawn that way.
[[nodiscard]] Status read_texture(const GlFunctions& gl, FramebufferCache& cache,
                                  const TextureObject& texture, gpu::Aspect aspect,
                                  std::span<std::byte> out);
[[nodiscard]] std::vector<std::uint64_t> read_query_set(const GlFunctions& gl,
                                                        const QuerySetObject& set);

}  // namespace gnomon::gl
