// SPDX-License-Identifier: MIT
#include "tests/gl/small_scene.hpp"

#include <gnomon_shaders/gl_tests.hpp>

#include "tests/support/devices.hpp"

namespace gnomon::gl_tests {

using test::must;

SmallScene draw_small_scene(gpu::Device& device) {
    const auto vertex = must(device.create_shader({.label = "small vertex",
                                                   .stage = gpu::ShaderStage::Vertex,
                                                   .source = shaders::triangle_vert}));
    const auto fragment = must(device.create_shader({.label = "small fragment",
                                                     .stage = gpu::ShaderStage::Fragment,
                                                     .source = shaders::triangle_frag}));
    const gpu::DepthStencilState plain{.format = gpu::Format::Depth32FloatStencil8,
                                       .depth_write_enabled = true,
                                       .depth_compare = gpu::Compare::Greater};
    const gpu::DepthStencilState count{.format = gpu::Format::Depth32FloatStencil8,
                                       .depth_compare = gpu::Compare::GreaterEqual,
                                       .stencil_front = {.pass_op = gpu::StencilOp::IncrementWrap},
                                       .stencil_back = {.pass_op = gpu::StencilOp::DecrementWrap}};
    const auto make_pipeline = [&](const gpu::DepthStencilState& state, gpu::ColorWrite mask) {
        return must(device.create_render_pipeline(
            {.label = "small pipeline",
             .vertex = vertex,
             .fragment = fragment,
             .depth_stencil = state,
             .targets = {{.format = gpu::Format::Rgba8Unorm, .write_mask = mask}}}));
    };
    const auto scene = make_pipeline(plain, gpu::ColorWrite::All);
    const auto counting = make_pipeline(count, gpu::ColorWrite::None);
    const auto make_texture = [&](const char* label, gpu::Format format) {
        return must(device.create_texture({.label = label,
                                           .width = scene_side,
                                           .height = scene_side,
                                           .format = format,
                                           .usage = gpu::TextureUsage::RenderAttachment |
                                                    gpu::TextureUsage::CopySrc |
                                                    gpu::TextureUsage::TextureBinding}));
    };
    SmallScene result{
        .color = make_texture("small colour", gpu::Format::Rgba8Unorm),
        .depth_stencil = make_texture("small depth", gpu::Format::Depth32FloatStencil8)};
    gpu::CommandEncoder encoder = device.create_command_encoder("small scene");
    {
        gpu::RenderPassEncoder pass = encoder.begin_render_pass(
            {.label = "small pass",
             .color_attachments = {{.texture = result.color,
                                    .load_op = gpu::LoadOp::Clear,
                                    .clear_value = {0, 0, 1, 1}}},
             .depth_stencil = gpu::DepthStencilAttachment{.texture = result.depth_stencil,
                                                          .depth_load_op = gpu::LoadOp::Clear,
                                                          .stencil_load_op = gpu::LoadOp::Clear}});
        pass.set_pipeline(scene);
        pass.draw(3);
        pass.push_debug_group("counting");
        pass.set_pipeline(counting);
        pass.draw(3);
        pass.pop_debug_group();
    }
    must(device.submit(must(encoder.finish())));
    return result;
}

}  // namespace gnomon::gl_tests
