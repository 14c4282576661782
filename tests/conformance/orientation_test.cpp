// SPDX-License-Identifier: MIT
//
// Where things land: row 0 on top, which face is the front, viewport, scissor.
#include "tests/conformance/painting.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::conformance {
namespace {

using test::drawing_devices;
using test::must;

class Orientation : public test::DeviceTest {
protected:
    /// 1 where the painting is red, row by row.
    static std::vector<int> red_pixels(const Painting& painting) {
        const auto bytes = painting.color();
        std::vector<int> red;
        for (std::size_t i = 0; i < bytes.size(); i += 4) red.push_back(bytes[i] == 255 ? 1 : 0);
        return red;
    }
    bool draws(const gpu::PrimitiveState& primitive, bool counter_clockwise) {
        Painting painting(device(), {});
        painting.paint({{.vertices = triangles_of({.counter_clockwise = counter_clockwise}),
                         .primitive = primitive}});
        const auto red = red_pixels(painting);
        const bool all = red == std::vector<int>(16, 1);
        const bool none = red == std::vector<int>(16, 0);
        EXPECT_TRUE(all || none) << "a rectangle is drawn in part";
        return all;
    }
};

TEST_P(Orientation, RowZeroIsTheTopRow) {
    Painting painting(device(), {});
    // the upper half in y-up coordinates, and of it the left quarter of the picture
    painting.paint(
        {{.vertices = triangles_of({.left = -1, .bottom = 0, .right = -0.5F, .top = 1})}});
    EXPECT_EQ(red_pixels(painting),
              (std::vector<int>{1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST_P(Orientation, FrontFaceIsCounterClockwiseWithYUp) {
    using gpu::CullMode;
    using gpu::FrontFace;
    for (const FrontFace front : {FrontFace::Ccw, FrontFace::Cw}) {
        for (const bool counter_clockwise : {true, false}) {
            const bool is_front = counter_clockwise == (front == FrontFace::Ccw);
            EXPECT_TRUE(
                draws({.front_face = front, .cull_mode = CullMode::None}, counter_clockwise));
            EXPECT_EQ(draws({.front_face = front, .cull_mode = CullMode::Back}, counter_clockwise),
                      is_front);
            EXPECT_EQ(draws({.front_face = front, .cull_mode = CullMode::Front}, counter_clockwise),
                      !is_front);
        }
    }
}

TEST_P(Orientation, StencilFaceMeansTheSameFaceAsCulling) {
    // Front faces count up, back faces down: a driver that turns only one of the two would show.
    const gpu::DepthStencilState count{.depth_compare = gpu::Compare::Always,
                                       .stencil_front = {.pass_op = gpu::StencilOp::IncrementWrap},
                                       .stencil_back = {.pass_op = gpu::StencilOp::DecrementWrap}};
    for (const gpu::FrontFace front : {gpu::FrontFace::Ccw, gpu::FrontFace::Cw}) {
        for (const bool counter_clockwise : {true, false}) {
            Painting painting(device(), {.clear_stencil = 100});
            painting.paint({{.vertices = triangles_of({.counter_clockwise = counter_clockwise}),
                             .primitive = {.front_face = front},
                             .depth_stencil = count,
                             .write_mask = gpu::ColorWrite::None}});
            const bool is_front = counter_clockwise == (front == gpu::FrontFace::Ccw);
            EXPECT_EQ(painting.stencil(), std::vector<std::uint8_t>(
                                              16, is_front ? std::uint8_t{101} : std::uint8_t{99}));
        }
    }
}

TEST_P(Orientation, ViewportPlacesThePictureFromTheTopLeft) {
    Painting painting(device(), {});
    painting.paint({{.viewport = gpu::cmd::SetViewport{1, 0, 2, 1, 0, 1}}});
    EXPECT_EQ(red_pixels(painting),
              (std::vector<int>{0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST_P(Orientation, ViewportKeepsFractionsOfPixels) {
    Painting painting(device(), {});
    // 0.25 to 2.75 covers the centres 0.5, 1.5 and 2.5; cut to whole numbers it would be two
    painting.paint({{.viewport = gpu::cmd::SetViewport{0.25F, 0.75F, 2.5F, 1.5F, 0, 1}}});
    EXPECT_EQ(red_pixels(painting),
              (std::vector<int>{0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST_P(Orientation, ScissorCutsFromTheTopLeft) {
    Painting painting(device(), {});
    painting.paint({{.scissor = gpu::cmd::SetScissorRect{2, 1, 2, 1}}});
    EXPECT_EQ(red_pixels(painting),
              (std::vector<int>{0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST_P(Orientation, EmptyScissorDrawsNothing) {
    Painting painting(device(), {});
    painting.paint({{.scissor = gpu::cmd::SetScissorRect{1, 1, 0, 0}}});
    EXPECT_EQ(red_pixels(painting), std::vector<int>(16, 0));
}

TEST_P(Orientation, ViewportAndScissorStartAfreshInEveryPass) {
    Painting painting(device(), {});
    painting.paint({{.viewport = gpu::cmd::SetViewport{0, 0, 1, 1, 0, 1},
                     .scissor = gpu::cmd::SetScissorRect{0, 0, 1, 1}}});
    painting.paint({});
    EXPECT_EQ(red_pixels(painting), std::vector<int>(16, 0)) << "a clear was cut by a scissor";
}

TEST_P(Orientation, PointsAndLinesAreFrontFacing) {
    const gpu::DepthStencilState count{.depth_compare = gpu::Compare::Always,
                                       .stencil_front = {.pass_op = gpu::StencilOp::IncrementWrap},
                                       .stencil_back = {.pass_op = gpu::StencilOp::Invert}};
    Painting painting(device(), {});
    painting.paint({{.vertices = {{-0.75F, 0.75F, 0.5F}, {0.75F, -0.75F, 0.5F}},
                     .primitive = {.topology = gpu::PrimitiveTopology::PointList},
                     .depth_stencil = count,
                     .write_mask = gpu::ColorWrite::None}});
    const auto stencil = painting.stencil();
    EXPECT_EQ(stencil[0], 1);
    EXPECT_EQ(stencil[15], 1);
    EXPECT_EQ(stencil[5], 0);

    painting.paint({{.vertices = {{-1.0F, 0.25F, 0.5F}, {1.0F, 0.25F, 0.5F}},
                     .primitive = {.topology = gpu::PrimitiveTopology::LineList},
                     .depth_stencil = count,
                     .write_mask = gpu::ColorWrite::None}});
    const auto line = painting.stencil();
    EXPECT_EQ(line[5], 1);
    EXPECT_EQ(line[6], 1);
    EXPECT_EQ(line[9], 0);
}

INSTANTIATE_TEST_SUITE_P(Devices, Orientation, testing::ValuesIn(drawing_devices()),
                         test::device_case_name);

}  // namespace
}  // namespace gnomon::conformance
