// SPDX-License-Identifier: MIT
//
// The rules of the order of commands: passes, debug groups, queries, dynamic state, copies; and how
// violations are listed.
#include <algorithm>
#include <limits>

#include "internal/validate_commands.hpp"
#include "world.hpp"

namespace gnomon::gpu::test {
namespace {

class Command : public testing::Test {
protected:
    /// What recording into a pass gives; "{}" in `message` stands for the frame of the pass.
    void expect_in_pass(const std::function<void(RenderPassEncoder&)>& record,
                        const std::string& function, std::size_t command,
                        const std::string& message) {
        SCOPED_TRACE(function);
        expect_outcome(w_.record_pass(w_.pass_desc(), record),
                       message == valid
                           ? valid
                           : message + " While encoding " + function + " (command " +
                                 std::to_string(command) +
                                 ") in [RenderPass \"pass\"] of [CommandBuffer \"frame\"].");
    }
    void expect_encoded(const std::function<void(CommandEncoder&)>& record,
                        const std::string& message) {
        CommandEncoder encoder = w_.device.create_command_encoder("frame");
        record(encoder);
        expect_outcome(encoder.finish(), message);
    }

    World w_;
};

TEST_F(Command, AnEmptyBufferIsValid) {
    expect_encoded([](CommandEncoder&) {}, valid);
}

TEST_F(Command, PassesEndBeforeFinish) {
    CommandEncoder encoder = w_.device.create_command_encoder("frame");
    RenderPassEncoder pass = encoder.begin_render_pass(w_.pass_desc());
    expect_outcome(encoder.finish(),
                   "[RenderPass \"pass\"] has not ended. While finishing [CommandBuffer "
                   "\"frame\"].");
    pass.end();
    expect_outcome(encoder.finish(), valid);  // empty by now, whatever the old pass did
}

TEST_F(Command, PassesDoNotNest) {
    expect_encoded(
        [&](CommandEncoder& encoder) {
            RenderPassDesc inner_desc = w_.pass_desc();
            inner_desc.label = "inner";
            RenderPassEncoder outer = encoder.begin_render_pass(w_.pass_desc());
            RenderPassEncoder inner = encoder.begin_render_pass(inner_desc);
        },
        "[RenderPass \"inner\"] begins before [RenderPass \"pass\"] has ended. While encoding "
        "begin_render_pass (command 1) in [RenderPass \"pass\"] of [CommandBuffer \"frame\"].");
    expect_encoded(
        [&](CommandEncoder& encoder) {
            encoder.begin_render_pass(w_.pass_desc()).end();
            encoder.begin_render_pass(w_.pass_desc()).end();
        },
        valid);
}

TEST_F(Command, APassThatHasEndedRecordsNothing) {
    CommandEncoder encoder = w_.device.create_command_encoder("frame");
    RenderPassEncoder first = encoder.begin_render_pass(w_.pass_desc());
    first.end();
    RenderPassDesc other = w_.pass_desc();
    other.label = "other";
    RenderPassEncoder second = encoder.begin_render_pass(other);
    first.draw(3);
    first.end();
    second.end();
    expect_outcome(encoder.finish(),
                   "draw was called on [RenderPass \"pass\"] after its end. While finishing "
                   "[CommandBuffer \"frame\"].\n"
                   "end was called on [RenderPass \"pass\"] after its end. While finishing "
                   "[CommandBuffer \"frame\"].");
}

TEST_F(Command, APassMayBeMoved) {
    CommandEncoder encoder = w_.device.create_command_encoder("frame");
    RenderPassEncoder pass = encoder.begin_render_pass(w_.pass_desc());
    RenderPassEncoder moved = std::move(pass);
    CommandEncoder moved_encoder = std::move(encoder);
    w_.set_state(moved);
    moved.draw(3);
    moved.end();
    const auto finished = moved_encoder.finish();
    ASSERT_TRUE(finished.has_value()) << finished.error().message;
    EXPECT_EQ(finished->commands.size(), 9U);
}

// An encoder cannot record these; a replayed command list can hold them.
TEST_F(Command, PassCommandsBelongInsideOfAPass) {
    struct Case {
        gpu::Command command;
        const char* function;
    };
    const std::vector<Case> cases = {
        {cmd::EndRenderPass{}, "end"},
        {cmd::SetPipeline{}, "set_pipeline"},
        {cmd::SetBindGroup{}, "set_bind_group"},
        {cmd::SetVertexBuffer{}, "set_vertex_buffer"},
        {cmd::SetIndexBuffer{}, "set_index_buffer"},
        {cmd::SetStencilReference{}, "set_stencil_reference"},
        {cmd::SetBlendConstant{}, "set_blend_constant"},
        {cmd::SetViewport{}, "set_viewport"},
        {cmd::SetScissorRect{}, "set_scissor_rect"},
        {cmd::SetDepthBounds{}, "set_depth_bounds"},
        {cmd::Draw{}, "draw"},
        {cmd::DrawIndexed{}, "draw_indexed"},
        {cmd::BeginOcclusionQuery{}, "begin_occlusion_query"},
        {cmd::EndOcclusionQuery{}, "end_occlusion_query"},
    };
    const DeviceState device(create_null_backend());
    for (const Case& c : cases) {
        CommandBuffer buffer;
        buffer.commands.push_back(c.command);
        expect_outcome(validate_commands(device, buffer, {}),
                       std::string("The command is outside of a render pass. While encoding ") +
                           c.function + " (command 0) of [CommandBuffer].");
    }
}

TEST_F(Command, DebugGroupsAreBalanced) {
    const auto push = [](auto& encoder) { encoder.push_debug_group("group"); };
    const auto pop = [](auto& encoder) { encoder.pop_debug_group(); };
    expect_encoded(
        [&](CommandEncoder& e) {
            push(e), push(e), pop(e);
            RenderPassEncoder pass = e.begin_render_pass(w_.pass_desc());
            push(pass), pop(pass);
            pass.end();
            pop(e);
        },
        valid);
    expect_encoded([&](CommandEncoder& e) { pop(e); },
                   "There is no debug group to pop. While encoding pop_debug_group (command 0) of "
                   "[CommandBuffer \"frame\"].");
    expect_encoded([&](CommandEncoder& e) { push(e), push(e); },
                   "The number of debug groups that are still open is 2. While finishing "
                   "[CommandBuffer \"frame\"].");
    expect_in_pass([&](RenderPassEncoder& pass) { push(pass); }, "end", 2,
                   "The number of debug groups that are still open is 1.");
    expect_in_pass([&](RenderPassEncoder& pass) { pop(pass); }, "pop_debug_group", 1,
                   "There is no debug group to pop.");
    // A pass cannot close what was opened outside of it.
    expect_encoded(
        [&](CommandEncoder& e) {
            push(e);
            RenderPassEncoder pass = e.begin_render_pass(w_.pass_desc());
            pop(pass);
            pass.end();
            pop(e);
        },
        "There is no debug group to pop. While encoding pop_debug_group (command 2) in "
        "[RenderPass \"pass\"] of [CommandBuffer \"frame\"].");
}

TEST_F(Command, OcclusionQueries) {
    expect_in_pass(
        [](auto& p) {
            p.begin_occlusion_query(1), p.end_occlusion_query();
            p.begin_occlusion_query(0), p.end_occlusion_query();
        },
        "", 0, valid);
    expect_in_pass([](auto& p) { p.begin_occlusion_query(2), p.end_occlusion_query(); },
                   "begin_occlusion_query", 1,
                   "The occlusion query index (2) is not below the count (2) of [QuerySet "
                   "\"occlusion\"].");
    expect_in_pass(
        [](auto& p) {
            p.begin_occlusion_query(0), p.begin_occlusion_query(1), p.end_occlusion_query();
        },
        "begin_occlusion_query", 2, "The occlusion query 1 begins before the query 0 has ended.");
    expect_in_pass(
        [](auto& p) {
            p.begin_occlusion_query(1), p.end_occlusion_query();
            p.begin_occlusion_query(1), p.end_occlusion_query();
        },
        "begin_occlusion_query", 3, "The occlusion query 1 is used twice in the pass.");
    expect_in_pass([](auto& p) { p.end_occlusion_query(); }, "end_occlusion_query", 1,
                   "No occlusion query has begun.");
    expect_in_pass([](auto& p) { p.begin_occlusion_query(0); }, "end", 2,
                   "The occlusion query 0 has not ended.");

    RenderPassDesc without = w_.pass_desc();
    without.occlusion_query_set = {};
    expect_outcome(
        w_.record_pass(without,
                       [](auto& p) { p.begin_occlusion_query(0), p.end_occlusion_query(); }),
        "The pass has no occlusion query set. While encoding begin_occlusion_query "
        "(command 1) in [RenderPass \"pass\"] of [CommandBuffer \"frame\"].");
}

TEST_F(Command, StencilReference) {
    expect_in_pass([](auto& p) { p.set_stencil_reference(255); }, "", 0, valid);
    expect_in_pass([](auto& p) { p.set_stencil_reference(256); }, "set_stencil_reference", 1,
                   "The stencil reference (256) exceeds 255.");
}

TEST_F(Command, BlendConstantsAreAlwaysValid) {
    expect_in_pass([](auto& p) { p.set_blend_constant({.r = -1.0, .g = 9.0}); }, "", 0, valid);
}

TEST_F(Command, Viewport) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    struct Case {
        cmd::SetViewport v;
        std::string message;
    };
    const auto outside = [](const char* rectangle) {
        return std::string("The viewport (") + rectangle +
               ") is empty or not within the attachments (64 x 32).";
    };
    const auto depth = [](const char* range) {
        return std::string("The depth range of the viewport (") + range +
               ") is not an interval within 0 and 1.";
    };
    const std::vector<Case> cases = {
        {{0, 0, 64, 32, 0, 1}, valid},
        {{0.5F, 0.25F, 63.5F, 31.75F, 0.5F, 0.5F}, valid},
        {{-1, 0, 4, 4, 0, 1}, outside("x -1, y 0, width 4, height 4")},
        {{0, -1, 4, 4, 0, 1}, outside("x 0, y -1, width 4, height 4")},
        {{1, 0, 64, 4, 0, 1}, outside("x 1, y 0, width 64, height 4")},
        {{0, 1, 4, 32, 0, 1}, outside("x 0, y 1, width 4, height 32")},
        {{0, 0, 0, 4, 0, 1}, outside("x 0, y 0, width 0, height 4")},
        {{0, 0, 4, 0, 0, 1}, outside("x 0, y 0, width 4, height 0")},
        {{nan, 0, 4, 4, 0, 1}, outside("x nan, y 0, width 4, height 4")},
        {{0, 0, 4, nan, 0, 1}, outside("x 0, y 0, width 4, height nan")},
        {{0, 0, 4, 4, -0.5F, 1}, depth("-0.5 to 1")},
        {{0, 0, 4, 4, 0, 1.5F}, depth("0 to 1.5")},
        {{0, 0, 4, 4, 0.75F, 0.5F}, depth("0.75 to 0.5")},
        {{0, 0, 4, 4, nan, 1}, depth("nan to 1")},
    };
    for (const Case& c : cases) {
        expect_in_pass(
            [&](RenderPassEncoder& p) {
                p.set_viewport(c.v.x, c.v.y, c.v.width, c.v.height, c.v.min_depth, c.v.max_depth);
            },
            "set_viewport", 1, c.message);
    }
}

TEST_F(Command, ScissorRect) {
    struct Case {
        cmd::SetScissorRect s;
        std::string message;
    };
    const auto outside = [](const char* rectangle) {
        return std::string("The scissor rectangle (") + rectangle +
               ") is not within the attachments (64 x 32).";
    };
    const std::vector<Case> cases = {
        {{0, 0, 64, 32}, valid},
        {{64, 32, 0, 0}, valid},
        {{1, 0, 64, 1}, outside("x 1, y 0, width 64, height 1")},
        {{0, 1, 1, 32}, outside("x 0, y 1, width 1, height 32")},
        {{65, 0, 0, 1}, outside("x 65, y 0, width 0, height 1")},
        {{2, 0, 0xFFFFFFFF, 1}, outside("x 2, y 0, width 4294967295, height 1")},
    };
    for (const Case& c : cases) {
        expect_in_pass(
            [&](RenderPassEncoder& p) { p.set_scissor_rect(c.s.x, c.s.y, c.s.width, c.s.height); },
            "set_scissor_rect", 1, c.message);
    }
}

TEST_F(Command, DepthBounds) {
    struct Case {
        float min;
        float max;
        std::string message;
    };
    const auto no_interval = [](const char* bounds) {
        return std::string("The depth bounds (") + bounds + ") are not an interval within 0 and 1.";
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<Case> cases = {
        {0, 1, valid},
        {0.5F, 0.5F, valid},
        {-0.5F, 1, no_interval("-0.5 to 1")},
        {0, 1.5F, no_interval("0 to 1.5")},
        {0.75F, 0.5F, no_interval("0.75 to 0.5")},
        {nan, 1, no_interval("nan to 1")},
        {0, nan, no_interval("0 to nan")},
    };
    for (const Case& c : cases) {
        expect_in_pass([&](RenderPassEncoder& p) { p.set_depth_bounds(c.min, c.max); },
                       "set_depth_bounds", 1, c.message);
    }
}

TEST_F(Command, CopyBufferToBuffer) {
    const cmd::CopyBufferToBuffer base{w_.indices, 0, w_.vertices, 0, 24};
    const Buffer both = w_.buffer("both", 64, BufferUsage::CopySrc | BufferUsage::CopyDst);
    const std::vector<Row<cmd::CopyBufferToBuffer>> rows = {
        {[](auto& c) { c.destination_offset = 96; }, valid},
        {[](auto& c) { c.source_offset = 24, c.size = 0; }, valid},
        {[](auto& c) { c.size = 6; }, "The size (6) is not a multiple of 4."},
        {[](auto& c) { c.source_offset = 2, c.size = 4; },
         "The source offset (2) is not a multiple of 4."},
        {[](auto& c) { c.destination_offset = 2; },
         "The destination offset (2) is not a multiple of 4."},
        {[](auto& c) { c.source_offset = 4; },
         "The source range (offset 4, size 24) does not fit in [Buffer \"indices\"] (size 24)."},
        {[](auto& c) { c.destination_offset = 100; },
         "The destination range (offset 100, size 24) does not fit in [Buffer \"vertices\"] (size "
         "120)."},
        {[](auto& c) { c.source_offset = ~std::uint64_t{3}, c.size = 4; },
         "The source range (offset 18446744073709551612, size 4) does not fit in [Buffer "
         "\"indices\"] (size 24)."},
        {[](auto& c) { c.source = {}; }, "A Buffer is needed, but the id is empty."},
        {[](auto& c) { c.destination = {}; }, "A Buffer is needed, but the id is empty."},
        {[&](auto& c) { c.source = w_.uniforms; },
         "The usage (CopyDst | Uniform) of [Buffer \"uniforms\"] lacks CopySrc."},
        {[&](auto& c) { c.source = both, c.destination = w_.indices; },
         "The usage (CopySrc | Index) of [Buffer \"indices\"] lacks CopyDst."},
        {[&](auto& c) { c.source = both, c.destination = both, c.destination_offset = 32; },
         "[Buffer \"both\"] is both source and destination."},
    };
    expect_rows(base, rows,
                "While encoding copy_buffer_to_buffer (command 0) of [CommandBuffer \"frame\"].",
                [&](const cmd::CopyBufferToBuffer& c) {
                    CommandEncoder encoder = w_.device.create_command_encoder("frame");
                    encoder.copy_buffer_to_buffer(c.source, c.source_offset, c.destination,
                                                  c.destination_offset, c.size);
                    return encoder.finish();
                });
    expect_encoded(
        [&](CommandEncoder& encoder) {
            RenderPassEncoder pass = encoder.begin_render_pass(w_.pass_desc());
            encoder.copy_buffer_to_buffer(w_.indices, 0, w_.vertices, 0, 4);
        },
        "A copy cannot happen inside of a render pass. While encoding copy_buffer_to_buffer "
        "(command 1) in [RenderPass \"pass\"] of [CommandBuffer \"frame\"].");
}

TEST_F(Command, AllViolationsAreListedUpToTwenty) {
    const auto record = [&](int count) {
        return w_.record_pass(w_.pass_desc(), [&](RenderPassEncoder& p) {
            for (int i = 0; i < count; ++i) p.set_stencil_reference(256);
        });
    };
    const auto lines = [](const Result<CommandBuffer>& result) {
        return 1 + std::ranges::count(result.error().message, '\n');
    };
    const auto twenty = record(20);
    ASSERT_FALSE(twenty.has_value());
    EXPECT_EQ(lines(twenty), 20);
    const auto more = record(33);
    ASSERT_FALSE(more.has_value());
    EXPECT_EQ(lines(more), 21);
    EXPECT_TRUE(more.error().message.ends_with("\nThis is followed by 13 more."))
        << more.error().message;
}

TEST_F(Command, AMistakeIsSaidOnceNotAtEachDraw) {
    expect_in_pass(
        [&](RenderPassEncoder& p) {
            w_.set_state(p);
            p.set_bind_group(1, w_.uniform_group);  // offsets are missing, and the layout differs
            p.set_vertex_buffer(0, {});
            p.set_bind_group(1, {});
            p.draw(3);
            p.draw(4);
        },
        "set_bind_group", 9,
        "The number of dynamic offsets (0) is not the number (1) that [BindGroup "
        "\"uniform_group\"] has. While encoding set_bind_group (command 7) in [RenderPass "
        "\"pass\"] of [CommandBuffer \"frame\"].\n"
        "A Buffer is needed, but the id is empty. While encoding set_vertex_buffer (command 8) in "
        "[RenderPass \"pass\"] of [CommandBuffer \"frame\"].\n"
        "A BindGroup is needed, but the id is empty.");
}

}  // namespace
}  // namespace gnomon::gpu::test
