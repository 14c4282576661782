// SPDX-License-Identifier: MIT
//
// Everything that is decided once, when the backend starts: which functions exist, what the driver
// can do, which stencil path is taken. Nothing asks the driver again, and no call site chooses.
#pragma once

#include <memory>

#include <gnomon/gl/backend.hpp>
#include <gnomon/gpu/caps.hpp>

#include "internal/gl_functions.hpp"
#include "internal/stencil_path.hpp"

namespace gnomon::gl {

struct Adapter {
    GlFunctions gl;
    gpu::Caps caps;
    std::unique_ptr<StencilStrategy> stencil;
    bool debug = false;         ///< KHR_debug is there and was asked for
    bool debug_groups = false;  ///< KHR_debug is there
    // GL's own limits, which WebGPU has no word for
    GLuint texture_units = 0;
    GLuint uniform_buffer_bindings = 0;
    GLuint viewports = 1;
    bool compatibility = false;  ///< the context has what core profiles removed
};

/// The context is current. Fails with ErrorCode::Unsupported and one sentence that names what is
/// missing.
[[nodiscard]] Result<Adapter> open_adapter(const Context& context, const BackendOptions& options);

}  // namespace gnomon::gl
