// SPDX-License-Identifier: MIT
//
// The backend behind the device that validates, in front of a bridge that records.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <optional>

#include <gnomon/gpu/device.hpp>

#include "internal/webgpu_backend.hpp"
#include "tests/webgpu/recorder.hpp"

namespace gnomon::webgpu {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

class WebGpu : public testing::Test {
protected:
    WebGpu() {
        auto backend = create_backend_on(
            std::make_unique<Recorder>(recording_),
            {.message_sink = [this](gpu::Severity severity, std::string_view message) {
                EXPECT_EQ(severity, gpu::Severity::Error);
                said_.emplace_back(message);
            }});
        EXPECT_TRUE(backend);
        if (backend) device_.emplace(std::move(*backend));
    }

    Recording recording_;
    std::vector<std::string> said_;
    std::optional<gpu::Device> device_;
};

TEST_F(WebGpu, DescribesObjectsByNumberAndFreesThem) {
    {
        const auto buffer =
            device_->create_buffer({.label = "b", .size = 16, .usage = gpu::BufferUsage::CopyDst});
        ASSERT_TRUE(buffer);
        const std::array<std::byte, 8> bytes{};
        EXPECT_TRUE(device_->write_buffer(*buffer, 4, bytes));
    }
    EXPECT_THAT(recording_.calls, ElementsAre(R"(create 0 0 {"label":"b","size":16,"usage":8})",
                                              "write_buffer 0 4 8", "destroy 0 0"));
}

TEST_F(WebGpu, ABindGroupIsDescribedWithItsLayout) {
    const auto layout = device_->create_bind_group_layout(
        {.label = "l",
         .entries = {{.binding = 3,
                      .visibility = gpu::ShaderStage::Fragment,
                      .type = gpu::BindingType::SampledTexture}}});
    const auto texture = device_->create_texture({.label = "t",
                                                  .width = 4,
                                                  .height = 4,
                                                  .format = gpu::Format::Rgba8Unorm,
                                                  .usage = gpu::TextureUsage::TextureBinding});
    const auto sampler = device_->create_sampler({.label = "s"});
    ASSERT_TRUE(layout && texture && sampler);
    const auto group = device_->create_bind_group(
        {.label = "g",
         .layout = *layout,
         .entries = {{.binding = 3, .texture = *texture, .sampler = *sampler}}});
    ASSERT_TRUE(group) << group.error().message;
    EXPECT_EQ(recording_.calls.back(),
              R"(create 5 0 {"label":"g","layout":0,"entries":[{"binding":3,"texture":0,)"
              R"("aspect":"all"},{"binding":103,"sampler":0}]})");
}

TEST_F(WebGpu, ATextureOfAHostsIsImportedByItsNumber) {
    const gpu::TextureDesc desc{.label = "t",
                                .width = 4,
                                .height = 4,
                                .format = gpu::Format::Depth32FloatStencil8,
                                .usage = gpu::TextureUsage::RenderAttachment};
    {
        const auto texture = device_->import_texture(desc, HostTexture{.number = 3});
        ASSERT_TRUE(texture) << texture.error().message;
        EXPECT_EQ(device_->clip_depth_of(*texture), gpu::ClipDepth::ZeroToOne);
        EXPECT_TRUE(device_->takes_colors_beside(*texture));
    }
    EXPECT_THAT(
        recording_.calls,
        ElementsAre(R"(create 1 0 {"label":"t","size":[4,4],"format":"depth32float-stencil8",)"
                    R"("usage":16,"mipLevelCount":1,"sampleCount":1,"adopted":3})",
                    "destroy 1 0"));
    const auto none = device_->import_texture(desc, 3);
    ASSERT_FALSE(none);
    EXPECT_THAT(none.error().message,
                StartsWith("[Texture \"t\"] cannot be imported: what WebGPU imports is a "));
    recording_.outcome = Outcome::Unsupported;
    recording_.error = "[Texture \"t\"] cannot be imported: it has 8 x 8 texels.";
    const auto refused = device_->import_texture(desc, HostTexture{.number = 3});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Unsupported);
    EXPECT_EQ(refused.error().message, recording_.error);
}

TEST_F(WebGpu, AShaderNeedsWgsl) {
    const auto missing = device_->create_shader(
        {.label = "s", .stage = gpu::ShaderStage::Vertex, .source = {.glsl = "void main() {}"}});
    ASSERT_FALSE(missing);
    EXPECT_THAT(missing.error().message, StartsWith("The WGSL source of [Shader \"s\"] is empty"));
    const auto shader = device_->create_shader(
        {.label = "s", .stage = gpu::ShaderStage::Vertex, .source = {.wgsl = "fn main() {}"}});
    ASSERT_TRUE(shader);
    EXPECT_EQ(recording_.calls.back(), R"(create 3 0 {"label":"s","code":"fn main() {}"})");
}

TEST_F(WebGpu, OutcomesAreErrorsWithTheBridgesSentence) {
    const std::vector<std::pair<Outcome, ErrorCode>> rows{
        {Outcome::Unsupported, ErrorCode::Unsupported},
        {Outcome::OutOfMemory, ErrorCode::OutOfMemory},
        {Outcome::DeviceLost, ErrorCode::DeviceLost},
        {Outcome::Internal, ErrorCode::Internal}};
    for (const auto& [outcome, code] : rows) {
        recording_.outcome = outcome;
        recording_.error = "It is so.";
        const Status idle = device_->wait_idle();
        ASSERT_FALSE(idle);
        EXPECT_EQ(idle.error().code, code);
        EXPECT_THAT(idle.error().message, StartsWith("It is so."));
    }
}

TEST_F(WebGpu, WhatTheDeviceComplainsOfReachesTheSinkInOrder) {
    recording_.messages = {"first", "second"};
    auto encoder = device_->create_command_encoder("nothing");
    const auto commands = encoder.finish();
    ASSERT_TRUE(commands);
    EXPECT_TRUE(device_->submit(*commands));
    EXPECT_THAT(said_, ElementsAre("first", "second"));
    recording_.messages = {"third"};
    EXPECT_TRUE(device_->wait_idle());
    EXPECT_THAT(said_, ElementsAre("first", "second", "third"));
}

TEST(WebGpuWithoutDevice, IsOneSentence) {
    Recording recording;
    recording.description.clear();
    const auto backend = create_backend_on(std::make_unique<Recorder>(recording), {});
    ASSERT_FALSE(backend);
    EXPECT_EQ(backend.error().code, ErrorCode::Unsupported);
}

}  // namespace
}  // namespace gnomon::webgpu
