// SPDX-License-Identifier: MIT
//
// A texture onto the window of the context. The one place where rows are turned over: a window's
// row 0 is at the bottom.
#pragma once

#include <gnomon/gl/context.hpp>

#include "internal/framebuffer_cache.hpp"
#include "internal/objects.hpp"

namespace gnomon::gl {

[[nodiscard]] Status present(const GlFunctions& gl, FramebufferCache& cache, Context& context,
                             const TextureObject& texture);

}  // namespace gnomon::gl
