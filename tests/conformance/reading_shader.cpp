// SPDX-License-Identifier: MIT
#include "tests/conformance/reading_shader.hpp"

#include <cstring>
#include <gnomon_shaders/conformance.hpp>

#include "tests/conformance/painting.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::conformance {

using test::must;

namespace {

struct Bound {
    gpu::BindGroupLayout layout;
    gpu::BindGroup group;
    gpu::Buffer block;
};

Bound bind(gpu::Device& device, const ReadingDesc& desc) {
    Bound bound;
    gpu::BindGroupLayoutDesc layout_desc{.label = "reading", .entries = {}};
    std::vector<gpu::BindGroupEntry> entries;
    if (desc.block) {
        std::visit(
            [&](const auto& values) {
                bound.block = make_buffer_of_bytes(device, gpu::BufferUsage::Uniform,
                                                   std::as_bytes(std::span(values)));
            },
            *desc.block);
        layout_desc.entries.push_back({.binding = 0,
                                       .visibility = gpu::ShaderStage::Fragment,
                                       .type = gpu::BindingType::UniformBuffer,
                                       .min_binding_size = 16});
        entries.push_back({.binding = 0, .buffer = bound.block});
    }
    std::uint32_t binding = 1;
    for (const ReadTexture& read : desc.textures) {
        layout_desc.entries.push_back({.binding = binding,
                                       .visibility = gpu::ShaderStage::Fragment,
                                       .type = gpu::BindingType::SampledTexture,
                                       .sample_type = read.sample_type,
                                       .multisampled = read.multisampled});
        entries.push_back({.binding = binding,
                           .texture = read.texture,
                           .sampler = read.sampler,
                           .aspect = read.aspect});
        ++binding;
    }
    bound.layout = must(device.create_bind_group_layout(layout_desc));
    bound.group = must(device.create_bind_group(
        {.label = "reading", .layout = bound.layout, .entries = std::move(entries)}));
    return bound;
}

}  // namespace

template <class T>
std::vector<T> texels_as(const std::vector<std::byte>& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
}
template std::vector<std::array<float, 4>> texels_as(const std::vector<std::byte>&);
template std::vector<float> texels_as(const std::vector<std::byte>&);
template std::vector<std::uint32_t> texels_as(const std::vector<std::byte>&);
template std::vector<std::uint8_t> texels_as(const std::vector<std::byte>&);

std::vector<std::byte> read_by_shader(gpu::Device& device, const ReadingDesc& desc) {
    const Bound bound = bind(device, desc);
    const auto vertex = make_shader(device, gpu::ShaderStage::Vertex, shaders::screen_vert);
    const auto fragment = make_shader(device, gpu::ShaderStage::Fragment, desc.fragment);
    const auto target = must(device.create_texture(
        {.label = "reading target",
         .width = desc.width,
         .height = desc.height,
         .format = desc.target_format,
         .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc}));
    const auto pipeline =
        must(device.create_render_pipeline({.label = "reading",
                                            .bind_group_layouts = {bound.layout},
                                            .vertex = vertex,
                                            .fragment = fragment,
                                            .targets = {{.format = desc.target_format}}}));
    gpu::CommandEncoder encoder = device.create_command_encoder("reading");
    {
        gpu::RenderPassEncoder pass = encoder.begin_render_pass(
            {.label = "reading",
             .color_attachments = {{.texture = target, .load_op = gpu::LoadOp::Clear}}});
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, bound.group);
        pass.draw(3);
    }
    must(device.submit(must(encoder.finish())));
    return must(device.read_texture(target));
}

std::vector<std::array<float, 4>> fetch_color_samples(gpu::Device& device, gpu::TextureId texture,
                                                      std::uint32_t width, std::uint32_t height,
                                                      std::int32_t sample) {
    return texels_as<std::array<float, 4>>(
        read_by_shader(device, {.fragment = shaders::fetch_color_ms_frag,
                                .textures = {{.texture = texture, .multisampled = true}},
                                .block = std::array<std::int32_t, 4>{sample, 0, 0, 0},
                                .target_format = gpu::Format::Rgba32Float,
                                .width = width,
                                .height = height}));
}

std::vector<std::uint8_t> fetch_stencil_samples(gpu::Device& device, gpu::TextureId texture,
                                                std::uint32_t width, std::uint32_t height,
                                                std::int32_t sample) {
    return texels_as<std::uint8_t>(
        read_by_shader(device, {.fragment = shaders::fetch_uint_ms_frag,
                                .textures = {{.texture = texture,
                                              .aspect = gpu::Aspect::StencilOnly,
                                              .sample_type = gpu::SampleType::Uint,
                                              .multisampled = true}},
                                .block = std::array<std::int32_t, 4>{sample, 0, 0, 0},
                                .target_format = gpu::Format::R8Uint,
                                .width = width,
                                .height = height}));
}

}  // namespace gnomon::conformance
