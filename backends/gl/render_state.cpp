// SPDX-License-Identifier: MIT
#include "internal/render_state.hpp"

#include <algorithm>
#include <initializer_list>

namespace gnomon::gl {
namespace {

GLboolean to_boolean(bool value) { return value ? GL_TRUE : GL_FALSE; }

}  // namespace

RenderState::RenderState(const Adapter& adapter, GLuint vertex_array)
    : adapter_(adapter),
      gl_(adapter.gl),
      vertex_array_(vertex_array),
      attribute_enabled_(adapter.caps.limits.max_vertex_attributes),
      vertex_buffers_(adapter.caps.limits.max_vertex_buffers),
      uniforms_(adapter.uniform_buffer_bindings),
      textures_(adapter.texture_units) {}

void RenderState::set_conventions() {
    // Row 0 must be on top, with the top-left fill rule and the sample places of every other API.
    // GL_UPPER_LEFT turns the fill rule over with the picture: an edge that runs exactly through
    // pixel centres would belong to other pixels than on Vulkan. So the lower-left origin stays,
    // and vertex stages end by negating y (cmake/compile_shaders.cmake): exact, and no more.
    gl_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    // WebGPU's and Vulkan's choice. It also decides from which corner a software rasteriser sets a
    // triangle's depth plane up, and so the last bit of every depth.
    gl_.ProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
}

void RenderState::begin() {
    set_conventions();
    gl_.Enable(GL_FRAMEBUFFER_SRGB);
    gl_.Enable(GL_MULTISAMPLE);
    for (const GLenum off : std::initializer_list<GLenum>{
             GL_RASTERIZER_DISCARD, GL_PRIMITIVE_RESTART, GL_PRIMITIVE_RESTART_FIXED_INDEX,
             GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_ALPHA_TO_ONE, GL_SAMPLE_COVERAGE,
             GL_SAMPLE_MASK, GL_COLOR_LOGIC_OP, GL_DITHER, GL_PROGRAM_POINT_SIZE}) {
        gl_.Disable(off);
    }
    gl_.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    gl_.PointSize(1.0F);
    gl_.LineWidth(1.0F);
    gl_.BindVertexArray(vertex_array_);
    adapter_.stencil->begin(gl_);
}

void RenderState::end() {
    for (std::size_t slot = 0; slot < vertex_buffers_.size(); ++slot) {
        // The vertex array would keep a deleted buffer's memory alive.
        if (vertex_buffers_[slot].value()) {
            gl_.BindVertexBuffer(static_cast<GLuint>(slot), 0, 0, 0);
        }
    }
    for (std::size_t i = 0; i < attribute_enabled_.size(); ++i) {
        if (attribute_enabled_[i]) gl_.DisableVertexAttribArray(static_cast<GLuint>(i));
    }
    gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    for (std::size_t unit = 0; unit < textures_.size(); ++unit) {
        if (textures_[unit].value()) gl_.BindSampler(static_cast<GLuint>(unit), 0);
    }
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindVertexArray(0);
    gl_.UseProgram(0);
    adapter_.stencil->end(gl_);
    for (const GLenum off : std::initializer_list<GLenum>{
             GL_CULL_FACE, GL_DEPTH_TEST, GL_DEPTH_CLAMP, GL_STENCIL_TEST, GL_POLYGON_OFFSET_FILL,
             GL_SCISSOR_TEST, GL_BLEND, GL_FRAMEBUFFER_SRGB}) {
        gl_.Disable(off);
    }
    if (gl_.DepthBoundsEXT != nullptr) gl_.Disable(depth_bounds_test_ext);
    gl_.Enable(GL_DITHER);
    gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl_.DepthMask(GL_TRUE);
    gl_.DepthRangeIndexed(0, 0.0, 1.0);
    gl_.FrontFace(GL_CCW);
    gl_.CullFace(GL_BACK);
    gl_.ProvokingVertex(GL_LAST_VERTEX_CONVENTION);
    gl_.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
}

void RenderState::forget_masks() {
    pipeline_.forget();
    depth_write_.forget();
    stencil_.forget();
    for (auto& mask : color_mask_) mask.forget();
}

void RenderState::set_enabled(Capability capability, bool on) {
    static constexpr std::array<GLenum, Capability::Count> names{
        GL_CULL_FACE,    GL_DEPTH_TEST,          GL_DEPTH_CLAMP,
        GL_STENCIL_TEST, GL_POLYGON_OFFSET_FILL, depth_bounds_test_ext};
    if (!enabled_[capability].change(on)) return;
    if (on) {
        gl_.Enable(names[capability]);
    } else {
        gl_.Disable(names[capability]);
    }
}

void RenderState::set_pipeline(const PipelineObject& pipeline) {
    if (!pipeline_.change(&pipeline)) return;
    if (program_.change(pipeline.program)) gl_.UseProgram(pipeline.program);
    if (front_face_.change(pipeline.front_face)) gl_.FrontFace(pipeline.front_face);
    set_cull(pipeline.cull_mode);
    set_depth(pipeline.depth);
    set_targets(pipeline.targets);
    set_vertex_layout(pipeline);
}

void RenderState::set_cull(gpu::CullMode mode) {
    if (!cull_.change(mode)) return;
    set_enabled(CullFace, mode != gpu::CullMode::None);
    if (mode != gpu::CullMode::None) {
        gl_.CullFace(mode == gpu::CullMode::Front ? GL_FRONT : GL_BACK);
    }
}

void RenderState::set_depth(const GlDepth& depth) {
    set_enabled(DepthTest, depth.enabled);
    set_enabled(DepthClamp, depth.unclipped);
    // Where the driver has no such test its name is unknown.
    if (gl_.DepthBoundsEXT != nullptr) set_enabled(DepthBounds, depth.bounded);
    if (depth_compare_.change(depth.compare)) gl_.DepthFunc(depth.compare);
    if (depth_write_.change(depth.write)) gl_.DepthMask(to_boolean(depth.write));
    set_enabled(PolygonOffset, depth.bias.enabled());
    if (depth.bias.enabled() && depth_bias_.change(depth.bias)) {
        if (adapter_.gl.PolygonOffsetClamp != nullptr) {
            gl_.PolygonOffsetClamp(depth.bias.slope_scale, depth.bias.constant, depth.bias.clamp);
        } else {
            gl_.PolygonOffset(depth.bias.slope_scale, depth.bias.constant);
        }
    }
}

void RenderState::set_stencil(const GlStencil& stencil) {
    set_enabled(StencilTest, stencil.enabled);
    if (stencil.enabled && stencil_.change(stencil)) adapter_.stencil->apply(gl_, stencil);
}

void RenderState::set_targets(const std::vector<GlTarget>& targets) {
    const std::size_t count =
        std::min<std::size_t>(max_color_targets, adapter_.caps.limits.max_color_attachments);
    for (std::size_t i = 0; i < count; ++i) {
        const auto index = static_cast<GLuint>(i);
        const GlTarget target = i < targets.size()
                                    ? targets[i]
                                    : GlTarget{.blend = {}, .write_mask = gpu::ColorWrite::None};
        if (color_mask_[i].change(target.write_mask)) {
            const auto writes = [&target](gpu::ColorWrite channel) {
                return to_boolean(gpu::has(target.write_mask, channel));
            };
            gl_.ColorMaski(index, writes(gpu::ColorWrite::Red), writes(gpu::ColorWrite::Green),
                           writes(gpu::ColorWrite::Blue), writes(gpu::ColorWrite::Alpha));
        }
        if (!blend_[i].change(target.blend)) continue;
        if (!target.blend.enabled) {
            gl_.Disablei(GL_BLEND, index);
            continue;
        }
        gl_.Enablei(GL_BLEND, index);
        gl_.BlendEquationSeparatei(index, target.blend.color_equation, target.blend.alpha_equation);
        gl_.BlendFuncSeparatei(index, target.blend.color_source, target.blend.color_destination,
                               target.blend.alpha_source, target.blend.alpha_destination);
    }
}

void RenderState::set_vertex_layout(const PipelineObject& pipeline) {
    std::vector<bool> wanted(attribute_enabled_.size());
    for (const GlVertexAttribute& attribute : pipeline.attributes) {
        wanted[attribute.location] = true;
        if (attribute.format.integer) {
            gl_.VertexAttribIFormat(attribute.location, attribute.format.components,
                                    attribute.format.type, attribute.offset);
        } else {
            gl_.VertexAttribFormat(attribute.location, attribute.format.components,
                                   attribute.format.type, attribute.format.normalized,
                                   attribute.offset);
        }
        gl_.VertexAttribBinding(attribute.location, attribute.slot);
    }
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (wanted[i] == attribute_enabled_[i]) continue;
        const auto location = static_cast<GLuint>(i);
        if (wanted[i]) {
            gl_.EnableVertexAttribArray(location);
        } else {
            gl_.DisableVertexAttribArray(location);
        }
    }
    attribute_enabled_ = std::move(wanted);
    for (std::size_t slot = 0; slot < pipeline.slots.size(); ++slot) {
        gl_.VertexBindingDivisor(static_cast<GLuint>(slot), pipeline.slots[slot].divisor);
    }
}

void RenderState::set_vertex_buffer(GLuint slot, GLuint buffer, GLintptr offset, GLsizei stride) {
    if (vertex_buffers_[slot].change({buffer, offset, stride})) {
        gl_.BindVertexBuffer(slot, buffer, offset, stride);
    }
}

void RenderState::set_index_buffer(GLuint buffer) {
    if (index_buffer_.change(buffer)) gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer);
}

void RenderState::set_uniform(const UniformBinding& binding, std::uint32_t dynamic_offset) {
    const UniformState state{binding.buffer, binding.offset + static_cast<GLintptr>(dynamic_offset),
                             binding.size};
    if (uniforms_[binding.index].change(state)) {
        gl_.BindBufferRange(GL_UNIFORM_BUFFER, binding.index, state.buffer, state.offset,
                            state.size);
    }
}

void RenderState::set_texture(const TextureBinding& binding) {
    if (!textures_[binding.unit].change({binding.target, binding.texture, binding.sampler})) {
        return;
    }
    gl_.ActiveTexture(GL_TEXTURE0 + binding.unit);
    gl_.BindTexture(binding.target, binding.texture);
    gl_.BindSampler(binding.unit, binding.sampler);
}

void RenderState::set_viewport(const gpu::cmd::SetViewport& viewport) {
    gl_.ViewportIndexedf(0, viewport.x, viewport.y, viewport.width, viewport.height);
    gl_.DepthRangeIndexed(0, viewport.min_depth, viewport.max_depth);
}

void RenderState::set_scissor(const gpu::cmd::SetScissorRect& scissor) {
    gl_.Enable(GL_SCISSOR_TEST);
    gl_.ScissorIndexed(0, static_cast<GLint>(scissor.x), static_cast<GLint>(scissor.y),
                       static_cast<GLsizei>(scissor.width), static_cast<GLsizei>(scissor.height));
}

void RenderState::set_depth_bounds(const gpu::cmd::SetDepthBounds& bounds) {
    if (gl_.DepthBoundsEXT == nullptr) return;
    gl_.DepthBoundsEXT(static_cast<GLdouble>(bounds.min), static_cast<GLdouble>(bounds.max));
}

void RenderState::set_blend_constant(const gpu::Color& color) {
    gl_.BlendColor(static_cast<GLfloat>(color.r), static_cast<GLfloat>(color.g),
                   static_cast<GLfloat>(color.b), static_cast<GLfloat>(color.a));
}

}  // namespace gnomon::gl
