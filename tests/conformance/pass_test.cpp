// SPDX-License-Identifier: MIT
//
// Several passes in one command buffer: state of one pass does not leak into the next, and the
// clears of a later pass reach what the draws of an earlier one were kept from.
#include <gnomon_shaders/conformance.hpp>

#include "tests/conformance/painting.hpp"
#include "tests/conformance/reading_shader.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::conformance {
namespace {

using test::drawing_devices;
using test::must;

class Passes : public test::DeviceTest {
protected:
    void SetUp() override {
        DeviceTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) return;
        color_ = make_texture(gpu::Format::Rgba8Unorm);
        depth_stencil_ = make_texture(gpu::Format::Depth32FloatStencil8);
        vertices_ = make_buffer(device(), gpu::BufferUsage::Vertex, triangles_of({.z = 0.75F}));
        const auto vertex = make_shader(device(), gpu::ShaderStage::Vertex, shaders::flat_vert);
        const auto fragment = make_shader(device(), gpu::ShaderStage::Fragment, shaders::flat_frag);
        const gpu::StencilFaceState replace{.pass_op = gpu::StencilOp::Replace};
        // writes red alone, four stencil bits alone, and no depth
        masked_ = must(device().create_render_pipeline(
            {.label = "masked",
             .vertex = vertex,
             .fragment = fragment,
             .vertex_buffers = {{.array_stride = sizeof(Vertex),
                                 .attributes = {{gpu::VertexFormat::Float32x4, 0, 0},
                                                {gpu::VertexFormat::Float32x4, 16, 1}}}},
             .depth_stencil = gpu::DepthStencilState{.format = gpu::Format::Depth32FloatStencil8,
                                                     .depth_compare = gpu::Compare::Greater,
                                                     .stencil_front = replace,
                                                     .stencil_back = replace,
                                                     .stencil_write_mask = 0x0F},
             .targets = {
                 {.format = gpu::Format::Rgba8Unorm, .write_mask = gpu::ColorWrite::Red}}}));
    }
    void TearDown() override {
        color_.reset();
        depth_stencil_.reset();
        vertices_.reset();
        masked_.reset();
        DeviceTest::TearDown();
    }
    gpu::Texture make_texture(gpu::Format format) {
        return must(device().create_texture(
            {.label = "passes",
             .width = 4,
             .height = 4,
             .format = format,
             .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc}));
    }
    [[nodiscard]] gpu::RenderPassDesc clearing_pass() const {
        return {.label = "clearing",
                .color_attachments = {{.texture = color_,
                                       .load_op = gpu::LoadOp::Clear,
                                       .clear_value = {0.2, 0.4, 0.6, 0.8}}},
                .depth_stencil = gpu::DepthStencilAttachment{.texture = depth_stencil_,
                                                             .depth_load_op = gpu::LoadOp::Clear,
                                                             .depth_clear_value = 0.5F,
                                                             .stencil_load_op = gpu::LoadOp::Clear,
                                                             .stencil_clear_value = 0xC6}};
    }
    void draw_masked(gpu::RenderPassEncoder& pass) const {
        pass.set_pipeline(masked_);
        pass.set_vertex_buffer(0, vertices_);
        pass.set_stencil_reference(0x39);
        pass.draw(6);
    }
    void expect_pixel(std::size_t index, std::array<int, 4> color, int stencil) {
        const auto colors = must(device().read_texture(color_));
        for (std::size_t channel = 0; channel < 4; ++channel) {
            EXPECT_EQ(std::to_integer<int>(colors[index * 4 + channel]), color[channel])
                << "pixel " << index << ", channel " << channel;
        }
        const auto stencils = must(device().read_texture(depth_stencil_, gpu::Aspect::StencilOnly));
        EXPECT_EQ(std::to_integer<int>(stencils[index]), stencil) << "pixel " << index;
    }

    void expect_depth_is_half() {
        const auto bytes = must(device().read_texture(depth_stencil_, gpu::Aspect::DepthOnly));
        EXPECT_EQ(texels_as<float>(bytes), std::vector<float>(16, 0.5F));
    }

    gpu::Texture color_, depth_stencil_;
    gpu::Buffer vertices_;
    gpu::RenderPipeline masked_;
};

TEST_P(Passes, ALaterClearReachesEverything) {
    gpu::CommandEncoder encoder = device().create_command_encoder("passes");
    {
        // the opposite of what the later pass clears to, bit by bit
        gpu::RenderPassDesc opposite = clearing_pass();
        opposite.color_attachments[0].clear_value = {0.8, 0.6, 0.4, 0.2};
        opposite.depth_stencil->depth_clear_value = 0.25F;
        opposite.depth_stencil->stencil_clear_value = 0x39;
        gpu::RenderPassEncoder pass = encoder.begin_render_pass(opposite);
        pass.set_scissor_rect(0, 0, 1, 1);
        pass.set_viewport(0, 0, 2, 2);
        draw_masked(pass);
    }
    encoder.begin_render_pass(clearing_pass()).end();
    must(device().submit(must(encoder.finish())));
    for (const std::size_t pixel : {0U, 1U, 15U}) expect_pixel(pixel, {51, 102, 153, 204}, 0xC6);
    expect_depth_is_half();
}

TEST_P(Passes, MasksHoldAgainAfterAClear) {
    gpu::CommandEncoder encoder = device().create_command_encoder("passes");
    for (int i = 0; i < 2; ++i) {
        gpu::RenderPassEncoder pass = encoder.begin_render_pass(clearing_pass());
        draw_masked(pass);
    }
    must(device().submit(must(encoder.finish())));
    for (const std::size_t pixel : {0U, 15U}) expect_pixel(pixel, {255, 102, 153, 204}, 0xC9);
    expect_depth_is_half();
}

TEST_P(Passes, StencilReferenceAndViewportStartAfresh) {
    gpu::CommandEncoder encoder = device().create_command_encoder("passes");
    {
        gpu::RenderPassEncoder pass = encoder.begin_render_pass(clearing_pass());
        pass.set_viewport(0, 0, 1, 1);
        pass.set_scissor_rect(0, 0, 1, 1);
        draw_masked(pass);
    }
    {
        gpu::RenderPassEncoder pass = encoder.begin_render_pass(clearing_pass());
        pass.set_pipeline(masked_);
        pass.set_vertex_buffer(0, vertices_);
        pass.draw(6);  // the reference is 0 again, the viewport the whole picture
    }
    must(device().submit(must(encoder.finish())));
    for (const std::size_t pixel : {0U, 15U}) expect_pixel(pixel, {255, 102, 153, 204}, 0xC0);
}

TEST_P(Passes, ResolveReachesAllPixelsAfterAScissor) {
    if (!features().multisample_4) GTEST_SKIP() << "no multisample_4";
    Painting painting(device(), {.sample_count = 4, .clear_color = {1, 0, 0, 1}});
    painting.paint({{.vertices = triangles_of({.color = {0, 1, 0, 1}}),
                     .scissor = gpu::cmd::SetScissorRect{0, 0, 1, 1}}});
    EXPECT_EQ(painting.pixel(0, 0), (std::array<int, 4>{0, 255, 0, 255}));
    EXPECT_EQ(painting.pixel(3, 3), (std::array<int, 4>{255, 0, 0, 255}));
}

INSTANTIATE_TEST_SUITE_P(Devices, Passes, testing::ValuesIn(drawing_devices()),
                         test::device_case_name);

}  // namespace
}  // namespace gnomon::conformance
