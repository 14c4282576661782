// SPDX-License-Identifier: MIT
//
// What is written between submissions is seen by the later ones alone, and contents that nothing
// has written are zero.
#include <cstring>

#include "tests/vk/fixture.hpp"

namespace gnomon::vk_test {
namespace {

class Order : public DeviceFixture {
protected:
    gpu::Texture make_depth_stencil(gpu::Format format) {
        return must(device->create_texture(
            {.label = "depth",
             .width = 8,
             .height = 8,
             .format = format,
             .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc}));
    }
    void run(const gpu::DepthStencilAttachment& attachment) {
        gpu::CommandEncoder encoder = device->create_command_encoder("clear");
        encoder.begin_render_pass({.label = "clear", .depth_stencil = attachment}).end();
        must(device->submit(must(encoder.finish())));
    }
    float depth_of(const gpu::Texture& texture) {
        const auto bytes = must(device->read_texture(texture, gpu::Aspect::DepthOnly));
        float depth = 0;
        std::memcpy(&depth, bytes.data() + bytes.size() - sizeof depth, sizeof depth);
        return depth;
    }
    int stencil_of(const gpu::Texture& texture) {
        const auto bytes = must(device->read_texture(texture, gpu::Aspect::StencilOnly));
        return std::to_integer<int>(bytes.back());
    }
};

TEST_F(Order, UniformsWrittenBetweenDrawsBelongToTheLaterOne) {
    Painter painter{*device, 64, 64};
    std::vector<gpu::Texture> targets;
    for (int i = 0; i < 20; ++i) {
        targets.push_back(painter.make_target());
        painter.set_color(static_cast<float>(i) / 255.0F, 0, 1);
        painter.fill(targets.back());
    }
    painter.set_color(1, 1, 1);
    for (int i = 0; i < 20; ++i) {
        EXPECT_EQ(painter.read_uniform(targets[static_cast<std::size_t>(i)]),
                  (Rgba8{static_cast<std::uint8_t>(i), 0, 255, 255}));
    }
}

TEST_F(Order, TexturesPassBetweenDrawingSamplingAndReading) {
    Painter painter{*device, 8, 8};
    const gpu::Texture a = painter.make_target();
    const gpu::Texture b = painter.make_target();
    painter.set_color(0, 1, 0);
    painter.fill(a);
    for (int i = 0; i < 4; ++i) {
        painter.copy(a, b);
        painter.copy(b, a);
    }
    EXPECT_EQ(painter.read_uniform(b), (Rgba8{0, 255, 0, 255}));
    painter.copy(a, b);
    EXPECT_EQ(painter.read_uniform(a), (Rgba8{0, 255, 0, 255}));
}

TEST_F(Order, OverlappingWritesKeepTheirOrder) {
    const gpu::Buffer buffer = must(
        device->create_buffer({.label = "overlap",
                               .size = 12,
                               .usage = gpu::BufferUsage::CopySrc | gpu::BufferUsage::CopyDst}));
    const std::array<std::uint32_t, 2> ones{1, 1};
    const std::array<std::uint32_t, 2> twos{2, 2};
    must(device->write_buffer(buffer, 0, std::as_bytes(std::span{ones})));
    must(device->write_buffer(buffer, 4, std::as_bytes(std::span{twos})));
    must(device->write_buffer(buffer, 0, std::as_bytes(std::span{ones}.first(1))));
    const auto bytes = must(device->read_buffer(buffer, 0, 12));
    std::array<std::uint32_t, 3> words{};
    std::memcpy(words.data(), bytes.data(), bytes.size());
    EXPECT_EQ(words, (std::array<std::uint32_t, 3>{1, 2, 2}));
}

TEST_F(Order, FreshTexturesAreZeroForEveryKindOfRead) {
    Painter painter{*device, 8, 8};
    EXPECT_EQ(painter.read_uniform(painter.make_target()), (Rgba8{0, 0, 0, 0}));
    const gpu::Texture sampled = painter.make_target();
    const gpu::Texture target = painter.make_target();
    painter.set_color(1, 1, 1);
    painter.fill(target);
    painter.copy(sampled, target);
    EXPECT_EQ(painter.read_uniform(target), (Rgba8{0, 0, 0, 0}));
}

TEST_F(Order, DepthAndStencilReadBackInBothFormats) {
    const gpu::Features& features = device->caps().features;
    for (const auto& [format, there] :
         {std::pair{gpu::Format::Depth24UnormStencil8, features.depth24unorm_stencil8},
          std::pair{gpu::Format::Depth32FloatStencil8, features.depth32float_stencil8}}) {
        if (!there) {
            continue;
        }
        SCOPED_TRACE(static_cast<int>(format));
        const gpu::Texture texture = make_depth_stencil(format);
        EXPECT_EQ(depth_of(texture), 0.0F);
        EXPECT_EQ(stencil_of(texture), 0);
        run({.texture = texture,
             .depth_load_op = gpu::LoadOp::Clear,
             .depth_clear_value = 0.25F,
             .stencil_load_op = gpu::LoadOp::Clear,
             .stencil_clear_value = 200});
        EXPECT_NEAR(depth_of(texture), 0.25F, 1.0F / 16777215.0F);
        EXPECT_EQ(stencil_of(texture), 200);
        run({.texture = texture,
             .depth_read_only = true,
             .stencil_load_op = gpu::LoadOp::Clear,
             .stencil_clear_value = 7});
        EXPECT_NEAR(depth_of(texture), 0.25F, 1.0F / 16777215.0F);
        EXPECT_EQ(stencil_of(texture), 7);
    }
}

TEST_F(Order, DiscardedAspectsAreZeroAndTheOtherStays) {
    if (!device->caps().features.depth32float_stencil8) {
        GTEST_SKIP() << "The adapter lacks Depth32FloatStencil8.";
    }
    const gpu::Texture texture = make_depth_stencil(gpu::Format::Depth32FloatStencil8);
    const auto clear = [&](gpu::StoreOp depth_store, gpu::StoreOp stencil_store) {
        run({.texture = texture,
             .depth_load_op = gpu::LoadOp::Clear,
             .depth_store_op = depth_store,
             .depth_clear_value = 0.5F,
             .stencil_load_op = gpu::LoadOp::Clear,
             .stencil_store_op = stencil_store,
             .stencil_clear_value = 9});
    };
    clear(gpu::StoreOp::Store, gpu::StoreOp::Discard);
    EXPECT_EQ(depth_of(texture), 0.5F);
    EXPECT_EQ(stencil_of(texture), 0);
    clear(gpu::StoreOp::Discard, gpu::StoreOp::Store);
    EXPECT_EQ(depth_of(texture), 0.0F);
    EXPECT_EQ(stencil_of(texture), 9);
    clear(gpu::StoreOp::Store, gpu::StoreOp::Discard);
    run({.texture = texture});  // loads both
    EXPECT_EQ(depth_of(texture), 0.5F);
    EXPECT_EQ(stencil_of(texture), 0);
}

TEST_F(Order, UnusedQueriesAreZeroAndTimesRise) {
    if (!device->caps().features.timestamp_query) {
        GTEST_SKIP() << "The adapter lacks timestamps.";
    }
    const gpu::QuerySet times = must(device->create_query_set(
        {.label = "times", .type = gpu::QueryType::Timestamp, .count = 4}));
    EXPECT_EQ(must(device->read_query_set(times)), std::vector<std::uint64_t>(4, 0));
    Painter painter{*device, 256, 256};
    const gpu::Texture target = painter.make_target();
    for (int i = 0; i < 2; ++i) {
        gpu::CommandEncoder encoder = device->create_command_encoder("timed");
        encoder
            .begin_render_pass(
                {.label = "timed",
                 .color_attachments = {{.texture = target, .load_op = gpu::LoadOp::Clear}},
                 .timestamp_writes =
                     gpu::TimestampWrites{
                         .query_set = times, .beginning_index = 3, .end_index = 1}})
            .end();
        must(device->submit(must(encoder.finish())));
        const std::vector<std::uint64_t> values = must(device->read_query_set(times));
        EXPECT_EQ(values[0], 0U);
        EXPECT_EQ(values[2], 0U);
        EXPECT_GT(values[3], 0U);
        EXPECT_GE(values[1], values[3]);
        EXPECT_LT(values[1] - values[3], 60'000'000'000U) << "a clear takes less than a minute";
    }
}

}  // namespace
}  // namespace gnomon::vk_test
