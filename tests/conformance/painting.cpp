// SPDX-License-Identifier: MIT
#include "tests/conformance/painting.hpp"

#include <cstring>
#include <gnomon_shaders/conformance.hpp>

#include "tests/support/devices.hpp"

namespace gnomon::conformance {

using test::must;

std::vector<Vertex> triangles_of(const Rectangle& q) {
    const auto vertex = [&q](float x, float y) {
        return Vertex{x, y, q.z, 1, q.color[0], q.color[1], q.color[2], q.color[3]};
    };
    const Vertex a = vertex(q.left, q.bottom);
    const Vertex b = vertex(q.right, q.bottom);
    const Vertex c = vertex(q.right, q.top);
    const Vertex d = vertex(q.left, q.top);
    if (q.counter_clockwise) return {a, b, c, a, c, d};
    return {a, c, b, a, d, c};
}

std::vector<gpu::Format> depth_stencil_formats(const gpu::Device& device) {
    const gpu::Features& features = device.caps().features;
    std::vector<gpu::Format> formats;
    if (features.depth24unorm_stencil8) formats.push_back(gpu::Format::Depth24UnormStencil8);
    if (features.depth32float_stencil8) formats.push_back(gpu::Format::Depth32FloatStencil8);
    return formats;
}

gpu::Buffer make_buffer_of_bytes(gpu::Device& device, gpu::BufferUsage usage,
                                 std::span<const std::byte> bytes) {
    std::vector<std::byte> padded(bytes.begin(), bytes.end());
    padded.resize((padded.size() + 3) / 4 * 4);
    auto buffer = must(device.create_buffer({.label = "conformance",
                                             .size = padded.size(),
                                             .usage = usage | gpu::BufferUsage::CopyDst}));
    must(device.write_buffer(buffer, 0, padded));
    return buffer;
}

gpu::Shader make_shader(gpu::Device& device, gpu::ShaderStage stage,
                        const gpu::ShaderSource& source) {
    return must(device.create_shader({.label = "conformance", .stage = stage, .source = source}));
}

Painting::Painting(gpu::Device& device, const PaintingDesc& desc) : device_(device), desc_(desc) {
    const auto make_texture = [&](const char* label, gpu::Format format, std::uint32_t samples) {
        gpu::TextureUsage usage =
            gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::TextureBinding;
        if (samples == 1) usage = usage | gpu::TextureUsage::CopySrc;
        return must(device.create_texture({.label = label,
                                           .width = desc.width,
                                           .height = desc.height,
                                           .format = format,
                                           .usage = usage,
                                           .mip_level_count = 1,
                                           .sample_count = samples}));
    };
    color_ = make_texture("painting colour", desc.color_format, desc.sample_count);
    if (desc.sample_count > 1) resolved_ = make_texture("painting resolved", desc.color_format, 1);
    if (desc.depth_stencil_format != gpu::Format::Undefined) {
        depth_stencil_ =
            make_texture("painting depth", desc.depth_stencil_format, desc.sample_count);
    }
    vertex_ = make_shader(device, gpu::ShaderStage::Vertex, shaders::flat_vert);
    fragment_ =
        make_shader(device, gpu::ShaderStage::Fragment,
                    gpu::is_uint(desc.color_format) ? shaders::flat_uint_frag : shaders::flat_frag);
}

gpu::RenderPipeline Painting::make_pipeline(const Step& step) const {
    gpu::RenderPipelineDesc desc{
        .label = "painting step",
        .bind_group_layouts = {},
        .vertex = vertex_,
        .fragment = fragment_,
        .vertex_buffers = {{.array_stride = sizeof(Vertex),
                            .step_mode = gpu::VertexStepMode::Vertex,
                            .attributes = {{gpu::VertexFormat::Float32x4, 0, 0},
                                           {gpu::VertexFormat::Float32x4, 16, 1}}}},
        .primitive = step.primitive,
        .depth_stencil = std::nullopt,
        .targets = {{.format = desc_.color_format,
                     .blend = step.blend,
                     .write_mask = step.write_mask}},
        .sample_count = desc_.sample_count};
    if (depth_stencil_) {
        desc.depth_stencil = step.depth_stencil;
        desc.depth_stencil->format = desc_.depth_stencil_format;
    }
    return must(device_.create_render_pipeline(desc));
}

void Painting::paint(const std::vector<Step>& steps, gpu::QuerySetId occlusion_queries) {
    run(steps, gpu::LoadOp::Clear, occlusion_queries);
}

void Painting::paint_over(const std::vector<Step>& steps, gpu::QuerySetId occlusion_queries) {
    run(steps, gpu::LoadOp::Load, occlusion_queries);
}

void Painting::run(const std::vector<Step>& steps, gpu::LoadOp load_op, gpu::QuerySetId queries) {
    std::vector<gpu::RenderPipeline> pipelines;
    std::vector<gpu::Buffer> buffers;
    for (const Step& step : steps) {
        pipelines.push_back(make_pipeline(step));
        buffers.push_back(make_buffer(device_, gpu::BufferUsage::Vertex, step.vertices));
    }

    gpu::RenderPassDesc pass_desc{.label = "painting",
                                  .color_attachments = {{.texture = color_,
                                                         .resolve_target = resolved_,
                                                         .load_op = load_op,
                                                         .store_op = gpu::StoreOp::Store,
                                                         .clear_value = desc_.clear_color}},
                                  .depth_stencil = std::nullopt,
                                  .occlusion_query_set = queries,
                                  .timestamp_writes = std::nullopt};
    if (depth_stencil_) {
        pass_desc.depth_stencil = gpu::DepthStencilAttachment{
            .texture = depth_stencil_,
            .depth_load_op = load_op,
            .depth_clear_value = desc_.clear_depth,
            .stencil_load_op =
                gpu::has_stencil(desc_.depth_stencil_format) ? load_op : gpu::LoadOp::Load,
            .stencil_clear_value = desc_.clear_stencil};
    }
    gpu::CommandEncoder encoder = device_.create_command_encoder("painting");
    {
        gpu::RenderPassEncoder pass = encoder.begin_render_pass(pass_desc);
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const Step& step = steps[i];
            pass.set_pipeline(pipelines[i]);
            pass.set_vertex_buffer(0, buffers[i]);
            pass.set_stencil_reference(step.stencil_reference);
            pass.set_blend_constant(step.blend_constant);
            const gpu::cmd::SetViewport viewport = step.viewport.value_or(gpu::cmd::SetViewport{
                0, 0, static_cast<float>(desc_.width), static_cast<float>(desc_.height), 0, 1});
            pass.set_viewport(viewport.x, viewport.y, viewport.width, viewport.height,
                              viewport.min_depth, viewport.max_depth);
            const gpu::cmd::SetScissorRect scissor =
                step.scissor.value_or(gpu::cmd::SetScissorRect{0, 0, desc_.width, desc_.height});
            pass.set_scissor_rect(scissor.x, scissor.y, scissor.width, scissor.height);
            if (step.depth_bounds) {
                pass.set_depth_bounds(step.depth_bounds->min, step.depth_bounds->max);
            }
            if (step.occlusion_query) pass.begin_occlusion_query(*step.occlusion_query);
            pass.draw(static_cast<std::uint32_t>(step.vertices.size()));
            if (step.occlusion_query) pass.end_occlusion_query();
        }
    }
    must(device_.submit(must(encoder.finish())));
}

std::vector<std::uint8_t> Painting::color() const {
    const auto bytes = must(device_.read_texture(resolved_ ? resolved_ : color_));
    std::vector<std::uint8_t> values(bytes.size());
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

std::vector<float> Painting::depth() const {
    const auto bytes = must(device_.read_texture(depth_stencil_, gpu::Aspect::DepthOnly));
    std::vector<float> values(bytes.size() / sizeof(float));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

std::vector<std::uint8_t> Painting::stencil() const {
    const auto bytes = must(device_.read_texture(depth_stencil_, gpu::Aspect::StencilOnly));
    std::vector<std::uint8_t> values(bytes.size());
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

std::array<int, 4> Painting::pixel(std::uint32_t x, std::uint32_t y) const {
    const auto bytes = color();
    const std::size_t at = (std::size_t{y} * desc_.width + x) * 4;
    return {bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]};
}

}  // namespace gnomon::conformance
