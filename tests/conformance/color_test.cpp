// SPDX-License-Identifier: MIT
//
// Colour: blending, write masks, integer and sRGB targets, clears.
#include <algorithm>
#include <cmath>

#include "tests/conformance/painting.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::conformance {
namespace {

using gpu::BlendFactor;
using gpu::BlendOperation;
using test::drawing_devices;

constexpr Rgba source{0.8F, 0.4F, 0.2F, 0.6F};
constexpr Rgba stored{0.2F, 0.6F, 1.0F, 0.4F};
constexpr Rgba constant{0.4F, 0.2F, 0.8F, 0.6F};

float factor_value(BlendFactor factor, std::size_t channel) {
    switch (factor) {
        case BlendFactor::Zero: return 0;
        case BlendFactor::One: return 1;
        case BlendFactor::Src: return source[channel];
        case BlendFactor::OneMinusSrc: return 1 - source[channel];
        case BlendFactor::SrcAlpha: return source[3];
        case BlendFactor::OneMinusSrcAlpha: return 1 - source[3];
        case BlendFactor::Dst: return stored[channel];
        case BlendFactor::OneMinusDst: return 1 - stored[channel];
        case BlendFactor::DstAlpha: return stored[3];
        case BlendFactor::OneMinusDstAlpha: return 1 - stored[3];
        case BlendFactor::Constant: return constant[channel];
        case BlendFactor::OneMinusConstant: return 1 - constant[channel];
    }
    return 0;
}

float blended(const gpu::BlendComponent& blend, std::size_t channel) {
    const float s = source[channel] * factor_value(blend.src_factor, channel);
    const float d = stored[channel] * factor_value(blend.dst_factor, channel);
    switch (blend.operation) {
        case BlendOperation::Add: return s + d;
        case BlendOperation::Subtract: return s - d;
        case BlendOperation::ReverseSubtract: return d - s;
        case BlendOperation::Min: return std::min(source[channel], stored[channel]);
        case BlendOperation::Max: return std::max(source[channel], stored[channel]);
    }
    return 0;
}

class ColorTarget : public test::DeviceTest {
protected:
    void check_blend(const gpu::BlendState& blend) {
        Painting painting(device(), {.clear_color = {stored[0], stored[1], stored[2], stored[3]}});
        painting.paint({{.vertices = triangles_of({.color = source}),
                         .blend = blend,
                         .blend_constant = {constant[0], constant[1], constant[2], constant[3]}}});
        const auto pixel = painting.pixel(1, 1);
        for (std::size_t channel = 0; channel < 4; ++channel) {
            const float value = blended(channel == 3 ? blend.alpha : blend.color, channel);
            EXPECT_NEAR(static_cast<float>(pixel[channel]), std::clamp(value, 0.0F, 1.0F) * 255.0F,
                        1.0F)
                << "channel " << channel;
        }
    }
};

TEST_P(ColorTarget, EveryBlendFactor) {
    for (int i = 0; i <= static_cast<int>(BlendFactor::OneMinusConstant); ++i) {
        const auto factor = static_cast<BlendFactor>(i);
        SCOPED_TRACE(i);
        // different ones for colour and alpha, so that a mix-up shows
        check_blend({.color = {.src_factor = factor, .dst_factor = BlendFactor::Zero},
                     .alpha = {.src_factor = BlendFactor::Zero, .dst_factor = factor}});
        check_blend({.color = {.src_factor = BlendFactor::Zero, .dst_factor = factor},
                     .alpha = {.src_factor = factor, .dst_factor = BlendFactor::Zero}});
    }
}

TEST_P(ColorTarget, EveryBlendOperation) {
    for (int i = 0; i <= static_cast<int>(BlendOperation::Max); ++i) {
        const auto operation = static_cast<BlendOperation>(i);
        SCOPED_TRACE(i);
        const gpu::BlendComponent one{
            .src_factor = BlendFactor::One, .dst_factor = BlendFactor::One, .operation = operation};
        check_blend({.color = one, .alpha = {}});
        check_blend({.color = {}, .alpha = one});
    }
}

TEST_P(ColorTarget, BlendingEndsWithItsPipeline) {
    const gpu::BlendComponent add{.src_factor = BlendFactor::One, .dst_factor = BlendFactor::One};
    Painting painting(device(), {});
    painting.paint({{.vertices = triangles_of({.color = {0.2F, 0, 0, 0}}), .blend = {{add, add}}},
                    {.vertices = triangles_of({.color = {0.4F, 0, 0, 0}}), .blend = {{add, add}}},
                    {.vertices = triangles_of({.color = {0, 0.2F, 0, 0}})}});
    EXPECT_EQ(painting.pixel(0, 0), (std::array<int, 4>{0, 51, 0, 0}));
}

TEST_P(ColorTarget, EveryWriteMask) {
    for (std::uint32_t mask = 0; mask < 16; ++mask) {
        Painting painting(device(), {.clear_color = {0, 0, 0, 0}});
        painting.paint({{.vertices = triangles_of({.color = {1, 1, 1, 1}}),
                         .write_mask = static_cast<gpu::ColorWrite>(mask)}});
        const auto pixel = painting.pixel(2, 2);
        for (std::size_t channel = 0; channel < 4; ++channel) {
            EXPECT_EQ(pixel[channel], (mask >> channel & 1) != 0 ? 255 : 0)
                << "mask " << mask << ", channel " << channel;
        }
    }
}

TEST_P(ColorTarget, ClearReachesEveryChannelWhateverWasDrawnBefore) {
    Painting painting(device(), {.clear_color = {0.2, 0.4, 0.6, 0.8}});
    painting.paint(
        {{.write_mask = gpu::ColorWrite::Red, .scissor = gpu::cmd::SetScissorRect{0, 0, 1, 1}}});
    painting.paint({});
    for (const auto& [x, y] : {std::pair(0U, 0U), std::pair(3U, 3U)}) {
        EXPECT_EQ(painting.pixel(x, y), (std::array<int, 4>{51, 102, 153, 204}));
    }
}

TEST_P(ColorTarget, LoadKeepsWhatIsThere) {
    Painting painting(device(), {});
    painting.paint({{.vertices = triangles_of({.right = 0})}});
    painting.paint_over({{.vertices = triangles_of({.left = 0, .color = {0, 1, 0, 1}})}});
    EXPECT_EQ(painting.pixel(0, 0), (std::array<int, 4>{255, 255, 255, 255}));
    EXPECT_EQ(painting.pixel(3, 3), (std::array<int, 4>{0, 255, 0, 255}));
}

TEST_P(ColorTarget, IntegerTargetTakesIntegers) {
    Painting painting(device(), {.color_format = gpu::Format::R8Uint, .clear_color = {7, 0, 0, 0}});
    painting.paint({{.vertices = triangles_of({.bottom = 0, .color = {200, 0, 0, 0}})}});
    const auto values = painting.color();
    ASSERT_EQ(values.size(), 16U);
    for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(values[i], i < 8 ? 200 : 7) << "pixel " << i;
}

TEST_P(ColorTarget, WideIntegersArriveWhole) {
    Painting painting(
        device(), {.color_format = gpu::Format::R32Uint, .clear_color = {4000000000.0, 0, 0, 0}});
    painting.paint({});
    const auto bytes = painting.color();
    ASSERT_EQ(bytes.size(), 64U);
    EXPECT_EQ(bytes[0] + (bytes[1] << 8) + (bytes[2] << 16), 4000000000U & 0xFFFFFFU);
    EXPECT_EQ(bytes[3], 4000000000U >> 24);
}

TEST_P(ColorTarget, SrgbTargetEncodes) {
    // linear 0.5 is 188 in sRGB bytes; alpha is linear
    Painting painting(device(), {.color_format = gpu::Format::Rgba8UnormSrgb,
                                 .clear_color = {0.5, 0.5, 0.5, 0.5}});
    painting.paint({{.vertices = triangles_of({.right = 0, .color = {0.5F, 0, 1, 0.5F}})}});
    const auto bytes = painting.color();
    EXPECT_NEAR(bytes[0], 188, 1);
    EXPECT_EQ(bytes[1], 0);
    EXPECT_EQ(bytes[2], 255);
    EXPECT_NEAR(bytes[3], 128, 1);
    EXPECT_NEAR(bytes[12], 188, 1) << "the clear";
    EXPECT_NEAR(bytes[15], 128, 1) << "the clear";
}

TEST_P(ColorTarget, FloatTargetsKeepWhatBytesCannot) {
    Painting painting(
        device(), {.color_format = gpu::Format::Rgba32Float, .clear_color = {-3.5, 1e10, 0.1, 1}});
    painting.paint({});
    const auto bytes = painting.color();
    std::array<float, 4> pixel{};
    std::copy_n(reinterpret_cast<const float*>(bytes.data()), 4, pixel.begin());
    EXPECT_EQ(pixel, (std::array<float, 4>{-3.5F, 1e10F, 0.1F, 1.0F}));
}

INSTANTIATE_TEST_SUITE_P(Devices, ColorTarget, testing::ValuesIn(drawing_devices()),
                         test::device_case_name);

}  // namespace
}  // namespace gnomon::conformance
