// SPDX-License-Identifier: MIT
//
// gnomon::gl: the GPU interface on OpenGL 4.3 with clip control (4.5, or ARB_clip_control).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gl/context.hpp>
#include <gnomon/gpu/backend.hpp>
#include <gnomon/gpu/message_sink.hpp>

#pragma GCC visibility push(default)
namespace gnomon::gl {

/// How front and back faces get their own stencil operations. All three give the same bytes.
enum class StencilPath {
    TwoSide,   ///< EXT_stencil_two_side and EXT_stencil_wrap; compatibility contexts only
    Separate,  ///< glStencilOpSeparate, OpenGL 2.0
    TwoPass,   ///< one draw per face, by culling
};

/// What a backend is made with.
struct BackendOptions {
    std::optional<StencilPath> stencil_path =
        std::nullopt;  ///< chosen once; default: Separate, else what there is
    std::vector<std::string> disabled_extensions =
        {};  ///< treated as absent, for tests of fallbacks
    /// KHR_debug, synchronous. Refused for a context that was adopted, whose callback is the
    /// host's.
    bool debug = false;
    gpu::MessageSink message_sink = {};  ///< gets what the driver says; empty: it is lost
};

/// Takes the context. Fails with ErrorCode::Unsupported, naming what is missing.
[[nodiscard]] Result<std::unique_ptr<gpu::Backend>> create_backend(
    std::unique_ptr<Context> context, const BackendOptions& options = {});

}  // namespace gnomon::gl
#pragma GCC visibility pop
