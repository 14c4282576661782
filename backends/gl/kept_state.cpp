// SPDX-License-Identifier: MIT
#include "internal/kept_state.hpp"

#include <algorithm>

namespace gnomon::gl {
namespace {

// Of compatibility contexts, or of EXT_stencil_two_side; <GL/glcorearb.h> does not know them.
constexpr GLenum alpha_test = 0x0BC0;
constexpr GLenum polygon_stipple = 0x0B42;
constexpr GLenum active_stencil_face_ext = 0x8911;
constexpr GLenum depth_bounds_ext = 0x8891;

constexpr std::array<GLenum, 10> pixel_store_names{
    GL_UNPACK_ALIGNMENT,  GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS,
    GL_UNPACK_SWAP_BYTES, GL_PACK_ALIGNMENT,    GL_PACK_ROW_LENGTH,  GL_PACK_SKIP_ROWS,
    GL_PACK_SKIP_PIXELS,  GL_PACK_SWAP_BYTES};

// Switches that the backend sets by itself.
constexpr std::array<GLenum, 17> own_switches{GL_CULL_FACE,
                                              GL_DEPTH_TEST,
                                              GL_DEPTH_CLAMP,
                                              GL_STENCIL_TEST,
                                              GL_POLYGON_OFFSET_FILL,
                                              GL_FRAMEBUFFER_SRGB,
                                              GL_MULTISAMPLE,
                                              GL_RASTERIZER_DISCARD,
                                              GL_PRIMITIVE_RESTART,
                                              GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                              GL_SAMPLE_ALPHA_TO_COVERAGE,
                                              GL_SAMPLE_ALPHA_TO_ONE,
                                              GL_SAMPLE_COVERAGE,
                                              GL_SAMPLE_MASK,
                                              GL_COLOR_LOGIC_OP,
                                              GL_DITHER,
                                              GL_PROGRAM_POINT_SIZE};

// Switches that it expects to be off.
constexpr std::array<GLenum, 11> others_switches{
    GL_CLIP_DISTANCE0, GL_CLIP_DISTANCE1, GL_CLIP_DISTANCE2, GL_CLIP_DISTANCE3,
    GL_CLIP_DISTANCE4, GL_CLIP_DISTANCE5, GL_CLIP_DISTANCE6, GL_CLIP_DISTANCE7,
    GL_POLYGON_SMOOTH, GL_LINE_SMOOTH,    GL_SAMPLE_SHADING};

GLuint to_name(GLint value) { return static_cast<GLuint>(value); }
GLenum to_word(GLint value) { return static_cast<GLenum>(value); }

}  // namespace

KeptState::KeptState(const Adapter& adapter, KeptScope scope, Bound bound)
    : adapter_(adapter), gl_(adapter.gl) {
    buffers_ = {.copy_read = integer(GL_COPY_READ_BUFFER_BINDING),
                .copy_write = integer(GL_COPY_WRITE_BUFFER_BINDING),
                .pack = integer(GL_PIXEL_PACK_BUFFER_BINDING),
                .unpack = integer(GL_PIXEL_UNPACK_BUFFER_BINDING),
                .draw_framebuffer = integer(GL_DRAW_FRAMEBUFFER_BINDING),
                .read_framebuffer = integer(GL_READ_FRAMEBUFFER_BINDING)};
    if (scope == KeptScope::Bindings) return;
    drawing_ = std::make_unique<Drawing>();
    keep_drawing();
    keep_targets();
    keep_stencil();
    keep_bound(bound);
    switch_off_the_rest();
}

KeptState::~KeptState() {
    if (drawing_) {
        restore_drawing();
        restore_targets();
        restore_stencil();
        restore_bound();
    }
    gl_.BindBuffer(GL_COPY_READ_BUFFER, to_name(buffers_.copy_read));
    gl_.BindBuffer(GL_COPY_WRITE_BUFFER, to_name(buffers_.copy_write));
    gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, to_name(buffers_.pack));
    gl_.BindBuffer(GL_PIXEL_UNPACK_BUFFER, to_name(buffers_.unpack));
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, to_name(buffers_.draw_framebuffer));
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, to_name(buffers_.read_framebuffer));
}

GLint KeptState::integer(GLenum name) const {
    GLint value = 0;
    gl_.GetIntegerv(name, &value);
    return value;
}

GLfloat KeptState::real(GLenum name) const {
    GLfloat value = 0.0F;
    gl_.GetFloatv(name, &value);
    return value;
}

void KeptState::set_switch(GLenum name, bool on) const {
    if (on) {
        gl_.Enable(name);
    } else {
        gl_.Disable(name);
    }
}

std::vector<GLenum> KeptState::switch_names() const {
    std::vector<GLenum> names(own_switches.begin(), own_switches.end());
    names.insert(names.end(), others_switches.begin(), others_switches.end());
    if (adapter_.compatibility) names.insert(names.end(), {alpha_test, polygon_stipple});
    if (gl_.DepthBoundsEXT != nullptr) names.push_back(depth_bounds_test_ext);
    if (gl_.ActiveStencilFaceEXT != nullptr) names.push_back(stencil_test_two_side_ext);
    return names;
}

void KeptState::switch_off_the_rest() const {
    for (const GLenum name : others_switches) gl_.Disable(name);
    if (adapter_.compatibility) {
        gl_.Disable(alpha_test);
        gl_.Disable(polygon_stipple);
    }
    if (gl_.ActiveStencilFaceEXT != nullptr) gl_.Disable(stencil_test_two_side_ext);
}

void KeptState::keep_drawing() {
    Drawing& d = *drawing_;
    for (const GLenum name : switch_names()) d.switches.push_back(gl_.IsEnabled(name));
    for (GLuint i = 0; i < adapter_.viewports; ++i) {
        d.scissor_tests.push_back(gl_.IsEnabledi(GL_SCISSOR_TEST, i));
    }
    gl_.GetIntegeri_v(GL_SCISSOR_BOX, 0, d.scissor.data());
    gl_.GetFloati_v(GL_VIEWPORT, 0, d.viewport.data());
    gl_.GetDoublei_v(GL_DEPTH_RANGE, 0, d.depth_range.data());
    if (gl_.DepthBoundsEXT != nullptr) gl_.GetFloatv(depth_bounds_ext, d.depth_bounds.data());
    gl_.GetBooleanv(GL_DEPTH_WRITEMASK, &d.depth_mask);
    d.depth_compare = integer(GL_DEPTH_FUNC);
    d.cull_face = integer(GL_CULL_FACE_MODE);
    d.front_face = integer(GL_FRONT_FACE);
    d.provoking_vertex = integer(GL_PROVOKING_VERTEX);
    d.clip_origin = integer(GL_CLIP_ORIGIN);
    d.clip_depth = integer(GL_CLIP_DEPTH_MODE);
    gl_.GetIntegerv(GL_POLYGON_MODE, d.polygon_mode.data());
    d.point_size = real(GL_POINT_SIZE);
    d.line_width = real(GL_LINE_WIDTH);
    d.offset_factor = real(GL_POLYGON_OFFSET_FACTOR);
    d.offset_units = real(GL_POLYGON_OFFSET_UNITS);
    if (gl_.PolygonOffsetClamp != nullptr) d.offset_clamp = real(GL_POLYGON_OFFSET_CLAMP);
}

void KeptState::restore_drawing() const {
    const Drawing& d = *drawing_;
    const std::vector<GLenum> names = switch_names();
    for (std::size_t i = 0; i < names.size(); ++i) set_switch(names[i], d.switches[i] != GL_FALSE);
    for (GLuint i = 0; i < d.scissor_tests.size(); ++i) {
        if (d.scissor_tests[i] != GL_FALSE) {
            gl_.Enablei(GL_SCISSOR_TEST, i);
        } else {
            gl_.Disablei(GL_SCISSOR_TEST, i);
        }
    }
    gl_.ScissorIndexed(0, d.scissor[0], d.scissor[1], d.scissor[2], d.scissor[3]);
    gl_.ViewportIndexedf(0, d.viewport[0], d.viewport[1], d.viewport[2], d.viewport[3]);
    gl_.DepthRangeIndexed(0, d.depth_range[0], d.depth_range[1]);
    if (gl_.DepthBoundsEXT != nullptr) gl_.DepthBoundsEXT(d.depth_bounds[0], d.depth_bounds[1]);
    gl_.DepthMask(d.depth_mask);
    gl_.DepthFunc(to_word(d.depth_compare));
    gl_.CullFace(to_word(d.cull_face));
    gl_.FrontFace(to_word(d.front_face));
    gl_.ProvokingVertex(to_word(d.provoking_vertex));
    gl_.ClipControl(to_word(d.clip_origin), to_word(d.clip_depth));
    if (adapter_.compatibility) {
        gl_.PolygonMode(GL_FRONT, to_word(d.polygon_mode[0]));
        gl_.PolygonMode(GL_BACK, to_word(d.polygon_mode[1]));
    } else {
        gl_.PolygonMode(GL_FRONT_AND_BACK, to_word(d.polygon_mode[0]));
    }
    gl_.PointSize(d.point_size);
    gl_.LineWidth(d.line_width);
    if (gl_.PolygonOffsetClamp != nullptr) {
        gl_.PolygonOffsetClamp(d.offset_factor, d.offset_units, d.offset_clamp);
    } else {
        gl_.PolygonOffset(d.offset_factor, d.offset_units);
    }
}

void KeptState::keep_targets() {
    Drawing& d = *drawing_;
    d.targets.resize(std::min<std::size_t>(RenderState::max_color_targets,
                                           adapter_.caps.limits.max_color_attachments));
    for (GLuint i = 0; i < d.targets.size(); ++i) {
        Blend& target = d.targets[i];
        target.enabled = gl_.IsEnabledi(GL_BLEND, i);
        gl_.GetIntegeri_v(GL_BLEND_EQUATION_RGB, i, &target.color_equation);
        gl_.GetIntegeri_v(GL_BLEND_EQUATION_ALPHA, i, &target.alpha_equation);
        gl_.GetIntegeri_v(GL_BLEND_SRC_RGB, i, &target.color_source);
        gl_.GetIntegeri_v(GL_BLEND_DST_RGB, i, &target.color_destination);
        gl_.GetIntegeri_v(GL_BLEND_SRC_ALPHA, i, &target.alpha_source);
        gl_.GetIntegeri_v(GL_BLEND_DST_ALPHA, i, &target.alpha_destination);
        gl_.GetBooleani_v(GL_COLOR_WRITEMASK, i, target.mask.data());
    }
    gl_.GetFloatv(GL_BLEND_COLOR, d.blend_constant.data());
}

void KeptState::restore_targets() const {
    const Drawing& d = *drawing_;
    for (GLuint i = 0; i < d.targets.size(); ++i) {
        const Blend& target = d.targets[i];
        if (target.enabled != GL_FALSE) {
            gl_.Enablei(GL_BLEND, i);
        } else {
            gl_.Disablei(GL_BLEND, i);
        }
        gl_.BlendEquationSeparatei(i, to_word(target.color_equation),
                                   to_word(target.alpha_equation));
        gl_.BlendFuncSeparatei(i, to_word(target.color_source), to_word(target.color_destination),
                               to_word(target.alpha_source), to_word(target.alpha_destination));
        gl_.ColorMaski(i, target.mask[0], target.mask[1], target.mask[2], target.mask[3]);
    }
    gl_.BlendColor(d.blend_constant[0], d.blend_constant[1], d.blend_constant[2],
                   d.blend_constant[3]);
}

KeptState::StencilFace KeptState::stencil_face() const {
    return {.compare = integer(GL_STENCIL_FUNC),
            .reference = integer(GL_STENCIL_REF),
            .read_mask = integer(GL_STENCIL_VALUE_MASK),
            .write_mask = integer(GL_STENCIL_WRITEMASK),
            .fail = integer(GL_STENCIL_FAIL),
            .depth_fail = integer(GL_STENCIL_PASS_DEPTH_FAIL),
            .pass = integer(GL_STENCIL_PASS_DEPTH_PASS)};
}

void KeptState::keep_stencil() {
    Drawing& d = *drawing_;
    // With EXT_stencil_two_side the names without "back" speak of the active face.
    if (gl_.ActiveStencilFaceEXT != nullptr) {
        d.active_stencil_face = integer(active_stencil_face_ext);
        gl_.ActiveStencilFaceEXT(GL_BACK);
        d.two_side_back = stencil_face();
        gl_.ActiveStencilFaceEXT(GL_FRONT);
    }
    d.front = stencil_face();
    d.back = {.compare = integer(GL_STENCIL_BACK_FUNC),
              .reference = integer(GL_STENCIL_BACK_REF),
              .read_mask = integer(GL_STENCIL_BACK_VALUE_MASK),
              .write_mask = integer(GL_STENCIL_BACK_WRITEMASK),
              .fail = integer(GL_STENCIL_BACK_FAIL),
              .depth_fail = integer(GL_STENCIL_BACK_PASS_DEPTH_FAIL),
              .pass = integer(GL_STENCIL_BACK_PASS_DEPTH_PASS)};
}

void KeptState::restore_stencil() const {
    const Drawing& d = *drawing_;
    const auto restore = [this](GLenum face, const StencilFace& s) {
        gl_.StencilFuncSeparate(face, to_word(s.compare), s.reference, to_name(s.read_mask));
        gl_.StencilOpSeparate(face, to_word(s.fail), to_word(s.depth_fail), to_word(s.pass));
        gl_.StencilMaskSeparate(face, to_name(s.write_mask));
    };
    restore(GL_FRONT, d.front);
    restore(GL_BACK, d.back);
    if (gl_.ActiveStencilFaceEXT == nullptr) return;
    const StencilFace& s = d.two_side_back;
    gl_.ActiveStencilFaceEXT(GL_BACK);
    gl_.StencilFunc(to_word(s.compare), s.reference, to_name(s.read_mask));
    gl_.StencilOp(to_word(s.fail), to_word(s.depth_fail), to_word(s.pass));
    gl_.StencilMask(to_name(s.write_mask));
    gl_.ActiveStencilFaceEXT(to_word(d.active_stencil_face));
}

void KeptState::keep_bound(Bound bound) {
    Drawing& d = *drawing_;
    d.program = integer(GL_CURRENT_PROGRAM);
    d.vertex_array = integer(GL_VERTEX_ARRAY_BINDING);
    d.renderbuffer = integer(GL_RENDERBUFFER_BINDING);
    d.uniform_buffer = integer(GL_UNIFORM_BUFFER_BINDING);
    for (GLuint i = 0; i < bound.uniform_buffers; ++i) {
        Uniform& uniform = d.uniforms.emplace_back();
        gl_.GetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, i, &uniform.buffer);
        gl_.GetInteger64i_v(GL_UNIFORM_BUFFER_START, i, &uniform.start);
        gl_.GetInteger64i_v(GL_UNIFORM_BUFFER_SIZE, i, &uniform.size);
    }
    for (const GLenum name : pixel_store_names) d.pixel_store.push_back(integer(name));
    d.active_texture = integer(GL_ACTIVE_TEXTURE);
    active_unit_ = {.texture = integer(GL_TEXTURE_BINDING_2D),
                    .multisampled = integer(GL_TEXTURE_BINDING_2D_MULTISAMPLE)};
    for (GLuint unit = 0; unit < bound.texture_units; ++unit) {
        gl_.ActiveTexture(GL_TEXTURE0 + unit);
        d.units.push_back({.texture = integer(GL_TEXTURE_BINDING_2D),
                           .multisampled = integer(GL_TEXTURE_BINDING_2D_MULTISAMPLE),
                           .sampler = integer(GL_SAMPLER_BINDING)});
    }
    gl_.ActiveTexture(to_word(d.active_texture));
}

void KeptState::restore_bound() const {
    const Drawing& d = *drawing_;
    gl_.UseProgram(to_name(d.program));
    gl_.BindVertexArray(to_name(d.vertex_array));
    gl_.BindRenderbuffer(GL_RENDERBUFFER, to_name(d.renderbuffer));
    for (GLuint i = 0; i < d.uniforms.size(); ++i) {
        const Uniform& uniform = d.uniforms[i];
        if (uniform.size == 0) {  // all of the buffer, or none
            gl_.BindBufferBase(GL_UNIFORM_BUFFER, i, to_name(uniform.buffer));
        } else {
            gl_.BindBufferRange(GL_UNIFORM_BUFFER, i, to_name(uniform.buffer),
                                static_cast<GLintptr>(uniform.start),
                                static_cast<GLsizeiptr>(uniform.size));
        }
    }
    gl_.BindBuffer(GL_UNIFORM_BUFFER, to_name(d.uniform_buffer));
    for (std::size_t i = 0; i < pixel_store_names.size(); ++i) {
        gl_.PixelStorei(pixel_store_names[i], d.pixel_store[i]);
    }
    for (GLuint unit = 0; unit < d.units.size(); ++unit) {
        gl_.ActiveTexture(GL_TEXTURE0 + unit);
        gl_.BindTexture(GL_TEXTURE_2D, to_name(d.units[unit].texture));
        gl_.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, to_name(d.units[unit].multisampled));
        gl_.BindSampler(unit, to_name(d.units[unit].sampler));
    }
    gl_.ActiveTexture(to_word(d.active_texture));
    gl_.BindTexture(GL_TEXTURE_2D, to_name(active_unit_.texture));
    gl_.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, to_name(active_unit_.multisampled));
}

}  // namespace gnomon::gl
