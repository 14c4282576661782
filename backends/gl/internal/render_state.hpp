// SPDX-License-Identifier: MIT
//
// RenderState: GL's state while one command buffer runs. It remembers what was set, so that a call
// that would change nothing is not made. It trusts nothing from before begin(), since a host may
// share the context, and gives GL's defaults back in end().
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <gnomon/gpu/command.hpp>

#include "internal/adapter.hpp"
#include "internal/objects.hpp"

namespace gnomon::gl {

/// A piece of state that is known or not.
template <class T>
class Remembered {
public:
    /// True when `value` is not what is set: the caller sets it now.
    [[nodiscard]] bool change(const T& value) {
        if (value_ == value) return false;
        value_ = value;
        return true;
    }
    void forget() { value_.reset(); }
    [[nodiscard]] const std::optional<T>& value() const { return value_; }

private:
    std::optional<T> value_;
};

class RenderState {
public:
    RenderState(const Adapter& adapter, GLuint vertex_array);

    void begin();
    void end();

    /// Clip space and provoking vertex as they are for all but a host's framebuffers.
    void set_conventions();

    /// After work that went round this class: clears, blits, copies.
    void forget_masks();

    void set_pipeline(const PipelineObject& pipeline);
    void set_stencil(const GlStencil& stencil);
    void set_vertex_buffer(GLuint slot, GLuint buffer, GLintptr offset, GLsizei stride);
    void set_index_buffer(GLuint buffer);
    void set_uniform(const UniformBinding& binding, std::uint32_t dynamic_offset);
    void set_texture(const TextureBinding& binding);
    void set_viewport(const gpu::cmd::SetViewport& viewport);
    void set_scissor(const gpu::cmd::SetScissorRect& scissor);
    void set_depth_bounds(const gpu::cmd::SetDepthBounds& bounds);
    void set_blend_constant(const gpu::Color& color);

    static constexpr std::size_t max_color_targets = 8;

private:
    enum Capability {
        CullFace,
        DepthTest,
        DepthClamp,
        StencilTest,
        PolygonOffset,
        DepthBounds,
        Count
    };

    void set_enabled(Capability capability, bool on);
    void set_depth(const GlDepth& depth);
    void set_cull(gpu::CullMode mode);
    void set_targets(const std::vector<GlTarget>& targets);
    void set_vertex_layout(const PipelineObject& pipeline);

    struct VertexBufferState {
        GLuint buffer = 0;
        GLintptr offset = 0;
        GLsizei stride = 0;
        bool operator==(const VertexBufferState&) const = default;
    };
    struct UniformState {
        GLuint buffer = 0;
        GLintptr offset = 0;
        GLsizeiptr size = 0;
        bool operator==(const UniformState&) const = default;
    };
    struct TextureState {
        GLenum target = GL_NONE;
        GLuint texture = 0;
        GLuint sampler = 0;
        bool operator==(const TextureState&) const = default;
    };

    const Adapter& adapter_;
    const GlFunctions& gl_;
    GLuint vertex_array_;

    std::array<Remembered<bool>, Capability::Count> enabled_;
    Remembered<const PipelineObject*> pipeline_;
    Remembered<GLuint> program_;
    Remembered<GLenum> front_face_;
    Remembered<gpu::CullMode> cull_;
    Remembered<GLenum> depth_compare_;
    Remembered<bool> depth_write_;
    Remembered<GlDepthBias> depth_bias_;
    Remembered<GlStencil> stencil_;
    std::array<Remembered<GlBlend>, max_color_targets> blend_;
    std::array<Remembered<gpu::ColorWrite>, max_color_targets> color_mask_;
    std::vector<bool> attribute_enabled_;
    std::vector<Remembered<VertexBufferState>> vertex_buffers_;
    Remembered<GLuint> index_buffer_;
    std::vector<Remembered<UniformState>> uniforms_;
    std::vector<Remembered<TextureState>> textures_;
};

}  // namespace gnomon::gl
