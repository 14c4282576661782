// SPDX-License-Identifier: MIT
//
// Depth: comparisons, bias, clamping, the viewport's range, reading back.
#include <cmath>

#include "tests/conformance/painting.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::conformance {
namespace {

using gpu::Compare;
using gpu::Format;
using test::drawing_devices;
using test::must;

class Depth : public test::DeviceTest {
protected:
    std::vector<Format> depth_formats() {
        std::vector<Format> formats = depth_stencil_formats(device());
        formats.push_back(Format::Depth32Float);
        return formats;
    }
    static Step at(float z, const gpu::DepthStencilState& state) {
        return {.vertices = triangles_of({.z = z}), .depth_stencil = state};
    }
    static constexpr gpu::DepthStencilState write{.depth_write_enabled = true,
                                                  .depth_compare = Compare::Always};
    static bool all_red(const Painting& painting) {
        const auto bytes = painting.color();
        bool red = true;
        for (std::size_t i = 0; i < bytes.size(); i += 4) red = red && bytes[i] == 255;
        return red;
    }
};

TEST_P(Depth, EveryComparison) {
    struct Row {
        Compare compare;
        bool smaller, same, larger;
    };
    constexpr Row rows[] = {
        {Compare::Never, false, false, false},      {Compare::Less, true, false, false},
        {Compare::Equal, false, true, false},       {Compare::LessEqual, true, true, false},
        {Compare::Greater, false, false, true},     {Compare::NotEqual, true, false, true},
        {Compare::GreaterEqual, false, true, true}, {Compare::Always, true, true, true},
    };
    for (const Format format : depth_formats()) {
        for (const Row& row : rows) {
            SCOPED_TRACE(testing::Message() << "format " << static_cast<int>(format) << ", compare "
                                            << static_cast<int>(row.compare));
            const auto passes = [&](float z) {
                Painting painting(device(), {.depth_stencil_format = format, .clear_depth = 0.5F});
                painting.paint({at(z, {.depth_compare = row.compare})});
                return all_red(painting);
            };
            EXPECT_EQ(passes(0.25F), row.smaller);
            EXPECT_EQ(passes(0.5F), row.same);
            EXPECT_EQ(passes(0.75F), row.larger);
        }
    }
}

TEST_P(Depth, ReadBackGivesWhatWasDrawn) {
    for (const Format format : depth_formats()) {
        const float precision =
            format == Format::Depth24UnormStencil8 ? std::ldexp(1.0F, -24) : std::ldexp(1.0F, -26);
        for (const float z : {0.0F, 0.125F, 0.3F, 0.7F, 1.0F}) {
            Painting painting(device(), {.depth_stencil_format = format, .clear_depth = 0.9F});
            Step step = at(z, write);
            step.scissor = gpu::cmd::SetScissorRect{0, 0, 4, 2};
            painting.paint({step});
            const auto depth = painting.depth();
            ASSERT_EQ(depth.size(), 16U);
            for (std::size_t i = 0; i < 16; ++i) {
                EXPECT_NEAR(depth[i], i < 8 ? z : 0.9F, precision) << "pixel " << i;
            }
        }
    }
}

TEST_P(Depth, WritesOnlyWhenAskedTo) {
    Painting painting(device(), {.clear_depth = 0.25F});
    painting.paint({at(0.75F, {.depth_compare = Compare::Always})});
    EXPECT_EQ(painting.depth(), std::vector<float>(16, 0.25F));
    painting.paint({at(0.75F, write)});
    EXPECT_EQ(painting.depth(), std::vector<float>(16, 0.75F));
}

TEST_P(Depth, AFarPointAtInfinityIsDepthZeroAndNotClipped) {
    // Reversed, infinite: z = 0, w > 0 is the far plane itself.
    Painting painting(device(), {.clear_depth = 0.5F});
    painting.paint({at(0.0F, write)});
    EXPECT_EQ(painting.depth(), std::vector<float>(16, 0.0F));
}

TEST_P(Depth, PositiveBiasIsALargerDepth) {
    for (const Format format : depth_formats()) {
        const auto depth_with = [&](std::int32_t bias) {
            Painting painting(device(), {.depth_stencil_format = format});
            painting.paint({at(0.5F, {.depth_write_enabled = true,
                                      .depth_compare = Compare::Always,
                                      .depth_bias = bias})});
            return painting.depth()[0];
        };
        EXPECT_GT(depth_with(16), depth_with(0));
        EXPECT_LT(depth_with(-16), depth_with(0));
        EXPECT_NEAR(depth_with(16), 0.5F, 1e-4F) << "the unit is the format's smallest step";
    }
}

TEST_P(Depth, SlopeBiasGrowsWithTheSlope) {
    const auto depth_with = [&](float slope_scale) {
        Painting painting(device(), {});
        Step step = at(0.5F, {.depth_write_enabled = true,
                              .depth_compare = Compare::Always,
                              .depth_bias_slope_scale = slope_scale});
        for (Vertex& vertex : step.vertices) vertex.z += vertex.x * 0.2F;  // 0.1 a pixel
        painting.paint({step});
        return painting.depth()[5];
    };
    EXPECT_NEAR(depth_with(1.0F) - depth_with(0.0F), 0.1F, 1e-4F);
    EXPECT_NEAR(depth_with(-1.0F) - depth_with(0.0F), -0.1F, 1e-4F);
}

TEST_P(Depth, BiasEndsWithItsPipeline) {
    Painting painting(device(), {});
    painting.paint(
        {at(0.5F,
            {.depth_write_enabled = true, .depth_compare = Compare::Always, .depth_bias = 1 << 16}),
         at(0.5F, write)});
    EXPECT_EQ(painting.depth(), std::vector<float>(16, 0.5F));
}

TEST_P(Depth, OutsideZeroToOneIsClipped) {
    for (const float z : {-0.25F, 1.25F}) {
        Painting painting(device(), {.clear_depth = 0.5F});
        painting.paint({at(z, write)});
        EXPECT_EQ(painting.depth(), std::vector<float>(16, 0.5F));
    }
}

TEST_P(Depth, UnclippedDepthIsClamped) {
    if (!features().unclipped_depth) GTEST_SKIP() << "no unclipped_depth";
    for (const auto& [z, expected] : {std::pair(-0.25F, 0.0F), std::pair(1.25F, 1.0F)}) {
        Painting painting(device(), {.clear_depth = 0.5F});
        Step step = at(z, write);
        step.primitive.unclipped_depth = true;
        painting.paint({step});
        EXPECT_EQ(painting.depth(), std::vector<float>(16, expected));
        // and the next pipeline clips again
        painting.paint({step, at(0.5F, write), at(z, write)});
        EXPECT_EQ(painting.depth(), std::vector<float>(16, 0.5F));
    }
}

// What is stored decides, not what is drawn; and the stencil is left alone as well.
TEST_P(Depth, BoundsLetThroughWhatIsStoredWithin) {
    if (!features().depth_bounds) GTEST_SKIP() << "no depth_bounds";
    // Not by depth_fail_op: SwiftShader counts what is outside as depth that fails.
    const gpu::StencilFaceState count{.pass_op = gpu::StencilOp::IncrementWrap};
    const auto stored = [&](const std::optional<gpu::cmd::SetDepthBounds>& bounds, bool tested) {
        Painting painting(device(), {.clear_depth = 0.25F});
        Step right = at(0.75F, write);
        right.scissor = gpu::cmd::SetScissorRect{2, 0, 2, 4};
        Step counting = at(0.5F, {.depth_compare = Compare::Always,
                                  .stencil_front = count,
                                  .stencil_back = count,
                                  .depth_bounds_test = tested});
        counting.depth_bounds = bounds;
        painting.paint({right, counting});
        const auto stencil = painting.stencil();
        EXPECT_EQ(stencil[0], stencil[1]);
        EXPECT_EQ(stencil[2], stencil[3]);
        return std::pair{int{stencil[0]}, int{stencil[3]}};  // where 0.25 is stored, and 0.75
    };
    using Pair = std::pair<int, int>;
    EXPECT_EQ(stored(std::nullopt, true), Pair(1, 1)) << "all, at the beginning of a pass";
    EXPECT_EQ(stored(gpu::cmd::SetDepthBounds{0.0F, 0.5F}, true), Pair(1, 0));
    EXPECT_EQ(stored(gpu::cmd::SetDepthBounds{0.5F, 1.0F}, true), Pair(0, 1));
    EXPECT_EQ(stored(gpu::cmd::SetDepthBounds{0.25F, 0.75F}, true), Pair(1, 1)) << "inclusive";
    EXPECT_EQ(stored(gpu::cmd::SetDepthBounds{0.3F, 0.7F}, true), Pair(0, 0));
    EXPECT_EQ(stored(gpu::cmd::SetDepthBounds{0.3F, 0.7F}, false), Pair(1, 1)) << "not tested";
}

TEST_P(Depth, ViewportMapsTheDepthRange) {
    for (const auto& [z, expected] :
         {std::pair(0.0F, 0.25F), std::pair(0.5F, 0.5F), std::pair(1.0F, 0.75F)}) {
        Painting painting(device(), {});
        Step step = at(z, write);
        step.viewport = gpu::cmd::SetViewport{1, 1, 2, 2, 0.25F, 0.75F};
        painting.paint({step});
        const auto depth = painting.depth();
        for (std::size_t i = 0; i < 16; ++i) {
            const bool inside = (i % 4 == 1 || i % 4 == 2) && (i / 4 == 1 || i / 4 == 2);
            EXPECT_EQ(depth[i], inside ? expected : 0.0F) << "pixel " << i;
        }
    }
}

TEST_P(Depth, ClearReachesAllPixelsWhateverWasDrawnBefore) {
    Painting painting(device(), {.clear_depth = 0.25F});
    painting.paint({at(0.75F, write)});
    Step step = at(0.6F, {.depth_write_enabled = false, .depth_compare = Compare::Greater});
    step.scissor = gpu::cmd::SetScissorRect{0, 0, 1, 1};
    painting.paint({step});
    EXPECT_EQ(painting.depth(), std::vector<float>(16, 0.25F));
}

TEST_P(Depth, LoadKeepsBothAspects) {
    const gpu::StencilFaceState replace{.pass_op = gpu::StencilOp::Replace};
    gpu::DepthStencilState state = write;
    state.stencil_front = replace;
    state.stencil_back = replace;
    Step step = at(0.75F, state);
    step.stencil_reference = 9;
    Painting painting(device(), {});
    painting.paint({step});
    painting.paint_over({});
    EXPECT_EQ(painting.depth(), std::vector<float>(16, 0.75F));
    EXPECT_EQ(painting.stencil(), std::vector<std::uint8_t>(16, 9));
}

INSTANTIATE_TEST_SUITE_P(Devices, Depth, testing::ValuesIn(drawing_devices()),
                         test::device_case_name);

}  // namespace
}  // namespace gnomon::conformance
