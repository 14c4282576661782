// SPDX-License-Identifier: MIT
//
// How front and back faces get their own stencil state: one strategy per path, each in a file of
// its own, chosen once. All of them give the same bytes; a pipeline for which one of them would
// not is refused when it is made.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include <gnomon/core/result.hpp>
#include <gnomon/gl/backend.hpp>
#include <gnomon/gpu/descriptors.hpp>

#include "internal/gl_functions.hpp"

namespace gnomon::gl {

struct GlStencilFace {
    GLenum compare = GL_ALWAYS;
    GLenum fail = GL_KEEP;
    GLenum depth_fail = GL_KEEP;
    GLenum pass = GL_KEEP;
    bool operator==(const GlStencilFace&) const = default;
};

/// All of the stencil state that a draw depends on.
struct GlStencil {
    bool enabled = false;
    GlStencilFace front;
    GlStencilFace back;
    GLuint read_mask = 0xFF;
    GLuint write_mask = 0xFF;
    GLint reference = 0;
    bool operator==(const GlStencil&) const = default;
};

[[nodiscard]] GlStencil to_gl(const std::optional<gpu::DepthStencilState>& state);

class StencilStrategy {
public:
    virtual ~StencilStrategy() = default;

    [[nodiscard]] virtual std::string_view name() const = 0;
    /// Whether this path gives the pipeline's bytes; ErrorCode::Unsupported says why not.
    [[nodiscard]] virtual Status accepts(const gpu::RenderPipelineDesc& desc) const = 0;
    /// State that holds while a command buffer runs, whatever is drawn.
    virtual void begin(const GlFunctions& gl) const = 0;
    /// Sets the state of the draws that follow.
    virtual void apply(const GlFunctions& gl, const GlStencil& stencil) const = 0;
    /// Calls `issue` as often as one draw with this state takes; leaves the state as apply left it.
    virtual void draw(const GlFunctions& gl, const GlStencil& stencil, GLenum topology,
                      const std::function<void()>& issue) const = 0;
    /// Lets a clear reach every bit of the stencil. The next draw applies its state anew.
    virtual void open_write_mask(const GlFunctions& gl) const = 0;
    /// Gives a host that shares the context GL's defaults back.
    virtual void end(const GlFunctions& gl) const = 0;
};

[[nodiscard]] std::unique_ptr<StencilStrategy> make_separate_strategy();
[[nodiscard]] std::unique_ptr<StencilStrategy> make_two_side_strategy();
[[nodiscard]] std::unique_ptr<StencilStrategy> make_two_pass_strategy();
[[nodiscard]] std::unique_ptr<StencilStrategy> make_stencil_strategy(StencilPath path);

}  // namespace gnomon::gl
