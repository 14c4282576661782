// SPDX-License-Identifier: MIT
//
// What the pass uploads and records, on a device that draws nothing.
#include <gnomon/shadow_pass/shadow_pass.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string_view>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/gpu/fault_backend.hpp>
#include <gnomon/gpu/null_backend.hpp>

namespace gnomon::shadow_pass {
namespace {

// What a draw's vertices share, and the slot of a uniform buffer where it is made from quads.
constexpr std::uint64_t matrices = 148;
constexpr std::uint64_t quad_uniforms = 256;

std::shared_ptr<const shadows::ShadowMesh> tetrahedron() {
    static const std::array<glm::vec3, 4> positions{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    static const std::array<std::uint32_t, 12> indices{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    return *shadows::ShadowMesh::build(
        {.positions = reinterpret_cast<const std::byte*>(positions.data()),
         .vertex_count = positions.size(),
         .indices = indices});
}

shadows::View perspective_view() {
    shadows::View view;
    view.view_from_world = shadows::look_at({0, 1, 6}, {0, 0, 0}, {0, 1, 0});
    view.clip_from_view = shadows::infinite_perspective(0.8, 1.5, 0.01);
    return view;
}

struct World {
    std::shared_ptr<const shadows::ShadowMesh> mesh = tetrahedron();
    shadows::ShadowSystem system;
    double angle = 0.0;
    glm::dvec4 light{2.0, 4.0, 1.0, 1.0};
    int casters = 5;
    shadows::NearCaps near_caps = shadows::NearCaps::Facing;
    bool in_depth_buffer = true;

    explicit World(shadows::SystemOptions options = {})
        : system((options.fill = shadows::FillOptions::none(),
                  *shadows::ShadowSystem::create(options))) {}

    shadows::DrawList frame(const shadows::View& view) {
        auto frame = system.begin_frame();
        for (int i = 0; i < casters; ++i) {
            glm::dmat4 pose = glm::translate(glm::dmat4(1.0), glm::dvec3(i, 0, 0));
            if (i == 0) pose = glm::rotate(pose, angle, glm::dvec3(0, 1, 0));
            frame.caster({.key = static_cast<std::uint64_t>(i),
                          .mesh = mesh,
                          .world_from_local = pose,
                          .in_depth_buffer = in_depth_buffer,
                          .near_caps = near_caps});
        }
        frame.light({.key = 1, .position_world = light});
        return std::move(frame).finish(view);
    }
};

// Records one light into a pass of its own and counts what the device was asked to draw.
std::uint64_t recorded_draws(gpu::Device& device, const ShadowPass& pass) {
    auto target = device.create_texture({.label = "depth-stencil",
                                         .width = 8,
                                         .height = 8,
                                         .format = gpu::Format::Depth32FloatStencil8,
                                         .usage = gpu::TextureUsage::RenderAttachment});
    auto encoder = device.create_command_encoder("test");
    {
        auto recorder = encoder.begin_render_pass(
            {.label = "test",
             .depth_stencil = gpu::DepthStencilAttachment{.texture = *target,
                                                          .depth_load_op = gpu::LoadOp::Clear,
                                                          .stencil_load_op = gpu::LoadOp::Clear}});
        pass.record(recorder, 0);
    }
    const auto commands = encoder.finish();
    EXPECT_TRUE(commands) << commands.error().message;
    const std::uint64_t before = device.counters().draw_calls;
    EXPECT_TRUE(device.submit(*commands));
    return device.counters().draw_calls - before;
}

TEST(ShadowPass, bounds_depth_where_the_adapter_can_and_depth_is_reversed) {
    for (const bool able : {true, false}) {
        for (const gpu::Compare compare : {gpu::Compare::Greater, gpu::Compare::Less}) {
            gpu::NullBackendOptions options;
            options.features.depth_bounds = able;
            gpu::Device device(gpu::create_null_backend(options));
            ShadowPass pass = *ShadowPass::create(device, {.depth_compare = compare});
            const shadows::View view = perspective_view();
            shadows::DrawList list = World().frame(view);
            for (std::size_t i = 1; i < list.draws.size(); ++i) list.draws[i].depth = {0.25F, 0.5F};
            ASSERT_TRUE(pass.prepare(list, view));
            auto target = device.create_texture({.width = 8,
                                                 .height = 8,
                                                 .format = gpu::Format::Depth32FloatStencil8,
                                                 .usage = gpu::TextureUsage::RenderAttachment});
            auto encoder = device.create_command_encoder("test");
            {
                auto recorder = encoder.begin_render_pass(
                    {.depth_stencil = gpu::DepthStencilAttachment{.texture = *target}});
                pass.record(recorder, 0);
            }
            const auto commands = encoder.finish();
            ASSERT_TRUE(commands) << commands.error().message;
            std::vector<gpu::cmd::SetDepthBounds> set;
            for (const gpu::Command& command : commands->commands) {
                const auto* bounds = std::get_if<gpu::cmd::SetDepthBounds>(&command);
                if (bounds != nullptr) set.push_back(*bounds);
            }
            const bool bounded = able && compare == gpu::Compare::Greater;
            EXPECT_EQ(pass.stats().depth_bounded_draws, bounded ? 4U : 0U);
            ASSERT_EQ(set.size(), bounded ? 2U : 0U) << "once for all four, and back";
            if (!bounded) continue;
            EXPECT_EQ(set[0].min, 0.25F);
            EXPECT_EQ(set[0].max, 0.5F);
            EXPECT_EQ(set[1].min, 0.0F);
            EXPECT_EQ(set[1].max, 1.0F);
        }
    }
}

TEST(ShadowPass, uploads_matrices_alone_when_the_camera_moves) {
    gpu::Device device(gpu::create_null_backend());
    ShadowPass pass = *ShadowPass::create(device, {});
    World world;
    shadows::View view = perspective_view();
    ASSERT_TRUE(pass.prepare(world.frame(view), view));
    const std::uint64_t first = pass.stats().uploaded_bytes;
    const std::uint64_t held = pass.stats().index_bytes_held;
    view.view_from_world[3].x += 0.001;
    ASSERT_TRUE(pass.prepare(world.frame(view), view));
    EXPECT_EQ(pass.stats().uploaded_bytes, 5U * matrices);
    EXPECT_GT(first, pass.stats().uploaded_bytes);
    EXPECT_EQ(pass.stats().index_bytes_held, held);
}

TEST(ShadowPass, uploads_nothing_when_nothing_moved) {
    gpu::Device device(gpu::create_null_backend());
    ShadowPass pass = *ShadowPass::create(device, {});
    World world;
    const shadows::View view = perspective_view();
    for (int frame = 0; frame < 4; ++frame) {
        ASSERT_TRUE(pass.prepare(world.frame(view), view));
        EXPECT_EQ(pass.stats().uploaded_bytes == 0, frame > 0);
        EXPECT_EQ(recorded_draws(device, pass), 5U);
        EXPECT_EQ(pass.stats().draw_calls, 5U);
    }
    // A list that somebody changed says that no system made it.
    shadows::DrawList changed = world.frame(view);
    changed.revision = 0;
    changed.draws.pop_back();
    --changed.lights[0].count;
    ASSERT_TRUE(pass.prepare(changed, view));
    EXPECT_EQ(pass.stats().uploaded_bytes, 0U) << "what is left is there";
    EXPECT_EQ(recorded_draws(device, pass), 4U);
}

TEST(ShadowPass, says_when_what_was_recorded_is_good_for_another_frame) {
    gpu::Device device(gpu::create_null_backend());
    ShadowPass pass = *ShadowPass::create(device, {});
    World world;
    shadows::View view = perspective_view();
    EXPECT_EQ(pass.revision(), 0U);
    std::uint64_t before = 0;
    const auto changes = [&] {
        EXPECT_TRUE(pass.prepare(world.frame(view), view));
        return std::exchange(before, pass.revision()) != before;
    };
    EXPECT_TRUE(changes());
    EXPECT_FALSE(changes());
    view.view_from_world[3].x += 0.001;
    EXPECT_FALSE(changes()) << "of a camera that moves, matrices alone";
    world.angle = 2.0;
    EXPECT_TRUE(changes()) << "other indices";
    world.casters = 4;
    EXPECT_TRUE(changes());
    world.casters = 400;
    EXPECT_TRUE(changes()) << "another buffer of matrices too";
    EXPECT_FALSE(changes());
    shadows::DrawList none;
    EXPECT_TRUE(pass.prepare(none, view));
    EXPECT_NE(pass.revision(), before);
}

TEST(ShadowPass, uploads_the_indices_of_what_turned) {
    gpu::Device device(gpu::create_null_backend());
    ShadowPass pass = *ShadowPass::create(device, {});
    World world;
    const shadows::View view = perspective_view();
    ASSERT_TRUE(pass.prepare(world.frame(view), view));
    world.angle = 2.0;
    const shadows::DrawList list = world.frame(view);
    ASSERT_EQ(list.stats.pairs_redetected, 1U);
    ASSERT_TRUE(pass.prepare(list, view));
    ASSERT_EQ(list.draws[0].technique, shadows::Technique::DepthPass);
    EXPECT_EQ(pass.stats().uploaded_bytes, matrices + list.draws[0].volume->sides.count * 4);
}

TEST(ShadowPass, uploads_caps_when_they_are_drawn_first) {
    gpu::Device device(gpu::create_null_backend());
    ShadowPass pass = *ShadowPass::create(device, {});
    World world;
    shadows::View view = perspective_view();
    ASSERT_TRUE(pass.prepare(world.frame(view), view));
    const std::uint64_t sides = pass.stats().index_bytes_held;
    // The eye goes into the volumes and out again.
    const shadows::View within = [&] {
        shadows::View v = view;
        v.view_from_world = shadows::look_at({-1, -3, -0.2}, {2, 0, 0}, {0, 1, 0});
        return v;
    }();
    const shadows::DrawList list = world.frame(within);
    std::uint64_t all = 0;
    std::uint64_t anew = 0;
    for (const shadows::VolumeDraw& draw : list.draws) {
        const bool fail = draw.technique == shadows::Technique::DepthFail;
        all += 4 * (fail ? draw.volume->indices.size() : draw.volume->sides.count);
        anew += fail ? 4 * draw.volume->indices.size() : 0;
    }
    ASSERT_GT(list.stats.zfail_pairs, 0U);
    ASSERT_EQ(list.stats.pairs_redetected, 0U);
    ASSERT_TRUE(pass.prepare(list, within));
    EXPECT_EQ(pass.stats().uploaded_bytes, 5U * matrices + anew);
    EXPECT_EQ(pass.stats().index_bytes_held, all);
    EXPECT_GT(all, sides);
    for (const shadows::View& now : {view, within}) {
        ASSERT_TRUE(pass.prepare(world.frame(now), now));
        EXPECT_EQ(pass.stats().uploaded_bytes, 5U * matrices) << "what is there stays there";
    }
}

// One word has the bits of all four faces; the mesh itself goes once.
TEST(ShadowPass, uploads_one_bit_a_face_of_what_turned) {
    gpu::Device device(gpu::create_null_backend());
    ShadowPass pass = *ShadowPass::create(device, {});
    World world({.silhouette = "gpu_quads"});
    const shadows::View view = perspective_view();
    shadows::DrawList list = world.frame(view);
    ASSERT_EQ(list.stats.quad_pairs, 5U);
    ASSERT_TRUE(pass.prepare(list, view));
    EXPECT_EQ(pass.stats().uploaded_bytes,
              5U * (matrices + quad_uniforms + 4U) + 16U * (4U + 6U + 4U));
    EXPECT_EQ(pass.stats().index_bytes_held, 0U);
    EXPECT_EQ(pass.stats().draw_calls, 5U);
    ASSERT_TRUE(pass.prepare(world.frame(view), view));
    EXPECT_EQ(pass.stats().uploaded_bytes, 0U) << "nothing moved";
    for (int turn = 1; turn < 6; ++turn) {
        world.angle = 2.0 * turn;
        list = world.frame(view);
        ASSERT_EQ(list.stats.pairs_redetected, 1U);
        const std::uint64_t alive = device.counters().objects_alive;
        ASSERT_TRUE(pass.prepare(list, view));
        EXPECT_EQ(pass.stats().uploaded_bytes, matrices + 5U * quad_uniforms + 4U);
        EXPECT_EQ(device.counters().objects_alive, alive) << "what is freed is used again";
    }
}

TEST(ShadowPass, uploads_matrices_alone_where_the_shader_decides) {
    gpu::Device device(gpu::create_null_backend());
    ShadowPass pass = *ShadowPass::create(device, {});
    World world({.silhouette = "gpu_quads_float"});
    const shadows::View view = perspective_view();
    ASSERT_TRUE(pass.prepare(world.frame(view), view));
    EXPECT_EQ(pass.stats().uploaded_bytes,
              5U * (matrices + quad_uniforms) + 16U * (4U + 6U + 4U + 4U));
    for (int turn = 1; turn < 6; ++turn) {
        world.angle = 2.0 * turn;
        world.light += glm::dvec4(0.1, 0.2, 0.3, 0.0);
        ASSERT_TRUE(pass.prepare(world.frame(view), view));
        EXPECT_EQ(pass.stats().uploaded_bytes, 5U * (matrices + quad_uniforms));
    }
}

// A vertex stage that is the host's own knows no quads.
TEST(ShadowPass, expands_quads_where_vertices_are_made_on_the_cpu) {
    const shadows::View view = perspective_view();
    for (const ExtrusionPath path : {ExtrusionPath::VertexShader, ExtrusionPath::Cpu}) {
        std::uint64_t expected = 0;
        for (const std::string_view name : {"brute_force", "gpu_quads", "gpu_quads_float"}) {
            gpu::Device device(gpu::create_null_backend());
            ShadowPass pass = *ShadowPass::create(
                device, {.extrusion = path, .expand_quads = path == ExtrusionPath::VertexShader});
            World world({.silhouette = name});
            const shadows::DrawList list = world.frame(view);
            ASSERT_TRUE(pass.prepare(list, view));
            if (expected == 0) expected = pass.stats().index_bytes_held;
            EXPECT_GT(expected, 0U);
            EXPECT_EQ(pass.stats().index_bytes_held, expected) << name;
            EXPECT_EQ(pass.stats().draw_calls, 5U) << name;
            ASSERT_TRUE(pass.prepare(list, view));
            EXPECT_EQ(pass.stats().uploaded_bytes, 0U) << name << ": the same list";
        }
    }
}

TEST(ShadowPass, frees_the_indices_of_what_is_gone) {
    gpu::Device device(gpu::create_null_backend());
    ShadowPass pass = *ShadowPass::create(device, {});
    World world;
    const shadows::View view = perspective_view();
    ASSERT_TRUE(pass.prepare(world.frame(view), view));
    world.casters = 0;
    ASSERT_TRUE(pass.prepare(world.frame(view), view));
    EXPECT_EQ(pass.stats().index_bytes_held, 0U);
    EXPECT_EQ(pass.stats().draw_calls, 0U);
}

// What a pass has after many frames is what a new one makes of the last list.
TEST(ShadowPass, keeps_what_one_light_has_while_another_moves) {
    gpu::Device device(gpu::create_null_backend());
    ShadowPass pass = *ShadowPass::create(device, {});
    auto system = *shadows::ShadowSystem::create({.fill = shadows::FillOptions::none()});
    const shadows::View view = perspective_view();
    const auto mesh = tetrahedron();
    constexpr TargetSize target{64, 48};
    for (int step = 0; step < 400; ++step) {
        auto frame = system.begin_frame();
        const int casters = step % 50 == 49 ? 3 : 5;
        for (int i = 0; i < casters; ++i) {
            frame.caster(
                {.key = static_cast<std::uint64_t>(i),
                 .mesh = mesh,
                 .world_from_local = glm::translate(glm::dmat4(1.0), glm::dvec3(i, 0, 0))});
        }
        frame.light({.key = 1, .position_world = {2.0, 4.0, 1.0, 1.0}});
        frame.light({.key = 2, .position_world = {0.3 * step, 4.0, 3.0, 1.0}});
        const shadows::DrawList list = std::move(frame).finish(view);
        ASSERT_TRUE(pass.prepare(list, view, target));
        gpu::Device other(gpu::create_null_backend());
        ShadowPass anew = *ShadowPass::create(other, {});
        ASSERT_TRUE(anew.prepare(list, view, target));
        ASSERT_EQ(pass.stats().draw_calls, anew.stats().draw_calls) << step;
        ASSERT_EQ(pass.stats().index_bytes_held, anew.stats().index_bytes_held) << step;
        ASSERT_EQ(recorded_draws(device, pass), recorded_draws(other, anew)) << step;
    }
}

TEST(ShadowPass, records_one_draw_a_volume_and_as_many_as_it_says) {
    gpu::Device device(gpu::create_null_backend());
    ShadowPass pass = *ShadowPass::create(device, {});
    World world;
    const shadows::View view = perspective_view();
    ASSERT_TRUE(pass.prepare(world.frame(view), view));
    EXPECT_EQ(recorded_draws(device, pass), 5U);
    EXPECT_EQ(pass.stats().draw_calls, 5U);
}

// How many draws five casters take, all of them by depth-pass.
std::uint64_t draws_of(const ShadowPassDesc& desc, bool in_depth_buffer = true,
                       shadows::NearCaps near_caps = shadows::NearCaps::Facing) {
    World world;
    world.in_depth_buffer = in_depth_buffer;
    world.near_caps = near_caps;
    gpu::Device device(gpu::create_null_backend());
    ShadowPass pass = *ShadowPass::create(device, desc);
    const shadows::View view = perspective_view();
    const shadows::DrawList list = world.frame(view);
    EXPECT_EQ(list.stats.zpass_pairs, 5U);
    EXPECT_TRUE(pass.prepare(list, view));
    EXPECT_EQ(recorded_draws(device, pass), pass.stats().draw_calls);
    return pass.stats().draw_calls;
}

TEST(ShadowPass, biased_caps_take_a_draw_of_their_own) {
    const ShadowPassDesc biased{.cap_bias = {.constant = 4}};
    EXPECT_EQ(draws_of(biased), 5U) << "no caps, no bias";
    EXPECT_EQ(draws_of({}, false), 5U);
    EXPECT_EQ(draws_of(biased, false), 10U);
}

TEST(ShadowPass, averted_caps_left_to_shading_are_drawn_by_depth_pass_as_well) {
    const ShadowPassDesc open{.averted_faces = AvertedFaces::LeftToShading};
    EXPECT_EQ(draws_of(open), 5U) << "caps towards the light are never left to shading";
    EXPECT_EQ(draws_of({}, true, shadows::NearCaps::Averted), 5U);
    EXPECT_EQ(draws_of(open, true, shadows::NearCaps::Averted), 10U);
}

TEST(ShadowPass, refuses_a_cap_bias_towards_the_eye) {
    gpu::Device device(gpu::create_null_backend());
    for (const CapBias bias : {CapBias{-1, 0.0F}, CapBias{0, -0.5F}, CapBias{0, NAN}}) {
        const auto refused = ShadowPass::create(device, {.cap_bias = bias});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::InvalidInput);
        EXPECT_NE(refused.error().message.find("cap bias"), std::string::npos);
    }
}

// Five in a row behind each other, of which two may be counted together.
World split_world() {
    World world({.max_layers = 2});
    world.light = {1.0, 0.01, 0.01, 0.0};
    return world;
}

TEST(ShadowPass, records_a_fold_a_batch_and_one_more) {
    gpu::Device device(gpu::create_null_backend());
    ShadowPass pass = *ShadowPass::create(device, {});
    World world = split_world();
    const shadows::View view = perspective_view();
    const shadows::DrawList list = world.frame(view);
    ASSERT_EQ(list.draws.size(), 5U);
    ASSERT_EQ(list.lights[0].batches, 3U);
    ASSERT_TRUE(pass.prepare(list, view));
    EXPECT_EQ(recorded_draws(device, pass), 5U + 3U + 1U);
    EXPECT_EQ(pass.stats().draw_calls, 5U + 3U + 1U);
    // Not a draw more once nothing is split.
    World whole;
    ASSERT_TRUE(pass.prepare(whole.frame(view), view));
    EXPECT_EQ(recorded_draws(device, pass), 5U);
}

TEST(ShadowPass, refuses_depth_fail_under_a_far_plane_without_unclipped_depth) {
    gpu::NullBackendOptions options;
    options.features.unclipped_depth = false;
    gpu::Device device(gpu::create_null_backend(options));
    ShadowPass pass = *ShadowPass::create(device, {});
    World world;
    world.light = {0.0, 0.0, 1.0, 0.0};  // from behind the eye: its volumes may hold it
    shadows::View view = perspective_view();
    view.clip_from_view = shadows::orthographic(3.0, 2.0, 7.0, 20.0);
    view.projection = shadows::ProjectionKind::Orthographic;
    const Status refused = pass.prepare(world.frame(view), view);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Unsupported);
    EXPECT_NE(refused.error().message.find("lacks unclipped depth"), std::string::npos)
        << refused.error().message;
}

// Every fallible call of the device fails once: each failure comes back as a Result and nothing is
// left behind.
class Survives : public testing::TestWithParam<std::string_view> {};

TEST_P(Survives, a_device_that_fails_anywhere) {
    const shadows::View view = perspective_view();
    const auto make_world = [] {
        if (GetParam() == "split") return split_world();
        if (GetParam() == "whole") return World();
        return World({.silhouette = GetParam()});
    };
    bool succeeded = false;
    for (std::uint64_t fail_at = 1; !succeeded && fail_at < 200; ++fail_at) {
        gpu::FaultPlan plan{.fail_at = fail_at};
        gpu::Device device(gpu::create_fault_backend(gpu::create_null_backend(), plan));
        {
            World world = make_world();
            // With every kind of pipeline there is.
            auto pass = ShadowPass::create(
                device, {.averted_faces = AvertedFaces::LeftToShading, .cap_bias = {4, 1.0F}});
            succeeded = pass.has_value();
            if (pass) {
                const Status prepared = pass->prepare(world.frame(view), view);
                succeeded = prepared.has_value();
                // A failed frame does no harm to the next one.
                if (!prepared) {
                    EXPECT_TRUE(pass->prepare(world.frame(view), view));
                }
            }
            EXPECT_EQ(succeeded, plan.calls < fail_at);
        }
        EXPECT_EQ(device.counters().objects_alive, 0U) << "failing at call " << fail_at;
    }
    EXPECT_TRUE(succeeded);
}

INSTANTIATE_TEST_SUITE_P(ShadowPass, Survives,
                         testing::Values("whole", "split", "gpu_quads", "gpu_quads_float"),
                         [](const auto& param) { return std::string(param.param); });

}  // namespace
}  // namespace gnomon::shadow_pass
