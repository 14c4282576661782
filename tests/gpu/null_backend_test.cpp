// SPDX-License-Identifier: MIT
//
// What the null backend keeps: buffers, textures, clears, resolves, copies, queries.
#include <array>
#include <cstring>

#include "world.hpp"

namespace gnomon::gpu::test {
namespace {

std::vector<std::byte> counting_bytes(std::size_t size) {
    std::vector<std::byte> bytes(size);
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i + 1);
    return bytes;
}

template <class T>
std::vector<T> values(const std::vector<std::byte>& bytes) {
    std::vector<T> result(bytes.size() / sizeof(T));
    std::memcpy(result.data(), bytes.data(), bytes.size());
    return result;
}

class NullBackend : public testing::Test {
protected:
    Texture target(Format format, std::uint32_t samples = 1) {
        TextureDesc desc = target_desc("target", format, samples);
        desc.width = 2;
        desc.height = 1;
        return take(w_.device.create_texture(desc));
    }
    void run(const RenderPassDesc& desc) {
        const auto finished = w_.record_pass(desc, [](RenderPassEncoder&) {});
        ASSERT_TRUE(finished.has_value()) << finished.error().message;
        expect_outcome(w_.device.submit(*finished), valid);
    }
    template <class T>
    std::vector<T> read(TextureId texture, Aspect aspect = Aspect::Color) {
        return values<T>(take(w_.device.read_texture(texture, aspect)));
    }

    World w_;
};

TEST_F(NullBackend, BuffersStartAsZeroAndKeepWhatIsWritten) {
    const Buffer buffer =
        w_.buffer("b", 16, BufferUsage::CopyDst | BufferUsage::CopySrc | BufferUsage::Vertex);
    EXPECT_EQ(take(w_.device.read_buffer(buffer, 0, 16)), std::vector<std::byte>(16));
    const std::vector<std::byte> data = counting_bytes(8);
    expect_outcome(w_.device.write_buffer(buffer, 4, data), valid);
    std::vector<std::byte> expected(16);
    std::copy(data.begin(), data.end(), expected.begin() + 4);
    EXPECT_EQ(take(w_.device.read_buffer(buffer, 0, 16)), expected);
    EXPECT_EQ(take(w_.device.read_buffer(buffer, 4, 8)), data);
}

TEST_F(NullBackend, CopiesRun) {
    const Buffer source = w_.buffer("s", 16, BufferUsage::CopyDst | BufferUsage::CopySrc);
    const Buffer destination = w_.buffer("d", 16, BufferUsage::CopyDst | BufferUsage::CopySrc);
    const std::vector<std::byte> data = counting_bytes(16);
    expect_outcome(w_.device.write_buffer(source, 0, data), valid);
    CommandEncoder encoder = w_.device.create_command_encoder();
    encoder.copy_buffer_to_buffer(source, 4, destination, 8, 8);
    expect_outcome(w_.device.submit(take(encoder.finish())), valid);
    std::vector<std::byte> expected(16);
    std::copy_n(data.begin() + 4, 8, expected.begin() + 8);
    EXPECT_EQ(take(w_.device.read_buffer(destination, 0, 16)), expected);
}

TEST_F(NullBackend, TexturesKeepWhatIsWritten) {
    const Texture texture = take(w_.device.create_texture(
        {"t", 4, 2, Format::R8Unorm, TextureUsage::CopyDst | TextureUsage::CopySrc, 3}));
    EXPECT_EQ(read<std::byte>(texture), std::vector<std::byte>(8));
    const std::vector<std::byte> data = counting_bytes(8);
    expect_outcome(w_.device.write_texture(texture, 0, data), valid);
    expect_outcome(w_.device.write_texture(texture, 1, std::vector<std::byte>(2)), valid);
    expect_outcome(w_.device.write_texture(texture, 2, std::vector<std::byte>(1)), valid);
    EXPECT_EQ(read<std::byte>(texture), data);
}

TEST_F(NullBackend, ColorIsClearedInEveryFormat) {
    const Color color{.r = 0.5, .g = 2.0, .b = -1.0, .a = 0.25};
    const auto clear = [&](Format format, Color value) {
        Texture texture = target(format);
        run({.color_attachments = {
                 {.texture = texture, .load_op = LoadOp::Clear, .clear_value = value}}});
        return texture;
    };
    using Bytes = std::vector<std::uint8_t>;
    EXPECT_EQ(read<std::uint8_t>(clear(Format::R8Unorm, color)), (Bytes{128, 128}));
    EXPECT_EQ(read<std::uint8_t>(clear(Format::R8Uint, {.r = 200})), (Bytes{200, 200}));
    EXPECT_EQ(read<std::uint32_t>(clear(Format::R32Uint, {.r = 4294967295.0})),
              (std::vector<std::uint32_t>{4294967295U, 4294967295U}));
    EXPECT_EQ(read<float>(clear(Format::R32Float, {.r = -3.5})), (std::vector<float>{-3.5, -3.5}));
    EXPECT_EQ(read<std::uint8_t>(clear(Format::Rgba8Unorm, color)),
              (Bytes{128, 255, 0, 64, 128, 255, 0, 64}));
    EXPECT_EQ(read<std::uint8_t>(clear(Format::Rgba8UnormSrgb, color)),
              (Bytes{188, 255, 0, 64, 188, 255, 0, 64}));
    EXPECT_EQ(read<std::uint16_t>(clear(Format::Rgba16Float, color)),
              (std::vector<std::uint16_t>{0x3800, 0x4000, 0xBC00, 0x3400, 0x3800, 0x4000, 0xBC00,
                                          0x3400}));
    EXPECT_EQ(read<float>(clear(Format::Rgba32Float, color)),
              (std::vector<float>{0.5, 2, -1, 0.25, 0.5, 2, -1, 0.25}));
    EXPECT_EQ(read<std::uint32_t>(clear(Format::Rgba32Uint, {.r = 1, .g = 2, .b = 3, .a = 4})),
              (std::vector<std::uint32_t>{1, 2, 3, 4, 1, 2, 3, 4}));
}

TEST_F(NullBackend, DepthAndStencilAreClearedApart) {
    const Texture texture = target(Format::Depth32FloatStencil8);
    DepthStencilAttachment attachment{.texture = texture,
                                      .depth_load_op = LoadOp::Clear,
                                      .depth_clear_value = 0.25F,
                                      .stencil_load_op = LoadOp::Clear,
                                      .stencil_clear_value = 7};
    run({.depth_stencil = attachment});
    EXPECT_EQ(read<float>(texture, Aspect::DepthOnly), (std::vector<float>{0.25F, 0.25F}));
    EXPECT_EQ(read<std::uint8_t>(texture, Aspect::StencilOnly), (std::vector<std::uint8_t>{7, 7}));
    attachment.depth_load_op = LoadOp::Load;
    attachment.stencil_clear_value = 9;
    run({.depth_stencil = attachment});
    EXPECT_EQ(read<float>(texture, Aspect::DepthOnly), (std::vector<float>{0.25F, 0.25F}));
    EXPECT_EQ(read<std::uint8_t>(texture, Aspect::StencilOnly), (std::vector<std::uint8_t>{9, 9}));
}

TEST_F(NullBackend, Depth24IsRoundedToItsSteps) {
    const Texture texture = target(Format::Depth24UnormStencil8);
    run({.depth_stencil = DepthStencilAttachment{
             .texture = texture, .depth_load_op = LoadOp::Clear, .depth_clear_value = 1.0e-9F}});
    EXPECT_EQ(read<float>(texture, Aspect::DepthOnly).front(), 0.0F);
    run({.depth_stencil = DepthStencilAttachment{
             .texture = texture, .depth_load_op = LoadOp::Clear, .depth_clear_value = 1.0F}});
    EXPECT_EQ(read<float>(texture, Aspect::DepthOnly).front(), 1.0F);
}

TEST_F(NullBackend, ResolvesAndDiscards) {
    const Texture four = target(Format::Rgba8Unorm, 4);
    const Texture one = target(Format::Rgba8Unorm);
    const Texture depth = target(Format::Depth32FloatStencil8, 4);
    run({.color_attachments = {{.texture = four,
                                .resolve_target = one,
                                .load_op = LoadOp::Clear,
                                .store_op = StoreOp::Discard,
                                .clear_value = {.r = 1.0, .a = 1.0}}},
         .depth_stencil = DepthStencilAttachment{.texture = depth,
                                                 .depth_store_op = StoreOp::Discard,
                                                 .stencil_store_op = StoreOp::Discard}});
    const std::vector<std::uint8_t> red{255, 0, 0, 255, 255, 0, 0, 255};
    EXPECT_EQ(read<std::uint8_t>(one), red);
    // The source was discarded: resolving it once more gives zero.
    run({.color_attachments = {{.texture = four, .resolve_target = one}}});
    EXPECT_EQ(read<std::uint8_t>(one), std::vector<std::uint8_t>(8));
}

TEST_F(NullBackend, DiscardedDepthAndStencilReadAsZero) {
    const Texture texture = target(Format::Depth32FloatStencil8);
    run({.depth_stencil = DepthStencilAttachment{.texture = texture,
                                                 .depth_load_op = LoadOp::Clear,
                                                 .depth_store_op = StoreOp::Discard,
                                                 .depth_clear_value = 0.5F,
                                                 .stencil_load_op = LoadOp::Clear,
                                                 .stencil_store_op = StoreOp::Discard,
                                                 .stencil_clear_value = 5}});
    EXPECT_EQ(read<float>(texture, Aspect::DepthOnly), std::vector<float>(2));
    EXPECT_EQ(read<std::uint8_t>(texture, Aspect::StencilOnly), std::vector<std::uint8_t>(2));
}

TEST_F(NullBackend, Queries) {
    RenderPassDesc desc = w_.pass_desc();
    desc.timestamp_writes = TimestampWrites{w_.timestamps, 1, 0};
    const auto finished = w_.record_pass(desc, [&](RenderPassEncoder& pass) {
        w_.set_state(pass);
        pass.begin_occlusion_query(1);
        pass.draw(3);
        pass.end_occlusion_query();
    });
    ASSERT_TRUE(finished.has_value()) << finished.error().message;
    expect_outcome(w_.device.submit(*finished), valid);
    EXPECT_EQ(take(w_.device.read_query_set(w_.occlusion)), (std::vector<std::uint64_t>{0, 0}));
    const auto first = take(w_.device.read_query_set(w_.timestamps));
    EXPECT_GT(first[0], first[1]);
    expect_outcome(w_.device.submit(*finished), valid);
    EXPECT_GT(take(w_.device.read_query_set(w_.timestamps))[1], first[0]);
}

TEST_F(NullBackend, SaysWhatItIs) {
    EXPECT_EQ(w_.device.caps().backend, "null");
    EXPECT_EQ(w_.device.caps().stencil_path, "native");
    expect_outcome(w_.device.wait_idle(), valid);
}

}  // namespace
}  // namespace gnomon::gpu::test
