// SPDX-License-Identifier: MIT
//
// Drawing: indices, base vertex, instances, vertex formats, dynamic offsets, uniform updates.
#include <gnomon_shaders/conformance.hpp>

#include "tests/conformance/painting.hpp"
#include "tests/conformance/reading_shader.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::conformance {
namespace {

using test::drawing_devices;
using test::must;

constexpr std::uint32_t side = 4;

struct Instance {
    std::array<float, 4> offset;
    std::array<std::uint8_t, 4> tint;
    std::uint32_t tag;
};

class Drawing : public test::DeviceTest {
protected:
    void SetUp() override {
        DeviceTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) return;
        target_ = must(device().create_texture(
            {.label = "drawing",
             .width = side,
             .height = side,
             .format = gpu::Format::Rgba8Unorm,
             .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc}));
        flat_ = make_pipeline(shaders::flat_vert,
                              {{.array_stride = sizeof(Vertex),
                                .attributes = {{gpu::VertexFormat::Float32x4, 0, 0},
                                               {gpu::VertexFormat::Float32x4, 16, 1}}}},
                              {});
    }
    void TearDown() override {
        target_.reset();
        flat_.reset();
        DeviceTest::TearDown();
    }

    gpu::RenderPipeline make_pipeline(const gpu::ShaderSource& vertex,
                                      std::vector<gpu::VertexBufferLayout> buffers,
                                      std::vector<gpu::BindGroupLayoutId> layouts,
                                      const gpu::ShaderSource& fragment = shaders::flat_frag) {
        const auto vertex_shader = make_shader(device(), gpu::ShaderStage::Vertex, vertex);
        const auto fragment_shader = make_shader(device(), gpu::ShaderStage::Fragment, fragment);
        return must(
            device().create_render_pipeline({.label = "drawing",
                                             .bind_group_layouts = std::move(layouts),
                                             .vertex = vertex_shader,
                                             .fragment = fragment_shader,
                                             .vertex_buffers = std::move(buffers),
                                             .targets = {{.format = gpu::Format::Rgba8Unorm}}}));
    }

    /// Clears, records what `record` records, and gives the red channel.
    template <class Record>
    std::vector<int> draw(Record record, std::size_t channel = 0) {
        gpu::CommandEncoder encoder = device().create_command_encoder("drawing");
        {
            gpu::RenderPassEncoder pass = encoder.begin_render_pass(
                {.label = "drawing",
                 .color_attachments = {{.texture = target_, .load_op = gpu::LoadOp::Clear}}});
            record(pass);
        }
        must(device().submit(must(encoder.finish())));
        return channel_of_target(channel);
    }
    std::vector<int> channel_of_target(std::size_t channel) {
        const auto bytes = must(device().read_texture(target_));
        std::vector<int> values;
        for (std::size_t i = channel; i < bytes.size(); i += 4) {
            values.push_back(std::to_integer<int>(bytes[i]));
        }
        return values;
    }

    /// Four columns, one vertex quadruple each; column i is red with value 40 (i + 1).
    static std::vector<Vertex> columns() {
        std::vector<Vertex> vertices;
        for (int i = 0; i < 4; ++i) {
            const float left = -1.0F + 0.5F * static_cast<float>(i);
            const float red = 40.0F * static_cast<float>(i + 1) / 255.0F;
            for (const auto& [x, y] : {std::pair(left, -1.0F), std::pair(left + 0.5F, -1.0F),
                                       std::pair(left + 0.5F, 1.0F), std::pair(left, 1.0F)}) {
                vertices.push_back({x, y, 0.5F, 1, red, 0, 0, 1});
            }
        }
        return vertices;
    }
    static std::vector<int> row_times_four(std::vector<int> row) {
        std::vector<int> all;
        for (int i = 0; i < 4; ++i) all.insert(all.end(), row.begin(), row.end());
        return all;
    }

    gpu::Texture target_;
    gpu::RenderPipeline flat_;
};

TEST_P(Drawing, BothIndexFormatsWithOffsetsAndBaseVertex) {
    const auto vertices = make_buffer(device(), gpu::BufferUsage::Vertex, columns());
    // two words of padding, then a wrong quad that first_index steps over, then the right one
    const std::vector<std::uint32_t> indices{99, 99, 99, 99, 0, 0, 0, 0, 0, 0, 0, 1, 2, 0, 2, 3};
    const std::vector<std::uint16_t> short_indices(indices.begin(), indices.end());
    const auto wide = make_buffer(device(), gpu::BufferUsage::Index, indices);
    const auto narrow = make_buffer(device(), gpu::BufferUsage::Index, short_indices);
    for (const bool is_wide : {true, false}) {
        const auto red = draw([&](gpu::RenderPassEncoder& pass) {
            pass.set_pipeline(flat_);
            pass.set_vertex_buffer(0, vertices);
            if (is_wide) {
                pass.set_index_buffer(wide, gpu::IndexFormat::Uint32, 16);
            } else {
                pass.set_index_buffer(narrow, gpu::IndexFormat::Uint16, 8);
            }
            pass.draw_indexed(6, 1, 6, 4);
            pass.draw_indexed(6, 1, 6, 12);
        });
        EXPECT_EQ(red, row_times_four({0, 80, 0, 160}));
    }
}

TEST_P(Drawing, NegativeBaseVertex) {
    const auto vertices = make_buffer(device(), gpu::BufferUsage::Vertex, columns());
    const auto indices = make_buffer(device(), gpu::BufferUsage::Index,
                                     std::vector<std::uint32_t>{12, 13, 14, 12, 14, 15});
    const auto red = draw([&](gpu::RenderPassEncoder& pass) {
        pass.set_pipeline(flat_);
        pass.set_vertex_buffer(0, vertices);
        pass.set_index_buffer(indices, gpu::IndexFormat::Uint32);
        pass.draw_indexed(6, 1, 0, -12);
    });
    EXPECT_EQ(red, row_times_four({40, 0, 0, 0}));
}

TEST_P(Drawing, FirstVertexAndVertexBufferOffset) {
    std::vector<Vertex> vertices = triangles_of({.right = -0.5F});
    const auto right = triangles_of({.left = 0.5F, .color = {0.2F, 0, 0, 1}});
    vertices.insert(vertices.end(), right.begin(), right.end());
    const auto buffer = make_buffer(device(), gpu::BufferUsage::Vertex, vertices);
    EXPECT_EQ(draw([&](gpu::RenderPassEncoder& pass) {
                  pass.set_pipeline(flat_);
                  pass.set_vertex_buffer(0, buffer);
                  pass.draw(6, 1, 6);
              }),
              row_times_four({0, 0, 0, 51}));
    EXPECT_EQ(draw([&](gpu::RenderPassEncoder& pass) {
                  pass.set_pipeline(flat_);
                  pass.set_vertex_buffer(0, buffer, 6 * sizeof(Vertex));
                  pass.draw(6);
              }),
              row_times_four({0, 0, 0, 51}));
}

TEST_P(Drawing, FlatInputsComeFromTheFirstVertex) {
    const auto pipeline = make_pipeline(
        shaders::provoking_vert,
        {{.array_stride = sizeof(Vertex), .attributes = {{gpu::VertexFormat::Float32x4, 0, 0}}}},
        {}, shaders::provoking_frag);
    for (const bool counter_clockwise : {true, false}) {
        const auto vertices = make_buffer(device(), gpu::BufferUsage::Vertex,
                                          triangles_of({.counter_clockwise = counter_clockwise}));
        const auto indices = make_buffer(device(), gpu::BufferUsage::Index,
                                         std::vector<std::uint32_t>{1, 2, 0, 4, 5, 3});
        const auto red = draw([&](gpu::RenderPassEncoder& pass) {
            pass.set_pipeline(pipeline);
            pass.set_vertex_buffer(0, vertices);
            pass.set_index_buffer(indices, gpu::IndexFormat::Uint32);
            pass.draw_indexed(6);
        });
        for (const int value : red) EXPECT_TRUE(value == 2 || value == 5) << value;
    }
}

TEST_P(Drawing, InstancesStepAndStartWhereTold) {
    const auto pipeline = make_pipeline(
        shaders::instance_vert,
        {{.array_stride = sizeof(Vertex), .attributes = {{gpu::VertexFormat::Float32x4, 0, 0}}},
         {.array_stride = sizeof(Instance),
          .step_mode = gpu::VertexStepMode::Instance,
          .attributes = {{gpu::VertexFormat::Float32x4, 0, 1},
                         {gpu::VertexFormat::Unorm8x4, 16, 2},
                         {gpu::VertexFormat::Uint32, 20, 3}}}},
        {});
    std::vector<Instance> instances;
    for (std::uint32_t i = 0; i < 4; ++i) {
        instances.push_back({.offset = {0.5F * static_cast<float>(i), 0, 0, 0},
                             .tint = {static_cast<std::uint8_t>(10 + i), 0, 0, 0},
                             .tag = 100 + i});
    }
    const auto vertices =
        make_buffer(device(), gpu::BufferUsage::Vertex, triangles_of({.right = -0.5F}));
    const auto instance_buffer = make_buffer(device(), gpu::BufferUsage::Vertex, instances);
    const auto draw_two = [&](gpu::RenderPassEncoder& pass) {
        pass.set_pipeline(pipeline);
        pass.set_vertex_buffer(0, vertices);
        pass.set_vertex_buffer(1, instance_buffer);
        pass.draw(6, 2, 0, 1);
    };
    EXPECT_EQ(draw(draw_two), row_times_four({0, 11, 12, 0})) << "bytes as fractions";
    EXPECT_EQ(channel_of_target(1), row_times_four({0, 101, 102, 0})) << "whole numbers";
    EXPECT_EQ(channel_of_target(2), row_times_four({0, 1, 2, 0}))
        << "the instance's number counts from first_instance";
    // and a pipeline without instances afterwards
    const auto flat_vertices = make_buffer(device(), gpu::BufferUsage::Vertex, columns());
    EXPECT_EQ(draw([&](gpu::RenderPassEncoder& pass) {
                  draw_two(pass);
                  pass.set_pipeline(flat_);
                  pass.set_vertex_buffer(0, flat_vertices);
                  pass.draw(3, 1, 12);
                  pass.draw(3, 1, 13);
              })[3],
              160);
}

TEST_P(Drawing, DynamicOffsetsChooseTheBlock) {
    const auto layout = must(
        device().create_bind_group_layout({.label = "block",
                                           .entries = {{.binding = 0,
                                                        .visibility = gpu::ShaderStage::Vertex,
                                                        .type = gpu::BindingType::UniformBuffer,
                                                        .has_dynamic_offset = true,
                                                        .min_binding_size = 16}}}));
    const auto pipeline = make_pipeline(
        shaders::uniform_vert,
        {{.array_stride = sizeof(Vertex), .attributes = {{gpu::VertexFormat::Float32x4, 0, 0}}}},
        {layout});
    const std::uint32_t step =
        std::max<std::uint32_t>(device().caps().limits.min_uniform_buffer_offset_alignment, 16);
    std::vector<float> blocks(std::size_t{step} / 4 * 5);
    for (std::size_t i = 0; i < 5; ++i) {
        blocks[i * step / 4] = 50.0F * static_cast<float>(i) / 255.0F;
    }
    const auto uniforms = make_buffer(device(), gpu::BufferUsage::Uniform, blocks);
    const auto vertices = make_buffer(device(), gpu::BufferUsage::Vertex, triangles_of({}));
    const auto group = must(device().create_bind_group(
        {.label = "block",
         .layout = layout,
         .entries = {{.binding = 0, .buffer = uniforms, .offset = step, .size = 16}}}));
    const auto draw_columns = [&](gpu::RenderPassEncoder& pass) {
        pass.set_pipeline(pipeline);
        pass.set_vertex_buffer(0, vertices);
        for (std::uint32_t i = 0; i < 4; ++i) {
            const std::array<std::uint32_t, 1> offsets{i * step};
            pass.set_bind_group(0, group, offsets);
            pass.set_scissor_rect(i, 0, 1, 4);
            pass.draw(6);
        }
    };
    EXPECT_EQ(draw(draw_columns), row_times_four({50, 100, 150, 200}));

    // A write after the submission must not reach it; the next submission sees it.
    gpu::CommandEncoder encoder = device().create_command_encoder("before the write");
    {
        gpu::RenderPassEncoder pass = encoder.begin_render_pass(
            {.color_attachments = {{.texture = target_, .load_op = gpu::LoadOp::Clear}}});
        draw_columns(pass);
    }
    must(device().submit(must(encoder.finish())));
    const std::array<float, 4> white{1, 0, 0, 0};
    must(device().write_buffer(uniforms, step, std::as_bytes(std::span(white))));
    EXPECT_EQ(channel_of_target(0), row_times_four({50, 100, 150, 200}));
    EXPECT_EQ(draw(draw_columns), row_times_four({255, 100, 150, 200}));
}

INSTANTIATE_TEST_SUITE_P(Devices, Drawing, testing::ValuesIn(drawing_devices()),
                         test::device_case_name);

}  // namespace
}  // namespace gnomon::conformance
