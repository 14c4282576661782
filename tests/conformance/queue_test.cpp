// SPDX-License-Identifier: MIT
//
// Buffers in queue order, and contents that start as zero.
#include <cstring>
#include <numeric>

#include "tests/conformance/painting.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::conformance {
namespace {

using test::drawing_devices;
using test::must;

constexpr gpu::BufferUsage both_ways = gpu::BufferUsage::CopySrc | gpu::BufferUsage::CopyDst;

class Queue : public test::DeviceTest {
protected:
    gpu::Buffer make(std::uint64_t size) {
        return must(device().create_buffer({.label = "queue", .size = size, .usage = both_ways}));
    }
    void write(const gpu::Buffer& buffer, const std::vector<std::uint32_t>& words,
               std::uint64_t offset = 0) {
        must(device().write_buffer(buffer, offset, std::as_bytes(std::span(words))));
    }
    std::vector<std::uint32_t> words_of(const gpu::Buffer& buffer, std::uint64_t count) {
        const auto bytes = must(device().read_buffer(buffer, 0, count * 4));
        std::vector<std::uint32_t> words(count);
        std::memcpy(words.data(), bytes.data(), bytes.size());
        return words;
    }
    void copy(const gpu::Buffer& from, std::uint64_t from_offset, const gpu::Buffer& to,
              std::uint64_t to_offset, std::uint64_t size) {
        gpu::CommandEncoder encoder = device().create_command_encoder("copy");
        encoder.copy_buffer_to_buffer(from, from_offset, to, to_offset, size);
        must(device().submit(must(encoder.finish())));
    }
};

TEST_P(Queue, WritesAndSubmissionsKeepTheirOrder) {
    const auto source = make(4);
    const auto first = make(4);
    const auto second = make(4);
    write(source, {1});
    copy(source, 0, first, 0, 4);
    write(source, {2});
    copy(source, 0, second, 0, 4);
    write(source, {3});
    EXPECT_EQ(words_of(first, 1), std::vector<std::uint32_t>{1});
    EXPECT_EQ(words_of(second, 1), std::vector<std::uint32_t>{2});
    EXPECT_EQ(words_of(source, 1), std::vector<std::uint32_t>{3});
}

TEST_P(Queue, CopiesTakeOffsets) {
    const auto source = make(32);
    const auto target = make(32);
    write(source, {10, 11, 12, 13, 14, 15, 16, 17});
    copy(source, 8, target, 16, 12);
    EXPECT_EQ(words_of(target, 8), (std::vector<std::uint32_t>{0, 0, 0, 0, 12, 13, 14, 0}));
}

TEST_P(Queue, WritesTakeOffsets) {
    const auto buffer = make(16);
    write(buffer, {1, 2, 3, 4});
    write(buffer, {9}, 8);
    EXPECT_EQ(words_of(buffer, 4), (std::vector<std::uint32_t>{1, 2, 9, 4}));
}

TEST_P(Queue, BuffersStartAsZero) {
    // Memory that was used before is what a driver hands out again.
    constexpr std::uint64_t count = 65536;
    for (int round = 0; round < 4; ++round) {
        const auto buffer = make(count * 4);
        EXPECT_EQ(words_of(buffer, count), std::vector<std::uint32_t>(count, 0));
        write(buffer, std::vector<std::uint32_t>(count, 0xDEADBEEF));
        must(device().wait_idle());
    }
}

// What makes a buffer zero must be over before it is written.
TEST_P(Queue, WhatIsWrittenToANewBufferStays) {
    for (const std::uint64_t count : {256U, 16384U, 1U << 18U, 1U << 21U}) {
        std::vector<std::uint32_t> words(count);
        std::iota(words.begin(), words.end(), 1U);
        for (int round = 0; round < 4; ++round) {
            const auto buffer = make(count * 4);
            const auto copied = make(count * 4);
            write(buffer, words);
            copy(buffer, 0, copied, 0, count * 4);
            EXPECT_EQ(words_of(buffer, count), words);
            EXPECT_EQ(words_of(copied, count), words);
        }
    }
}

TEST_P(Queue, TexturesStartAsZero) {
    for (const gpu::Format format :
         {gpu::Format::R8Unorm, gpu::Format::R8Uint, gpu::Format::R32Uint, gpu::Format::R32Float,
          gpu::Format::Rgba8Unorm, gpu::Format::Rgba8UnormSrgb, gpu::Format::Rgba16Float,
          gpu::Format::Rgba32Float, gpu::Format::Rgba32Uint}) {
        for (int round = 0; round < 3; ++round) {
            const auto texture = must(device().create_texture(
                {.label = "zero",
                 .width = 128,
                 .height = 128,
                 .format = format,
                 .usage = gpu::TextureUsage::CopySrc | gpu::TextureUsage::CopyDst |
                          gpu::TextureUsage::TextureBinding}));
            const auto bytes = must(device().read_texture(texture));
            EXPECT_EQ(bytes, std::vector<std::byte>(bytes.size(), std::byte{0}))
                << "format " << static_cast<int>(format);
            must(device().write_texture(texture, 0,
                                        std::vector<std::byte>(bytes.size(), std::byte{0x3C})));
            must(device().wait_idle());
        }
    }
}

TEST_P(Queue, DepthAndStencilStartAsZero) {
    for (int round = 0; round < 3; ++round) {
        const gpu::StencilFaceState invert{.pass_op = gpu::StencilOp::Invert};
        Painting painting(device(), {.width = 64, .height = 64, .clear_depth = 0.5F});
        painting.paint_over({});  // a pass that loads what is there
        EXPECT_EQ(painting.depth(), std::vector<float>(64 * 64, 0.0F));
        EXPECT_EQ(painting.stencil(), std::vector<std::uint8_t>(64 * 64, 0));
        painting.paint_over({{.depth_stencil = {.depth_write_enabled = true,
                                                .depth_compare = gpu::Compare::Always,
                                                .stencil_front = invert,
                                                .stencil_back = invert}}});
        EXPECT_EQ(painting.stencil(), std::vector<std::uint8_t>(64 * 64, 255));
    }
}

INSTANTIATE_TEST_SUITE_P(Devices, Queue, testing::ValuesIn(drawing_devices()),
                         test::device_case_name);

}  // namespace
}  // namespace gnomon::conformance
