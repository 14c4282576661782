// SPDX-License-Identifier: MIT
//
// Objects that die while the device still uses them, many of them, large ones, and devices that
// come and go. The validation layer watches, and speaks when anything is left behind.
#include <gmock/gmock.h>

#include <sys/resource.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

#include "tests/vk/fixture.hpp"

namespace gnomon::vk_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class Lifetime : public DeviceFixture {};

constexpr gpu::BufferUsage both_ways = gpu::BufferUsage::CopySrc | gpu::BufferUsage::CopyDst;

TEST_F(Lifetime, ObjectsMayDieWhileInFlight) {
    Painter kept{*device, 16, 16};
    const gpu::Texture last = kept.make_target();
    for (int i = 0; i < 30; ++i) {
        const gpu::Texture target = kept.make_target();
        {
            // Pipelines, bind groups, buffers and a texture of its own, gone before it is drawn.
            Painter passing{*device, 16, 16};
            const gpu::Texture source = passing.make_target();
            passing.set_color(static_cast<float>(i) / 255.0F, 0, 0);
            passing.fill(source);
            passing.copy(source, target);
        }
        kept.copy(target, last);
    }
    EXPECT_EQ(kept.read_uniform(last), (Rgba8{29, 0, 0, 255}));
}

TEST_F(Lifetime, WrittenButNeverSubmittedIsFreedToo) {
    const std::array<std::byte, 16> zeros{};
    for (int i = 0; i < 10; ++i) {
        const gpu::Buffer buffer =
            must(device->create_buffer({.label = "unused", .size = 16, .usage = both_ways}));
        must(device->write_buffer(buffer, 0, zeros));
    }
}

TEST_F(Lifetime, DescriptorPoolsGrow) {
    const gpu::BindGroupLayout layout = must(device->create_bind_group_layout(
        {.label = "many", .entries = {{.binding = 0, .visibility = gpu::ShaderStage::Fragment}}}));
    const gpu::Buffer buffer = must(
        device->create_buffer({.label = "many", .size = 16, .usage = gpu::BufferUsage::Uniform}));
    for (int round = 0; round < 3; ++round) {
        std::vector<gpu::BindGroup> groups;
        for (int i = 0; i < 1000; ++i) {
            groups.push_back(
                must(device->create_bind_group({.label = "many",
                                                .layout = layout,
                                                .entries = {{.binding = 0, .buffer = buffer}}})));
        }
    }
}

TEST_F(Lifetime, ManyUploadsBeforeASubmissionArriveWhole) {
    // More than the staging belt holds before it submits by itself.
    constexpr std::uint64_t piece = 12ULL << 20;
    constexpr std::uint64_t pieces = 8;
    const gpu::Buffer buffer =
        must(device->create_buffer({.label = "large", .size = piece * pieces, .usage = both_ways}));
    for (std::uint64_t i = 0; i < pieces; ++i) {
        const std::vector<std::byte> bytes(piece, static_cast<std::byte>(i + 1));
        must(device->write_buffer(buffer, i * piece, bytes));
    }
    for (std::uint64_t i = 0; i < pieces; ++i) {
        const std::vector<std::byte> bytes(piece, static_cast<std::byte>(i + 1));
        EXPECT_EQ(must(device->read_buffer(buffer, i * piece, piece)), bytes) << i;
    }
}

TEST_F(Lifetime, BlocksAreSharedAndLargeObjectsHaveTheirOwn) {
    std::vector<gpu::Buffer> small;
    for (std::uint32_t i = 0; i < 500; ++i) {
        small.push_back(
            must(device->create_buffer({.label = "small", .size = 4, .usage = both_ways})));
        must(device->write_buffer(small.back(), 0, std::as_bytes(std::span{&i, 1})));
    }
    const gpu::Texture large = must(
        device->create_texture({.label = "large",
                                .width = 4096,
                                .height = 4096,
                                .format = gpu::Format::Rgba8Unorm,
                                .usage = gpu::TextureUsage::CopySrc | gpu::TextureUsage::CopyDst}));
    for (std::uint32_t i = 0; i < 500; i += 2) {
        small[i].reset();
    }
    for (std::uint32_t i = 1; i < 500; i += 2) {
        std::uint32_t value = 0;
        const std::vector<std::byte> bytes = must(device->read_buffer(small[i], 0, 4));
        std::memcpy(&value, bytes.data(), sizeof value);
        EXPECT_EQ(value, i);
    }
    EXPECT_EQ(must(device->read_texture(large)),
              std::vector<std::byte>(std::size_t{4096} * 4096 * 4));
}

/// Lets the process have only so much more memory: a software driver promises all there is else.
class MemoryLimit {
public:
    explicit MemoryLimit(rlim_t more_bytes) {
        std::size_t pages = 0;
        std::ifstream{"/proc/self/statm"} >> pages;
        getrlimit(RLIMIT_AS, &before_);
        rlimit limit = before_;
        limit.rlim_cur = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + more_bytes;
        setrlimit(RLIMIT_AS, &limit);
    }
    ~MemoryLimit() { setrlimit(RLIMIT_AS, &before_); }
    MemoryLimit(const MemoryLimit&) = delete;
    MemoryLimit& operator=(const MemoryLimit&) = delete;

private:
    rlimit before_{};
};

TEST_F(Lifetime, WithoutMemorySaysSoAndGoesOn) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "A sanitizer needs the address space for itself.";
#endif
    if (device->caps().adapter.find("llvmpipe") == std::string::npos) {
        GTEST_SKIP() << "Only a driver in this process's memory can be starved.";
    }
    Result<gpu::Buffer> buffer = fail(ErrorCode::Internal, "never tried");
    {
        const MemoryLimit limit{rlim_t{512} << 20U};
        buffer = device->create_buffer(
            {.label = "huge", .size = std::uint64_t{1} << 30U, .usage = both_ways});
    }
    ASSERT_FALSE(buffer);
    EXPECT_EQ(buffer.error().code, ErrorCode::OutOfMemory);
    EXPECT_THAT(buffer.error().message, StartsWith("vkAllocateMemory failed for buffer 'huge'"));
    Painter painter{*device, 4, 4};
    const gpu::Texture target = painter.make_target();
    painter.set_color(1, 0, 0);
    painter.fill(target);
    EXPECT_EQ(painter.read_uniform(target), (Rgba8{255, 0, 0, 255}));
}

TEST_F(Lifetime, DevicesComeAndGo) {
    device.reset();
    for (int i = 0; i < 20; ++i) {
        gpu::Device one = must(open(log));
        Painter painter{one, 8, 8};
        const gpu::Texture target = painter.make_target();
        painter.set_color(0, 0, 1);
        painter.fill(target);
        if (i % 2 == 0) {
            EXPECT_EQ(painter.read_uniform(target), (Rgba8{0, 0, 255, 255}));
        }
    }
}

TEST_F(Lifetime, ObjectsMayOutliveTheirDevice) {
    gpu::Texture target;
    {
        gpu::Device one = must(open(log));
        Painter painter{one, 8, 8};
        target = painter.make_target();
        painter.set_color(0, 0, 1);
        painter.fill(target);
    }
    target.reset();
}

TEST_F(Lifetime, TwoDevicesLiveSideBySide) {
    gpu::Device other = must(open(log));
    Painter here{*device, 4, 4};
    Painter there{other, 4, 4};
    const gpu::Texture target_here = here.make_target();
    const gpu::Texture target_there = there.make_target();
    here.set_color(1, 0, 0);
    there.set_color(0, 1, 0);
    here.fill(target_here);
    there.fill(target_there);
    EXPECT_EQ(here.read_uniform(target_here), (Rgba8{255, 0, 0, 255}));
    EXPECT_EQ(there.read_uniform(target_there), (Rgba8{0, 255, 0, 255}));
}

TEST(Messages, OfTheValidationLayerReachTheSink) {
    std::vector<std::string> errors;
    vk::BackendOptions options;
    options.validation = true;
    options.message_sink = [&](gpu::Severity severity, std::string_view text) {
        if (severity == gpu::Severity::Error) {
            errors.emplace_back(text);
        }
    };
    const auto backend = vk::create_backend(options);
    if (!backend) {
        GTEST_SKIP() << backend.error().message;
    }
    // The front end would refuse it: the buffer is not for uniforms.
    const gpu::BufferId buffer{0, 1};
    ASSERT_TRUE((*backend)->create_buffer(
        buffer, {.label = "crooked", .size = 64, .usage = gpu::BufferUsage::Vertex}));
    const gpu::BindGroupLayoutId layout{0, 1};
    ASSERT_TRUE((*backend)->create_bind_group_layout(
        layout, {.entries = {{.binding = 0, .visibility = gpu::ShaderStage::Fragment}}}));
    ASSERT_TRUE(errors.empty()) << errors.front();
    ASSERT_TRUE((*backend)->create_bind_group(
        gpu::BindGroupId{0, 1}, {.layout = layout, .entries = {{.binding = 0, .buffer = buffer}}}));
    ASSERT_FALSE(errors.empty());
    EXPECT_THAT(errors.front(), HasSubstr("VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT"));
    EXPECT_THAT(errors.front(), HasSubstr("crooked")) << "objects bear their labels";
}

}  // namespace
}  // namespace gnomon::vk_test
