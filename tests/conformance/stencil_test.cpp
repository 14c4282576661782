// SPDX-License-Identifier: MIT
//
// The stencil: every operation, face, outcome and comparison, masks, and both faces in one draw.
// The shape follows Dawn's DepthStencilStateTests: state and initial value in, value out.
#include "tests/conformance/painting.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::conformance {
namespace {

using gpu::Compare;
using gpu::StencilOp;
using test::drawing_devices;

enum class Outcome { StencilFail, DepthFail, Pass };
enum class Face { Front, Back };

struct OpCase {
    StencilOp op;
    std::uint32_t initial, reference;
    std::uint8_t expected;
};

constexpr OpCase op_cases[] = {
    {StencilOp::Keep, 7, 90, 7},
    {StencilOp::Zero, 7, 90, 0},
    {StencilOp::Replace, 7, 90, 90},
    {StencilOp::Invert, 0xF0, 90, 0x0F},
    {StencilOp::IncrementClamp, 7, 90, 8},
    {StencilOp::IncrementClamp, 254, 90, 255},
    {StencilOp::IncrementClamp, 255, 90, 255},
    {StencilOp::DecrementClamp, 7, 90, 6},
    {StencilOp::DecrementClamp, 1, 90, 0},
    {StencilOp::DecrementClamp, 0, 90, 0},
    {StencilOp::IncrementWrap, 7, 90, 8},
    {StencilOp::IncrementWrap, 255, 90, 0},
    {StencilOp::DecrementWrap, 7, 90, 6},
    {StencilOp::DecrementWrap, 0, 90, 255},
};

class Stencil : public test::DeviceTest {
protected:
    /// A state that does `op` on one face in one case and keeps everything else.
    static gpu::DepthStencilState state_of(StencilOp op, Face face, Outcome outcome) {
        gpu::DepthStencilState state{
            .depth_compare = outcome == Outcome::DepthFail ? Compare::Never : Compare::Always};
        gpu::StencilFaceState& side =
            face == Face::Front ? state.stencil_front : state.stencil_back;
        switch (outcome) {
            case Outcome::StencilFail: side.fail_op = op; break;
            case Outcome::DepthFail: side.depth_fail_op = op; break;
            case Outcome::Pass: side.pass_op = op; break;
        }
        if (outcome == Outcome::StencilFail) {
            state.stencil_front.compare = Compare::Never;
            state.stencil_back.compare = Compare::Never;
        }
        return state;
    }

    static Step quad(Face face, const gpu::DepthStencilState& state, std::uint32_t reference = 0) {
        return {.vertices = triangles_of({.counter_clockwise = face == Face::Front}),
                .depth_stencil = state,
                .write_mask = gpu::ColorWrite::None,
                .stencil_reference = reference};
    }

    static std::vector<std::uint8_t> all(std::uint32_t value) {
        return std::vector<std::uint8_t>(16, static_cast<std::uint8_t>(value));
    }
};

TEST_P(Stencil, EveryOperationOnEveryFaceAndOutcome) {
    for (const Outcome outcome : {Outcome::StencilFail, Outcome::DepthFail, Outcome::Pass}) {
        for (const Face face : {Face::Front, Face::Back}) {
            const Face other = face == Face::Front ? Face::Back : Face::Front;
            for (const OpCase& c : op_cases) {
                SCOPED_TRACE(testing::Message()
                             << "operation " << static_cast<int>(c.op) << ", face "
                             << static_cast<int>(face) << ", outcome " << static_cast<int>(outcome)
                             << ", initial " << c.initial);
                const auto state = state_of(c.op, face, outcome);
                Painting painting(device(), {.clear_stencil = c.initial});
                painting.paint({quad(other, state, c.reference)});
                EXPECT_EQ(painting.stencil(), all(c.initial)) << "the other face does it";
                painting.paint({quad(face, state, c.reference)});
                EXPECT_EQ(painting.stencil(), all(c.expected));
            }
        }
    }
}

TEST_P(Stencil, ComparesTheReferenceWithWhatIsStored) {
    struct Row {
        Compare compare;
        bool below, same, above;  // whether a reference below, at, above the stored value passes
    };
    constexpr Row rows[] = {
        {Compare::Never, false, false, false},      {Compare::Less, true, false, false},
        {Compare::Equal, false, true, false},       {Compare::LessEqual, true, true, false},
        {Compare::Greater, false, false, true},     {Compare::NotEqual, true, false, true},
        {Compare::GreaterEqual, false, true, true}, {Compare::Always, true, true, true},
    };
    for (const Row& row : rows) {
        const gpu::StencilFaceState face{.compare = row.compare, .pass_op = StencilOp::Invert};
        const gpu::DepthStencilState state{
            .depth_compare = Compare::Always, .stencil_front = face, .stencil_back = face};
        Painting painting(device(), {.clear_stencil = 5});
        const auto passes = [&](std::uint32_t reference) {
            painting.paint({quad(Face::Front, state, reference)});
            const auto stencil = painting.stencil();
            EXPECT_TRUE(stencil == all(5) || stencil == all(250));
            return stencil == all(250);
        };
        SCOPED_TRACE(static_cast<int>(row.compare));
        EXPECT_EQ(passes(4), row.below);
        EXPECT_EQ(passes(5), row.same);
        EXPECT_EQ(passes(6), row.above);
    }
}

TEST_P(Stencil, ReadMaskCutsBothSidesOfTheComparison) {
    const gpu::StencilFaceState face{.compare = Compare::Equal, .pass_op = StencilOp::Zero};
    gpu::DepthStencilState state{.depth_compare = Compare::Always,
                                 .stencil_front = face,
                                 .stencil_back = face,
                                 .stencil_read_mask = 0x0F};
    Painting painting(device(), {.clear_stencil = 0xA5});
    painting.paint({quad(Face::Front, state, 0x35)});
    EXPECT_EQ(painting.stencil(), all(0));
    state.stencil_read_mask = 0x1F;
    painting.paint({quad(Face::Front, state, 0x35)});
    EXPECT_EQ(painting.stencil(), all(0xA5));
}

TEST_P(Stencil, WriteMaskKeepsTheOtherBits) {
    const gpu::StencilFaceState replace{.pass_op = StencilOp::Replace};
    const gpu::StencilFaceState increment{.pass_op = StencilOp::IncrementWrap};
    gpu::DepthStencilState state{.depth_compare = Compare::Always,
                                 .stencil_front = replace,
                                 .stencil_back = replace,
                                 .stencil_write_mask = 0x3C};
    Painting painting(device(), {.clear_stencil = 0xA5});
    painting.paint({quad(Face::Front, state, 0xFF)});
    EXPECT_EQ(painting.stencil(), all((0xA5 & ~0x3C) | 0x3C));
    // An increment counts on the whole value and writes the masked bits of the sum.
    state.stencil_front = increment;
    state.stencil_back = increment;
    state.stencil_write_mask = 0x7F;
    Painting sticky(device(), {.clear_stencil = 0xFF});
    sticky.paint({quad(Face::Front, state)});
    EXPECT_EQ(sticky.stencil(), all(0x80));
}

TEST_P(Stencil, MasksHoldForBackFacesToo) {
    const gpu::StencilFaceState replace{.compare = Compare::Equal, .pass_op = StencilOp::Invert};
    const gpu::DepthStencilState state{.depth_compare = Compare::Always,
                                       .stencil_front = replace,
                                       .stencil_back = replace,
                                       .stencil_read_mask = 0x0F,
                                       .stencil_write_mask = 0x0F};
    Painting painting(device(), {.clear_stencil = 0xA5});
    painting.paint({quad(Face::Back, state, 0x05)});
    EXPECT_EQ(painting.stencil(), all(0xAA));
}

TEST_P(Stencil, ReferenceChangesBetweenDrawsOfOnePass) {
    const gpu::StencilFaceState replace{.pass_op = StencilOp::Replace};
    const gpu::DepthStencilState state{
        .depth_compare = Compare::Always, .stencil_front = replace, .stencil_back = replace};
    Painting painting(device(), {});
    Step left = quad(Face::Front, state, 11);
    left.scissor = gpu::cmd::SetScissorRect{0, 0, 2, 4};
    Step right = quad(Face::Front, state, 22);
    right.scissor = gpu::cmd::SetScissorRect{2, 0, 2, 4};
    painting.paint({left, right});
    const auto stencil = painting.stencil();
    for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(stencil[i], i % 4 < 2 ? 11 : 22);
}

TEST_P(Stencil, BothFacesOfOneDrawCountAsAVolume) {
    // Depth in the left half is nearer (reversed: larger) than the volume's back, in the right half
    // it lies behind both sides. Depth-fail counting: front faces down, back faces up.
    const gpu::DepthStencilState write{.depth_write_enabled = true,
                                       .depth_compare = Compare::Always};
    const gpu::DepthStencilState count{.depth_compare = Compare::Greater,
                                       .stencil_front = {.depth_fail_op = StencilOp::DecrementWrap},
                                       .stencil_back = {.depth_fail_op = StencilOp::IncrementWrap}};
    std::vector<Vertex> volume;
    for (const auto& [z, front] : {std::pair(0.6F, true), std::pair(0.2F, false),
                                   std::pair(0.6F, true), std::pair(0.2F, false)}) {
        const auto side = triangles_of({.z = z, .counter_clockwise = front});
        volume.insert(volume.end(), side.begin(), side.end());
    }
    Painting painting(device(), {});
    painting.paint(
        {{.vertices = triangles_of({.right = 0, .z = 0.4F}), .depth_stencil = write},
         {.vertices = volume, .depth_stencil = count, .write_mask = gpu::ColorWrite::None}});
    const auto stencil = painting.stencil();
    for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(stencil[i], i % 4 < 2 ? 2 : 0) << "pixel " << i;
}

TEST_P(Stencil, CullingHoldsAfterTwoFacedDraws) {
    // The two-pass path culls by itself; the next pipeline's own culling must not notice.
    const gpu::DepthStencilState count{.depth_compare = Compare::Always,
                                       .stencil_front = {.pass_op = StencilOp::IncrementWrap},
                                       .stencil_back = {.pass_op = StencilOp::DecrementWrap}};
    const gpu::StencilFaceState replace{.pass_op = StencilOp::Replace};
    const gpu::DepthStencilState mark{
        .depth_compare = Compare::Always, .stencil_front = replace, .stencil_back = replace};
    Step culled = quad(Face::Back, mark, 200);
    culled.primitive.cull_mode = gpu::CullMode::Back;
    Step unculled = quad(Face::Back, mark, 77);
    unculled.scissor = gpu::cmd::SetScissorRect{0, 0, 4, 1};
    Painting painting(device(), {.clear_stencil = 50});
    painting.paint({culled, quad(Face::Front, count), culled, unculled});
    const auto stencil = painting.stencil();
    for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(stencil[i], i < 4 ? 77 : 51) << "pixel " << i;
}

TEST_P(Stencil, Depth24Stencil8CountsAlike) {
    if (!features().depth24unorm_stencil8) GTEST_SKIP() << "no depth24unorm_stencil8";
    const auto state = state_of(StencilOp::IncrementWrap, Face::Back, Outcome::DepthFail);
    Painting painting(device(), {.depth_stencil_format = gpu::Format::Depth24UnormStencil8,
                                 .clear_stencil = 255});
    painting.paint({quad(Face::Front, state), quad(Face::Back, state), quad(Face::Back, state)});
    EXPECT_EQ(painting.stencil(), all(1));
}

TEST_P(Stencil, ClearReachesEveryBitWhateverWasDrawnBefore) {
    const gpu::StencilFaceState replace{.pass_op = StencilOp::Replace};
    const gpu::DepthStencilState masked{.depth_compare = Compare::Always,
                                        .stencil_front = replace,
                                        .stencil_back = replace,
                                        .stencil_write_mask = 0x01};
    Step step = quad(Face::Front, masked, 0xFF);
    step.scissor = gpu::cmd::SetScissorRect{0, 0, 1, 1};
    Painting painting(device(), {.clear_stencil = 0xC6});
    painting.paint({step});
    painting.paint({});
    EXPECT_EQ(painting.stencil(), all(0xC6));
}

INSTANTIATE_TEST_SUITE_P(Devices, Stencil, testing::ValuesIn(drawing_devices()),
                         test::device_case_name);

}  // namespace
}  // namespace gnomon::conformance
