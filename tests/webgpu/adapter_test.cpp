// SPDX-License-Identifier: MIT
//
// What a browser says of its device, as Caps.
#include "internal/adapter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon::webgpu {
namespace {

constexpr std::string_view everything = R"({"adapter": "google swiftshader",
    "features": ["depth32float-stencil8", "depth-clip-control", "timestamp-query", "something-new"],
    "limits": {"maxTextureDimension2D": 8192, "maxColorAttachments": 8, "maxVertexBuffers": 8,
               "maxVertexAttributes": 16, "maxBufferSize": 5000000000,
               "maxUniformBufferBindingSize": 65536, "minUniformBufferOffsetAlignment": 256}})";

TEST(Adapter, SaysWhatTheBrowserSays) {
    const auto caps = read_caps(everything, {});
    ASSERT_TRUE(caps) << caps.error().message;
    EXPECT_EQ(caps->backend, "webgpu");
    EXPECT_EQ(caps->adapter, "google swiftshader");
    EXPECT_TRUE(caps->features.depth32float_stencil8);
    EXPECT_TRUE(caps->features.unclipped_depth);
    EXPECT_TRUE(caps->features.timestamp_query);
    EXPECT_TRUE(caps->features.multisample_4);
    EXPECT_TRUE(caps->features.sampled_stencil);
    EXPECT_TRUE(caps->features.exact_clip_space);
    EXPECT_FALSE(caps->features.occlusion_query) << "WebGPU's are not exact";
    EXPECT_FALSE(caps->features.depth_bounds);
    EXPECT_FALSE(caps->features.depth24unorm_stencil8) << "depth24plus is not what it says";
    EXPECT_EQ(caps->limits.max_texture_dimension_2d, 8192U);
    EXPECT_EQ(caps->limits.max_buffer_size, 5'000'000'000U);
    EXPECT_EQ(caps->limits.min_uniform_buffer_offset_alignment, 256U);
}

TEST(Adapter, LeavesOutWhatIsDisabled) {
    const auto caps = read_caps(
        everything, {"depth-clip-control", "timestamp-query", "multisample", "sampled-stencil"});
    ASSERT_TRUE(caps) << caps.error().message;
    EXPECT_FALSE(caps->features.unclipped_depth);
    EXPECT_FALSE(caps->features.timestamp_query);
    EXPECT_FALSE(caps->features.multisample_4);
    EXPECT_FALSE(caps->features.sampled_stencil);
}

TEST(Adapter, RefusesInOneSentence) {
    const auto refusal = [](std::string_view description, std::vector<std::string> disabled) {
        const auto caps = read_caps(description, disabled);
        return caps ? "" : caps.error().message;
    };
    EXPECT_EQ(refusal("", {}),
              "There is no WebGPU device: the page has put no bridge into Module.gnomonBridge.");
    EXPECT_EQ(refusal("nonsense", {}),
              "What the bridge says of the WebGPU device has no features and limits.");
    EXPECT_EQ(refusal(R"({"features": [], "limits": {}})", {}),
              "The WebGPU adapter lacks depth32float-stencil8, and WebGPU has no other "
              "depth-stencil format whose depth can be relied on.");
    EXPECT_EQ(refusal(everything, {"depthClamp"}),
              "'depthClamp' cannot be disabled: the known features are depth-clip-control, "
              "timestamp-query, multisample, sampled-stencil.");
}

}  // namespace
}  // namespace gnomon::webgpu
