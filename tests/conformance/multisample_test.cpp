// SPDX-License-Identifier: MIT
//
// Four samples: resolve, and fetching each sample of colour and stencil.
#include <numeric>
#include <random>

#include "tests/conformance/painting.hpp"
#include "tests/conformance/reading_shader.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::conformance {
namespace {

using test::drawing_devices;

constexpr std::uint32_t side = 8;

class Multisample : public test::DeviceTest {
protected:
    void SetUp() override {
        DeviceTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) return;
        if (!features().multisample_4) GTEST_SKIP() << "no multisample_4";
    }
    /// A slanted triangle that cuts many pixels; marks colour white and stencil 3.
    static Step slanted() {
        const gpu::StencilFaceState replace{.pass_op = gpu::StencilOp::Replace};
        return {.vertices = {{-0.93F, -0.87F, 0.5F, 1, 1, 1, 1, 1},
                             {0.81F, -0.33F, 0.5F, 1, 1, 1, 1, 1},
                             {-0.21F, 0.94F, 0.5F, 1, 1, 1, 1, 1}},
                .depth_stencil = {.depth_compare = gpu::Compare::Always,
                                  .stencil_front = replace,
                                  .stencil_back = replace},
                .stencil_reference = 3};
    }
    Painting painted(gpu::Format depth_stencil_format = gpu::Format::Depth32FloatStencil8) {
        Painting painting(device(), {.width = side,
                                     .height = side,
                                     .depth_stencil_format = depth_stencil_format,
                                     .sample_count = 4});
        painting.paint({slanted()});
        return painting;
    }
};

TEST_P(Multisample, ResolveIsTheMeanOfTheSamples) {
    const Painting painting = painted();
    const auto resolved = painting.color();
    std::vector<float> mean(side * side);
    for (int sample = 0; sample < 4; ++sample) {
        const auto colors =
            fetch_color_samples(device(), painting.color_texture(), side, side, sample);
        for (std::size_t i = 0; i < mean.size(); ++i) {
            EXPECT_TRUE(colors[i][0] == 0.0F || colors[i][0] == 1.0F);
            mean[i] += colors[i][0] / 4;
        }
    }
    int partly_covered = 0;
    for (std::size_t i = 0; i < mean.size(); ++i) {
        EXPECT_NEAR(resolved[i * 4], mean[i] * 255.0F, 1.0F) << "pixel " << i;
        if (mean[i] > 0 && mean[i] < 1) ++partly_covered;
    }
    EXPECT_GE(partly_covered, 8);
}

TEST_P(Multisample, StencilIsCountedForEachSample) {
    if (!features().sampled_stencil) GTEST_SKIP() << "no sampled_stencil";
    for (const gpu::Format format : depth_stencil_formats(device())) {
        const Painting painting = painted(format);
        for (int sample = 0; sample < 4; ++sample) {
            const auto colors =
                fetch_color_samples(device(), painting.color_texture(), side, side, sample);
            const auto stencil = fetch_stencil_samples(device(), painting.depth_stencil_texture(),
                                                       side, side, sample);
            for (std::size_t i = 0; i < stencil.size(); ++i) {
                EXPECT_EQ(stencil[i], colors[i][0] > 0 ? 3 : 0)
                    << "pixel " << i << ", sample " << sample;
            }
        }
    }
}

TEST_P(Multisample, SamplesLieWhereWebGpuPutsThem) {
    // The standard pattern in sixteenths of a pixel from its top left corner. A vertical and a
    // horizontal edge are moved over the samples one by one.
    constexpr std::array<std::pair<float, float>, 4> pattern{{{6, 2}, {14, 6}, {2, 10}, {10, 14}}};
    for (std::size_t sample = 0; sample < 4; ++sample) {
        const float x = pattern[sample].first / 16.0F;
        const float y = pattern[sample].second / 16.0F;
        const float margin = 1.0F / 16.0F;
        const auto covered = [&](float right, float bottom) {
            Painting painting(device(), {.width = 1, .height = 1, .sample_count = 4});
            painting.paint(
                {{.vertices = triangles_of({.bottom = 1 - 2 * bottom, .right = -1 + 2 * right})}});
            return fetch_color_samples(device(), painting.color_texture(), 1, 1,
                                       static_cast<int>(sample))[0][0] == 1.0F;
        };
        SCOPED_TRACE(sample);
        EXPECT_TRUE(covered(x + margin, 2));
        EXPECT_FALSE(covered(x - margin, 2));
        EXPECT_TRUE(covered(2, y + margin));
        EXPECT_FALSE(covered(2, y - margin));
    }
}

// Where it begins as the adapter says.
TEST_P(Multisample, AScissorCutsWholePixels) {
    if (!features().sampled_stencil) GTEST_SKIP() << "no sampled_stencil";
    constexpr std::uint32_t width = 192;
    constexpr std::uint32_t height = 160;
    const std::uint32_t grid = device().caps().limits.multisample_scissor_alignment;
    ASSERT_LE(grid, 64U);
    const gpu::StencilFaceState count{.pass_op = gpu::StencilOp::IncrementWrap};
    Step triangles{
        .vertices = {},
        .depth_stencil = {
            .depth_compare = gpu::Compare::Always, .stencil_front = count, .stencil_back = count}};
    std::minstd_rand random(1);
    std::uniform_real_distribution<float> place(-1.2F, 1.2F);
    for (int i = 0; i < 600; ++i) {
        const float x = place(random);
        triangles.vertices.push_back({x, place(random), 0.5F});
    }
    const PaintingDesc desc{.width = width, .height = height, .sample_count = 4};
    Painting whole(device(), desc);
    whole.paint({triangles});
    for (const gpu::cmd::SetScissorRect scissor : {gpu::cmd::SetScissorRect{grid, 2 * grid, 39, 24},
                                                   {2 * grid, grid, 3, 17},
                                                   {0, grid, 100, 1},
                                                   {grid, 0, 1, 61}}) {
        triangles.scissor = scissor;
        Painting cut(device(), desc);
        cut.paint({triangles});
        for (int sample = 0; sample < 4; ++sample) {
            const auto all = fetch_stencil_samples(device(), whole.depth_stencil_texture(), width,
                                                   height, sample);
            const auto kept =
                fetch_stencil_samples(device(), cut.depth_stencil_texture(), width, height, sample);
            std::size_t wrong = 0;
            for (std::uint32_t i = 0; i < all.size(); ++i) {
                const std::uint32_t x = i % width;
                const std::uint32_t y = i / width;
                const bool inside = x >= scissor.x && x < scissor.x + scissor.width &&
                                    y >= scissor.y && y < scissor.y + scissor.height;
                wrong += kept[i] != (inside ? all[i] : 0) ? 1 : 0;
            }
            EXPECT_EQ(wrong, 0U) << scissor.x << "," << scissor.y << " sample " << sample;
        }
    }
}

TEST_P(Multisample, DepthIsTestedForEachSample) {
    // The slanted triangle writes depth; what lies behind shows exactly in the other samples.
    Painting painting(device(), {.width = side, .height = side, .sample_count = 4});
    Step near_triangle = slanted();
    near_triangle.depth_stencil.depth_write_enabled = true;
    const Step behind{.vertices = triangles_of({.z = 0.25F, .color = {0, 1, 0, 1}}),
                      .depth_stencil = {.depth_compare = gpu::Compare::Greater}};
    painting.paint({near_triangle, behind});
    for (int sample = 0; sample < 4; ++sample) {
        const auto colors =
            fetch_color_samples(device(), painting.color_texture(), side, side, sample);
        int green = 0;
        for (const auto& color : colors) {
            EXPECT_TRUE(color[0] + color[1] == 1.0F || color[0] + color[1] == 2.0F);
            if (color[0] == 0.0F && color[1] == 1.0F) ++green;
        }
        EXPECT_GT(green, 8);
        EXPECT_LT(green, 56);
    }
}

INSTANTIATE_TEST_SUITE_P(Devices, Multisample, testing::ValuesIn(drawing_devices()),
                         test::device_case_name);

}  // namespace
}  // namespace gnomon::conformance
