// SPDX-License-Identifier: MIT
//
// Handles that are stale, owners that outlive the device, the order in which things go, counters.
#include <optional>

#include "mock_backend.hpp"
#include "world.hpp"

namespace gnomon::gpu::test {
namespace {

using testing::_;
using testing::NiceMock;

constexpr std::byte four_bytes[4] = {};

TEST(Lifetime, AnOwnerFreesItsObject) {
    Device device(create_null_backend());
    {
        const Buffer buffer = take(device.create_buffer({"b", 4, BufferUsage::Vertex}));
        EXPECT_TRUE(buffer);
        EXPECT_EQ(device.counters().objects_alive, 1U);
    }
    EXPECT_EQ(device.counters().objects_alive, 0U);
}

TEST(Lifetime, OwnersMove) {
    Device device(create_null_backend());
    Buffer a = take(device.create_buffer({"a", 4, BufferUsage::CopyDst}));
    Buffer b = take(device.create_buffer({"b", 4, BufferUsage::CopyDst}));
    const BufferId old_b = b;
    const BufferId id = a;
    b = std::move(a);
    EXPECT_EQ(b.id(), id);
    EXPECT_EQ(device.counters().objects_alive, 1U);
    expect_outcome(device.write_buffer(b, 0, four_bytes), valid);
    expect_outcome(device.write_buffer(old_b, 0, four_bytes),
                   "[Buffer \"b\"] was destroyed. While writing [Buffer \"b\"].");
    b.reset();
    b.reset();
    EXPECT_FALSE(b);
    EXPECT_EQ(device.counters().objects_alive, 0U);
}

TEST(Lifetime, AStaleIdIsNamedByItsLabel) {
    Device device(create_null_backend());
    Buffer buffer = take(device.create_buffer({"indices", 4, BufferUsage::CopyDst}));
    const BufferId stale = buffer;
    buffer.reset();
    const char* message = "[Buffer \"indices\"] was destroyed. While writing [Buffer \"indices\"].";
    expect_outcome(device.write_buffer(stale, 0, four_bytes), message);
    const Buffer successor = take(device.create_buffer({"next", 4, BufferUsage::CopyDst}));
    EXPECT_EQ(successor.id().index, stale.index);
    expect_outcome(device.write_buffer(stale, 0, four_bytes), message);
    expect_outcome(device.write_buffer(successor, 0, four_bytes), valid);
}

TEST(Lifetime, AnIdThatWasNeverGivenOutIsRecognised) {
    Device device(create_null_backend());
    expect_outcome(device.write_buffer({7, 3}, 0, four_bytes),
                   "[Buffer] (index 7, generation 3) does not belong to this device. While writing "
                   "[Buffer].");
}

TEST(Lifetime, OwnersAndEncodersMayOutliveTheDevice) {
    auto world = std::make_unique<World>();
    Buffer buffer = std::move(world->vertices);
    Texture texture = std::move(world->color);
    RenderPipeline pipeline = std::move(world->pipeline);
    CommandEncoder encoder = world->device.create_command_encoder("frame");
    RenderPassEncoder pass = encoder.begin_render_pass(world->pass_desc());
    world.reset();
    pass.draw(3);
    pass.end();
    expect_outcome(encoder.finish(), "The device of [CommandBuffer \"frame\"] is gone.");
    buffer.reset();
    EXPECT_FALSE(buffer);
    EXPECT_TRUE(texture);  // still names what is gone, and frees nothing
}

TEST(Lifetime, DevicesMoveWithTheirObjects) {
    Device device(create_null_backend());
    const Buffer buffer = take(device.create_buffer({"b", 4, BufferUsage::CopyDst}));
    Device moved = std::move(device);
    expect_outcome(moved.write_buffer(buffer, 0, four_bytes), valid);
    moved = Device(create_null_backend());
    expect_outcome(moved.write_buffer(buffer, 0, four_bytes),
                   "[Buffer] (index 0, generation 1) does not belong to this device. While writing "
                   "[Buffer].");
}

TEST(Lifetime, TheDeviceFreesWhatIsLeftAndThenItsBackend) {
    std::optional<Buffer> buffer;
    std::optional<BindGroupLayout> layout;
    std::optional<BindGroup> group;
    std::optional<Shader> shader;
    std::optional<RenderPipeline> pipeline;
    auto backend = std::make_unique<NiceMock<MockBackend>>();
    backend->caps_.limits.min_uniform_buffer_offset_alignment = 4;
    const testing::InSequence in_sequence;
    EXPECT_CALL(*backend, destroy(testing::An<BindGroupId>())).Times(1);
    EXPECT_CALL(*backend, destroy(testing::An<RenderPipelineId>())).Times(1);
    EXPECT_CALL(*backend, destroy(testing::An<BindGroupLayoutId>())).Times(1);
    EXPECT_CALL(*backend, destroy(testing::An<ShaderId>())).Times(1);
    EXPECT_CALL(*backend, destroy(testing::An<BufferId>())).Times(1);
    EXPECT_CALL(*backend, gone()).Times(1);
    {
        Device device(std::move(backend));
        buffer = take(device.create_buffer({"b", 64, BufferUsage::Uniform}));
        layout = take(device.create_bind_group_layout(
            {"l", {{.binding = 0, .visibility = ShaderStage::Vertex}}}));
        group = take(device.create_bind_group({"g", *layout, {{.binding = 0, .buffer = *buffer}}}));
        shader = take(device.create_shader(shader_desc("s", ShaderStage::Vertex)));
        pipeline = take(device.create_render_pipeline(
            {.label = "p",
             .vertex = *shader,
             .depth_stencil = DepthStencilState{.format = Format::Depth32Float,
                                                .depth_compare = Compare::Greater}}));
        EXPECT_EQ(device.counters().objects_alive, 5U);
    }
}

TEST(Lifetime, AnObjectThatTheBackendRefusedLeavesNothing) {
    auto backend = std::make_unique<NiceMock<MockBackend>>();
    EXPECT_CALL(*backend, create_buffer(_, _))
        .WillOnce(testing::Return(Status(fail(ErrorCode::OutOfMemory, "No memory."))))
        .WillOnce(testing::Return(Status()));
    EXPECT_CALL(*backend, destroy(testing::An<BufferId>())).Times(1);
    Device device(std::move(backend));
    const auto refused = device.create_buffer({"b", 4, BufferUsage::Vertex});
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, ErrorCode::OutOfMemory);
    EXPECT_EQ(refused.error().message, "No memory.");
    EXPECT_EQ(device.counters().objects_alive, 0U);
    expect_outcome(device.create_buffer({"b", 4, BufferUsage::Vertex}), valid);
}

TEST(Lifetime, PartsMayGoBeforeTheWhole) {
    World w;
    w.vertex_shader.reset();
    w.fragment_shader.reset();
    w.uniform_layout.reset();
    w.texture_layout.reset();
    const auto finished = w.record_pass(w.pass_desc(), [&](RenderPassEncoder& pass) {
        w.set_state(pass);
        pass.draw(3);
    });
    ASSERT_TRUE(finished.has_value()) << finished.error().message;
    expect_outcome(w.device.submit(*finished), valid);
}

TEST(Lifetime, NothingThatACommandNamesMayGoBeforeSubmit) {
    struct Case {
        std::function<void(World&)> free;
        const char* message;
    };
    const std::vector<Case> cases = {
        {[](World&) {}, valid},
        {[](World& w) { w.pipeline.reset(); }, "[RenderPipeline \"pipeline\"] was destroyed."},
        {[](World& w) { w.uniform_group.reset(); }, "[BindGroup \"uniform_group\"] was destroyed."},
        {[](World& w) { w.vertices.reset(); }, "[Buffer \"vertices\"] was destroyed."},
        {[](World& w) { w.indices.reset(); }, "[Buffer \"indices\"] was destroyed."},
        {[](World& w) { w.color.reset(); }, "[Texture \"color\"] was destroyed."},
        {[](World& w) { w.depth.reset(); }, "[Texture \"depth\"] was destroyed."},
        {[](World& w) { w.occlusion.reset(); }, "[QuerySet \"occlusion\"] was destroyed."},
        {[](World& w) { w.timestamps.reset(); }, "[QuerySet \"timestamps\"] was destroyed."},
        {[](World& w) { w.uniforms.reset(); },
         "[Buffer \"uniforms\"] was destroyed. It is bound by [BindGroup \"uniform_group\"]."},
        {[](World& w) { w.albedo.reset(); },
         "[Texture \"albedo\"] was destroyed. It is bound by [BindGroup \"texture_group\"]."},
        {[](World& w) { w.sampler.reset(); },
         "[Sampler \"sampler\"] was destroyed. It is bound by [BindGroup \"texture_group\"]."},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.message);
        World w;
        RenderPassDesc desc = w.pass_desc();
        desc.timestamp_writes = TimestampWrites{w.timestamps, 0, 1};
        const auto finished = w.record_pass(desc, [&](RenderPassEncoder& pass) {
            w.set_state(pass);
            pass.draw_indexed(3);
        });
        ASSERT_TRUE(finished.has_value()) << finished.error().message;
        c.free(w);
        expect_outcome(
            w.device.submit(*finished),
            c.message == std::string(valid)
                ? valid
                : std::string(c.message) + " While submitting [CommandBuffer \"frame\"].");
        EXPECT_EQ(w.device.counters().submissions, c.message == std::string(valid) ? 1U : 0U);
    }
}

TEST(Lifetime, ResolveTargetsAndCopiesAreCheckedAtSubmit) {
    World w;
    Texture resolved = take(w.device.create_texture(target_desc("resolved", Format::Rgba8Unorm)));
    const auto resolve =
        w.record_pass({.color_attachments = {{.texture = w.color4, .resolve_target = resolved}}},
                      [](RenderPassEncoder&) {});
    ASSERT_TRUE(resolve.has_value()) << resolve.error().message;
    expect_outcome(w.device.submit(*resolve), valid);
    resolved.reset();
    expect_outcome(w.device.submit(*resolve),
                   "[Texture \"resolved\"] was destroyed. While submitting [CommandBuffer "
                   "\"frame\"].");

    CommandEncoder encoder = w.device.create_command_encoder("copy");
    encoder.copy_buffer_to_buffer(w.indices, 0, w.vertices, 0, 24);
    const auto copy = encoder.finish();
    ASSERT_TRUE(copy.has_value()) << copy.error().message;
    expect_outcome(w.device.submit(*copy), valid);
    w.vertices.reset();
    expect_outcome(w.device.submit(*copy),
                   "[Buffer \"vertices\"] was destroyed. While submitting [CommandBuffer "
                   "\"copy\"].");
    w.indices.reset();
    expect_outcome(w.device.submit(*copy),
                   "[Buffer \"indices\"] was destroyed. While submitting [CommandBuffer "
                   "\"copy\"].");
}

TEST(Lifetime, DestroyedObjectsAreFoundAtFinishToo) {
    World w;
    const BufferId stale = w.vertices;
    w.vertices.reset();
    expect_outcome(
        w.record_pass(w.pass_desc(), [&](RenderPassEncoder& p) { p.set_vertex_buffer(0, stale); }),
        "[Buffer \"vertices\"] was destroyed. While encoding set_vertex_buffer (command "
        "1) in [RenderPass \"pass\"] of [CommandBuffer \"frame\"].");
}

TEST(Counters, CountWhatWasDone) {
    World w;
    EXPECT_EQ(w.device.counters().uploaded_bytes, 0U);
    const std::vector<std::byte> data(128);
    expect_outcome(w.device.write_buffer(w.vertices, 0, std::span(data).first(20)), valid);
    expect_outcome(w.device.write_buffer(w.vertices, 0, {}), valid);
    expect_outcome(w.device.write_texture(w.albedo, 0, data), valid);
    EXPECT_FALSE(w.device.write_buffer(w.vertices, 2, std::span(data).first(20)));
    EXPECT_EQ(w.device.counters().uploaded_bytes, 148U);

    CommandEncoder encoder = w.device.create_command_encoder();
    for (int i = 0; i < 2; ++i) {
        RenderPassEncoder pass = encoder.begin_render_pass(w.pass_desc());
        w.set_state(pass);
        pass.draw(3);
        pass.draw_indexed(3);
        pass.draw(0);
    }
    const auto finished = encoder.finish();
    ASSERT_TRUE(finished.has_value()) << finished.error().message;
    EXPECT_EQ(w.device.counters().draw_calls, 0U);
    expect_outcome(w.device.submit(*finished), valid);
    expect_outcome(w.device.submit(*finished), valid);
    const DeviceCounters counters = w.device.counters();
    EXPECT_EQ(counters.draw_calls, 12U);
    EXPECT_EQ(counters.render_passes, 4U);
    EXPECT_EQ(counters.submissions, 2U);
    EXPECT_EQ(counters.objects_alive, 18U);
}

}  // namespace
}  // namespace gnomon::gpu::test
