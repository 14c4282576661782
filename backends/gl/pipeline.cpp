// SPDX-License-Identifier: MIT
#include "internal/pipeline.hpp"

#include <fmt/format.h>

#include <array>

#include "internal/debug_output.hpp"

namespace gnomon::gl {
namespace {

/// Compilers end their logs with line breaks and some with a zero byte.
std::string trimmed(std::string log) {
    const std::size_t last = log.find_last_not_of(std::string_view(" \t\r\n\0", 5));
    log.resize(last == std::string::npos ? 0 : last + 1);
    return log.empty() ? "the driver gives no reason" : log;
}

std::string shader_log(const GlFunctions& gl, GLuint shader) {
    GLint length = 0;
    gl.GetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    gl.GetShaderInfoLog(shader, length, nullptr, log.data());
    return trimmed(std::move(log));
}

std::string program_log(const GlFunctions& gl, GLuint program) {
    GLint length = 0;
    gl.GetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    gl.GetProgramInfoLog(program, length, nullptr, log.data());
    return trimmed(std::move(log));
}

Result<GLuint> link_program(const GlFunctions& gl, const gpu::RenderPipelineDesc& desc,
                            const ShaderObject& vertex, const ShaderObject* fragment) {
    const GLuint program = gl.CreateProgram();
    gl.AttachShader(program, vertex.name);
    if (fragment != nullptr) gl.AttachShader(program, fragment->name);
    gl.LinkProgram(program);
    // Attached shaders would outlive their own deletion.
    gl.DetachShader(program, vertex.name);
    if (fragment != nullptr) gl.DetachShader(program, fragment->name);

    GLint linked = GL_FALSE;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE) {
        const std::string shaders =
            fragment != nullptr
                ? fmt::format("[Shader \"{}\"] and [Shader \"{}\"]", vertex.label, fragment->label)
                : fmt::format("[Shader \"{}\"]", vertex.label);
        const std::string log = program_log(gl, program);
        gl.DeleteProgram(program);
        return fail(ErrorCode::Internal,
                    fmt::format("The OpenGL driver does not link {} of [RenderPipeline \"{}\"]: {}",
                                shaders, desc.label, log));
    }
    return program;
}

GlDepth translate_depth(const gpu::RenderPipelineDesc& desc) {
    GlDepth depth;
    depth.unclipped = desc.primitive.unclipped_depth;
    if (!desc.depth_stencil) return depth;
    const gpu::DepthStencilState& state = *desc.depth_stencil;
    depth.write = state.depth_write_enabled;
    depth.compare = to_gl(state.depth_compare);
    depth.bounded = state.depth_bounds_test;
    // Without the test GL does not write either.
    depth.enabled = depth.write || depth.compare != GL_ALWAYS;
    depth.bias = {.slope_scale = state.depth_bias_slope_scale,
                  .constant = static_cast<GLfloat>(state.depth_bias),
                  .clamp = state.depth_bias_clamp};
    return depth;
}

GlTarget translate_target(const gpu::ColorTargetState& target) {
    GlTarget result{.blend = {}, .write_mask = target.write_mask};
    if (target.blend) {
        const gpu::BlendComponent& color = target.blend->color;
        const gpu::BlendComponent& alpha = target.blend->alpha;
        result.blend = {.enabled = true,
                        .color_equation = to_gl(color.operation),
                        .alpha_equation = to_gl(alpha.operation),
                        .color_source = to_gl(color.src_factor, false),
                        .color_destination = to_gl(color.dst_factor, false),
                        .alpha_source = to_gl(alpha.src_factor, true),
                        .alpha_destination = to_gl(alpha.dst_factor, true)};
    }
    return result;
}

void translate_vertex_buffers(const gpu::RenderPipelineDesc& desc, PipelineObject& pipeline) {
    for (std::size_t slot = 0; slot < desc.vertex_buffers.size(); ++slot) {
        const gpu::VertexBufferLayout& layout = desc.vertex_buffers[slot];
        pipeline.slots.push_back(
            {.stride = static_cast<GLsizei>(layout.array_stride),
             .divisor = layout.step_mode == gpu::VertexStepMode::Instance ? 1U : 0U});
        for (const gpu::VertexAttribute& attribute : layout.attributes) {
            pipeline.attributes.push_back({.location = attribute.shader_location,
                                           .slot = static_cast<GLuint>(slot),
                                           .offset = static_cast<GLuint>(attribute.offset),
                                           .format = to_gl(attribute.format)});
        }
    }
}

}  // namespace

Result<ShaderObject> make_shader(const Adapter& adapter, const gpu::ShaderDesc& desc) {
    const GlFunctions& gl = adapter.gl;
    const bool is_vertex = desc.stage == gpu::ShaderStage::Vertex;
    const GLuint name = gl.CreateShader(is_vertex ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
    const std::array<const GLchar*, 1> text{desc.source.glsl.data()};
    const std::array<GLint, 1> length{static_cast<GLint>(desc.source.glsl.size())};
    gl.ShaderSource(name, 1, text.data(), length.data());
    gl.CompileShader(name);
    GLint compiled = GL_FALSE;
    gl.GetShaderiv(name, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_FALSE) {
        const std::string log = shader_log(gl, name);
        gl.DeleteShader(name);
        return fail(ErrorCode::InvalidInput,
                    fmt::format("The OpenGL driver does not compile the {} shader of "
                                "[Shader \"{}\"]: {}",
                                is_vertex ? "vertex" : "fragment", desc.label, log));
    }
    if (adapter.debug) set_label(gl, GL_SHADER, name, desc.label);
    return ShaderObject{.label = desc.label, .name = name};
}

Result<PipelineObject> make_pipeline(const Adapter& adapter, const gpu::RenderPipelineDesc& desc,
                                     const ShaderObject& vertex, const ShaderObject* fragment) {
    const GlFunctions& gl = adapter.gl;
    if (const Status accepted = adapter.stencil->accepts(desc); !accepted) {
        return forward_error(accepted);
    }
    PipelineObject pipeline;
    pipeline.topology = to_gl(desc.primitive.topology);
    pipeline.front_face = to_gl(desc.primitive.front_face);
    pipeline.cull_mode = desc.primitive.cull_mode;
    pipeline.depth = translate_depth(desc);
    pipeline.stencil = to_gl(desc.depth_stencil);
    for (const gpu::ColorTargetState& target : desc.targets) {
        pipeline.targets.push_back(translate_target(target));
    }
    translate_vertex_buffers(desc, pipeline);
    if (pipeline.depth.bias.clamp != 0.0F && gl.PolygonOffsetClamp == nullptr) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("[RenderPipeline \"{}\"] has a depth bias clamp of {}, which needs "
                                "OpenGL 4.6 or the extension GL_ARB_polygon_offset_clamp.",
                                desc.label, pipeline.depth.bias.clamp));
    }

    const auto program = link_program(gl, desc, vertex, fragment);
    if (!program) return forward_error(program);
    pipeline.program = *program;
    pipeline.base_instance_location = gl.GetUniformLocation(*program, "SPIRV_Cross_BaseInstance");
    if (adapter.debug) set_label(gl, GL_PROGRAM, *program, desc.label);
    if (const Status made =
            check_errors(gl, fmt::format("Creating [RenderPipeline \"{}\"]", desc.label));
        !made) {
        gl.DeleteProgram(*program);
        return forward_error(made);
    }
    return pipeline;
}

}  // namespace gnomon::gl
