// SPDX-License-Identifier: MIT
//
// A device on the null backend and valid objects of every kind, for tests that break one rule at a
// time. Labels are the members' names.
#pragma once

#include <cstdint>
#include <functional>

#include <gnomon/gpu/device.hpp>
#include <gnomon/gpu/null_backend.hpp>

#include "rows.hpp"

namespace gnomon::gpu::test {

inline constexpr std::uint32_t spirv_word[] = {0x07230203};

inline ShaderDesc shader_desc(const char* label, ShaderStage stage) {
    return {.label = label, .stage = stage, .source = {.spirv = spirv_word, .glsl = "void main"}};
}

inline TextureDesc target_desc(const char* label, Format format, std::uint32_t sample_count = 1) {
    return {.label = label,
            .width = 64,
            .height = 32,
            .format = format,
            .usage = TextureUsage::RenderAttachment | TextureUsage::TextureBinding |
                     TextureUsage::CopySrc,
            .sample_count = sample_count};
}

struct World {
    Device device;

    Buffer vertices = buffer("vertices", 120, BufferUsage::Vertex | BufferUsage::CopyDst);
    Buffer instances = buffer("instances", 32, BufferUsage::Vertex);
    Buffer indices = buffer("indices", 24, BufferUsage::Index | BufferUsage::CopySrc);
    Buffer uniforms = buffer("uniforms", 1024, BufferUsage::Uniform | BufferUsage::CopyDst);
    Texture color = take(device.create_texture(target_desc("color", Format::Rgba8Unorm)));
    Texture depth = take(device.create_texture(target_desc("depth", Format::Depth32FloatStencil8)));
    Texture color4 = take(device.create_texture(target_desc("color4", Format::Rgba8Unorm, 4)));
    Texture albedo =
        take(device.create_texture({.label = "albedo",
                                    .width = 8,
                                    .height = 4,
                                    .format = Format::Rgba8Unorm,
                                    .usage = TextureUsage::TextureBinding | TextureUsage::CopyDst,
                                    .mip_level_count = 4}));
    Sampler sampler = take(device.create_sampler({.label = "sampler"}));
    Shader vertex_shader =
        take(device.create_shader(shader_desc("vertex_shader", ShaderStage::Vertex)));
    Shader fragment_shader =
        take(device.create_shader(shader_desc("fragment_shader", ShaderStage::Fragment)));
    BindGroupLayout uniform_layout =
        take(device.create_bind_group_layout({.label = "uniform_layout",
                                              .entries = {{.binding = 0,
                                                           .visibility = ShaderStage::Vertex,
                                                           .has_dynamic_offset = true,
                                                           .min_binding_size = 64}}}));
    BindGroupLayout texture_layout =
        take(device.create_bind_group_layout({.label = "texture_layout",
                                              .entries = {{.binding = 1,
                                                           .visibility = ShaderStage::Fragment,
                                                           .type = BindingType::SampledTexture}}}));
    BindGroup uniform_group = take(device.create_bind_group(
        {.label = "uniform_group",
         .layout = uniform_layout,
         .entries = {{.binding = 0, .buffer = uniforms, .offset = 256, .size = 64}}}));
    BindGroup texture_group = take(device.create_bind_group(
        {.label = "texture_group",
         .layout = texture_layout,
         .entries = {{.binding = 1, .texture = albedo, .sampler = sampler}}}));
    RenderPipeline pipeline = take(device.create_render_pipeline(pipeline_desc()));
    QuerySet occlusion = take(
        device.create_query_set({.label = "occlusion", .type = QueryType::Occlusion, .count = 2}));
    QuerySet timestamps = take(
        device.create_query_set({.label = "timestamps", .type = QueryType::Timestamp, .count = 2}));

    explicit World(std::unique_ptr<Backend> backend = create_null_backend())
        : device(std::move(backend)) {}

    Buffer buffer(const char* label, std::uint64_t size, BufferUsage usage) {
        return take(device.create_buffer({label, size, usage}));
    }

    /// 12 bytes of position a vertex, 16 bytes an instance; color and depth, one sample.
    [[nodiscard]] RenderPipelineDesc pipeline_desc() const {
        return {.label = "pipeline",
                .bind_group_layouts = {uniform_layout, texture_layout},
                .vertex = vertex_shader,
                .fragment = fragment_shader,
                .vertex_buffers = {{.array_stride = 12, .attributes = {{.shader_location = 0}}},
                                   {.array_stride = 16,
                                    .step_mode = VertexStepMode::Instance,
                                    .attributes = {{.format = VertexFormat::Float32x4,
                                                    .shader_location = 1}}}},
                .depth_stencil =
                    DepthStencilState{.format = Format::Depth32FloatStencil8,
                                      .depth_write_enabled = true,
                                      .depth_compare = Compare::Greater,
                                      .stencil_front = {.pass_op = StencilOp::IncrementWrap}},
                .targets = {{.format = Format::Rgba8Unorm}}};
    }

    [[nodiscard]] RenderPassDesc pass_desc() const {
        return {.label = "pass",
                .color_attachments = {{.texture = color, .load_op = LoadOp::Clear}},
                .depth_stencil = DepthStencilAttachment{.texture = depth,
                                                        .depth_load_op = LoadOp::Clear,
                                                        .stencil_load_op = LoadOp::Clear},
                .occlusion_query_set = occlusion};
    }

    /// Sets all that `pipeline` needs.
    void set_state(RenderPassEncoder& pass) const {
        const std::uint32_t offset = 256;
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, uniform_group, {&offset, 1});
        pass.set_bind_group(1, texture_group);
        pass.set_vertex_buffer(0, vertices);
        pass.set_vertex_buffer(1, instances);
        pass.set_index_buffer(indices, IndexFormat::Uint32);
    }

    /// A command buffer with one pass, in which `record` works.
    Result<CommandBuffer> record_pass(const RenderPassDesc& desc,
                                      const std::function<void(RenderPassEncoder&)>& record) {
        CommandEncoder encoder = device.create_command_encoder("frame");
        RenderPassEncoder pass = encoder.begin_render_pass(desc);
        record(pass);
        pass.end();
        return encoder.finish();
    }
};

}  // namespace gnomon::gpu::test
