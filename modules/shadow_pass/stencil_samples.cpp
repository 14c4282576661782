// SPDX-License-Identifier: MIT
#include <gnomon/shadow_pass/stencil_samples.hpp>

#include <array>
#include <cstdint>
#include <span>

#include <gnomon_shaders/shadow_pass.hpp>

namespace gnomon::shadow_pass {

Result<std::vector<std::byte>> read_stencil_sample(gpu::Device& device, gpu::TextureId texture,
                                                   std::uint32_t width, std::uint32_t height,
                                                   std::uint32_t sample) {
    auto target = device.create_texture(
        {.label = "stencil sample",
         .width = width,
         .height = height,
         .format = gpu::Format::R8Uint,
         .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc});
    if (!target) return forward_error(target);
    auto choice =
        device.create_buffer({.label = "stencil sample index",
                              .size = 16,
                              .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst});
    if (!choice) return forward_error(choice);
    const std::array<std::int32_t, 4> index{static_cast<std::int32_t>(sample), 0, 0, 0};
    if (const Status written = device.write_buffer(*choice, 0, std::as_bytes(std::span(index)));
        !written) {
        return forward_error(written);
    }
    auto layout = device.create_bind_group_layout(
        {.label = "stencil sample",
         .entries = {
             {.binding = 0, .visibility = gpu::ShaderStage::Fragment, .min_binding_size = 16},
             {.binding = 1,
              .visibility = gpu::ShaderStage::Fragment,
              .type = gpu::BindingType::SampledTexture,
              .sample_type = gpu::SampleType::Uint,
              .multisampled = true}}});
    if (!layout) return forward_error(layout);
    auto group = device.create_bind_group(
        {.label = "stencil sample",
         .layout = *layout,
         .entries = {{.binding = 0, .buffer = *choice},
                     {.binding = 1, .texture = texture, .aspect = gpu::Aspect::StencilOnly}}});
    if (!group) return forward_error(group);
    auto vertex = device.create_shader({.label = "full screen",
                                        .stage = gpu::ShaderStage::Vertex,
                                        .source = shaders::full_screen_vert});
    if (!vertex) return forward_error(vertex);
    auto fragment = device.create_shader({.label = "stencil sample",
                                          .stage = gpu::ShaderStage::Fragment,
                                          .source = shaders::stencil_sample_frag});
    if (!fragment) return forward_error(fragment);
    auto pipeline = device.create_render_pipeline({.label = "stencil sample",
                                                   .bind_group_layouts = {*layout},
                                                   .vertex = *vertex,
                                                   .fragment = *fragment,
                                                   .targets = {{.format = gpu::Format::R8Uint}}});
    if (!pipeline) return forward_error(pipeline);

    auto encoder = device.create_command_encoder("stencil sample");
    {
        auto pass = encoder.begin_render_pass(
            {.label = "stencil sample",
             .color_attachments = {{.texture = *target, .load_op = gpu::LoadOp::Clear}}});
        pass.set_pipeline(*pipeline);
        pass.set_bind_group(0, *group);
        pass.draw(3);
    }
    auto commands = encoder.finish();
    if (!commands) return forward_error(commands);
    if (const Status submitted = device.submit(*commands); !submitted)
        return forward_error(submitted);
    return device.read_texture(*target);
}

}  // namespace gnomon::shadow_pass
