// SPDX-License-Identifier: MIT
//
// The fill meter without a device that draws: what it records, and what it needs.
#include <gnomon/shadow_pass/fill_meter.hpp>

#include <gtest/gtest.h>

#include <array>

#include <gnomon/gpu/null_backend.hpp>

namespace gnomon::shadow_pass {
namespace {

shadows::DrawList one_tetrahedron(std::uint32_t max_layers, const shadows::View& view) {
    static const std::array<glm::vec3, 4> positions{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    static const std::array<std::uint32_t, 12> indices{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    auto system = *shadows::ShadowSystem::create({.max_layers = max_layers});
    auto frame = system.begin_frame();
    const auto mesh = *shadows::ShadowMesh::build(
        {.positions = reinterpret_cast<const std::byte*>(positions.data()),
         .vertex_count = positions.size(),
         .indices = indices});
    for (std::uint64_t key = 1; key <= 3; ++key) frame.caster({.key = key, .mesh = mesh});
    frame.light({.key = 1, .position_world = {2.0, 4.0, 1.0, 1.0}});
    frame.light({.key = 2, .position_world = {-2.0, 4.0, 1.0, 1.0}});
    return std::move(frame).finish(view);
}

class FillMeter : public testing::Test {
protected:
    Result<std::vector<LightFill>> count(gpu::Device& device,
                                         const std::vector<std::size_t>& lights) {
        ShadowPass pass = *ShadowPass::create(device, {.meter = true});
        shadows::View view;
        view.view_from_world = shadows::look_at({0, 1, 6}, {0, 0, 0}, {0, 1, 0});
        view.clip_from_view = shadows::infinite_perspective(0.8, 1.5, 0.01);
        const shadows::DrawList list = one_tetrahedron(2, view);
        EXPECT_GT(list.lights[0].batches, 1U) << "folds are not metered";
        EXPECT_TRUE(pass.prepare(list, view));
        folds_ = list.lights[0].batches + list.lights[1].batches + 2;
        drawn_ = pass.stats().draw_calls;
        auto target = device.create_texture({.label = "depth-stencil",
                                             .width = 8,
                                             .height = 8,
                                             .format = gpu::Format::Depth32FloatStencil8,
                                             .usage = gpu::TextureUsage::RenderAttachment});
        const std::uint64_t before = device.counters().draw_calls;
        auto fill = count_fill(
            device, pass,
            {.depth_stencil = gpu::DepthStencilAttachment{.texture = *target,
                                                          .depth_load_op = gpu::LoadOp::Clear,
                                                          .stencil_load_op = gpu::LoadOp::Clear}},
            lights);
        metered_ = device.counters().draw_calls - before;
        return fill;
    }

    std::uint64_t folds_ = 0;
    std::uint64_t drawn_ = 0;
    std::uint64_t metered_ = 0;
};

TEST_F(FillMeter, draws_what_is_drawn_once_for_each_count) {
    gpu::Device device(gpu::create_null_backend());
    const auto fill = count(device, {0, 1});
    ASSERT_TRUE(fill) << fill.error().message;
    EXPECT_EQ(fill->size(), 2U);
    EXPECT_EQ(metered_, 2 * (drawn_ - folds_));
}

TEST_F(FillMeter, of_no_light_is_nothing) {
    gpu::Device device(gpu::create_null_backend());
    const auto fill = count(device, {});
    ASSERT_TRUE(fill) << fill.error().message;
    EXPECT_TRUE(fill->empty());
    EXPECT_EQ(metered_, 0U);
}

TEST_F(FillMeter, says_where_the_adapter_cannot_count) {
    gpu::Device device(gpu::create_null_backend({.features = {.depth32float_stencil8 = true}}));
    const auto fill = count(device, {0, 1});
    ASSERT_FALSE(fill);
    EXPECT_EQ(fill.error().code, ErrorCode::Unsupported);
    EXPECT_NE(fill.error().message.find("occlusion"), std::string::npos) << fill.error().message;
}

}  // namespace
}  // namespace gnomon::shadow_pass
