// SPDX-License-Identifier: MIT
//
// Opens devices and draws.
#include "tests/vk/fixture.hpp"

#include <cstring>
#include <gnomon_shaders/vk_test.hpp>

namespace gnomon::vk_test {

Result<gpu::Device> open(const std::shared_ptr<test::MessageLog>& log, vk::BackendOptions options) {
    options.message_sink = test::make_sink(log);
    options.validation = true;
    Result<std::unique_ptr<gpu::Backend>> backend = vk::create_backend(options);
    if (!backend && backend.error().message.find("is not installed") != std::string::npos) {
        options.validation = false;
        backend = vk::create_backend(options);
    }
    if (!backend) {
        return forward_error(backend);
    }
    return gpu::Device{std::move(*backend)};
}

void DeviceFixture::SetUp() {
    Result<gpu::Device> opened = open(log);
    if (!opened && test::is_required("vk")) {
        FAIL() << opened.error().message;
    }
    if (!opened) {
        GTEST_SKIP() << opened.error().message;
    }
    device = std::make_unique<gpu::Device>(std::move(*opened));
}

Painter::Painter(gpu::Device& device, std::uint32_t width, std::uint32_t height, gpu::Format format)
    : device_(device), width_(width), height_(height), format_(format) {
    color_ = must(
        device.create_buffer({.label = "color",
                              .size = 16,
                              .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst}));
    sampler_ = must(device.create_sampler({.label = "sampler"}));
    color_layout_ = must(device.create_bind_group_layout(
        {.label = "color", .entries = {{.binding = 0, .visibility = gpu::ShaderStage::Fragment}}}));
    texture_layout_ = must(
        device.create_bind_group_layout({.label = "texture",
                                         .entries = {{.binding = 1,
                                                      .visibility = gpu::ShaderStage::Fragment,
                                                      .type = gpu::BindingType::SampledTexture}}}));
    color_group_ = must(device.create_bind_group({.label = "color",
                                                  .layout = color_layout_,
                                                  .entries = {{.binding = 0, .buffer = color_}}}));
    const gpu::Shader vertex = must(device.create_shader({.label = "triangle",
                                                          .stage = gpu::ShaderStage::Vertex,
                                                          .source = shaders::triangle_vert}));
    const auto make_pipeline = [&](const char* label, const gpu::ShaderSource& source,
                                   const gpu::BindGroupLayout& layout) {
        const gpu::Shader fragment = must(device.create_shader(
            {.label = label, .stage = gpu::ShaderStage::Fragment, .source = source}));
        return must(device.create_render_pipeline({.label = label,
                                                   .bind_group_layouts = {layout},
                                                   .vertex = vertex,
                                                   .fragment = fragment,
                                                   .targets = {{.format = format}}}));
    };
    fill_ = make_pipeline("fill", shaders::color_frag, color_layout_);
    copy_ = make_pipeline("copy", shaders::copy_frag, texture_layout_);
}

gpu::Texture Painter::make_target() const {
    return must(device_.create_texture({.label = "target",
                                        .width = width_,
                                        .height = height_,
                                        .format = format_,
                                        .usage = gpu::TextureUsage::RenderAttachment |
                                                 gpu::TextureUsage::CopySrc |
                                                 gpu::TextureUsage::TextureBinding}));
}

void Painter::set_color(float r, float g, float b) {
    const std::array<float, 4> color{r, g, b, 1.0F};
    must(device_.write_buffer(color_, 0, std::as_bytes(std::span{color})));
}

void Painter::fill(const gpu::Texture& target) { draw(fill_, color_group_, target); }

void Painter::copy(const gpu::Texture& source, const gpu::Texture& target) {
    const gpu::BindGroup group = must(device_.create_bind_group(
        {.label = "source",
         .layout = texture_layout_,
         .entries = {{.binding = 1, .texture = source, .sampler = sampler_}}}));
    draw(copy_, group, target);
}

void Painter::draw(const gpu::RenderPipeline& pipeline, const gpu::BindGroup& group,
                   const gpu::Texture& target) {
    gpu::CommandEncoder encoder = device_.create_command_encoder("painter");
    {
        gpu::RenderPassEncoder pass = encoder.begin_render_pass(
            {.label = "paint", .color_attachments = {{.texture = target}}});
        pass.push_debug_group("triangle");
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, group);
        pass.draw(3);
        pass.pop_debug_group();
    }
    must(device_.submit(must(encoder.finish())));
}

Rgba8 Painter::read_uniform(const gpu::Texture& target) const {
    const std::vector<std::byte> bytes = must(device_.read_texture(target));
    Rgba8 first{};
    std::memcpy(first.data(), bytes.data(), first.size());
    for (std::size_t i = 0; i < bytes.size(); i += first.size()) {
        if (std::memcmp(bytes.data() + i, first.data(), first.size()) != 0) {
            ADD_FAILURE() << "The pixel " << i / first.size() << " differs from the first.";
            break;
        }
    }
    return first;
}

}  // namespace gnomon::vk_test
