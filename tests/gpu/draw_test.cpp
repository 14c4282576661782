// SPDX-License-Identifier: MIT
//
// The rules of what a pass sets and of what a draw may use.
#include <gmock/gmock.h>

#include "world.hpp"

namespace gnomon::gpu::test {
namespace {

/// Records something into a pass; the last command is the one that the message names.
struct Recorded {
    std::function<void(RenderPassEncoder&)> record;
    std::string message;
};

class Draw : public testing::Test {
protected:
    /// `message` is expected without its frame, which names `function` and the index of the last
    /// command before the pass ends.
    void expect(const RenderPassDesc& desc, const std::string& function,
                const std::vector<Recorded>& rows) {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            SCOPED_TRACE(function + ", row " + std::to_string(i));
            CommandEncoder encoder = w_.device.create_command_encoder("frame");
            RenderPassEncoder pass = encoder.begin_render_pass(desc);
            rows[i].record(pass);
            pass.end();
            const Result<CommandBuffer> finished = encoder.finish();
            if (rows[i].message == valid) {
                expect_outcome(finished, valid);
                continue;
            }
            ASSERT_FALSE(finished.has_value()) << rows[i].message;
            EXPECT_THAT(finished.error().message,
                        testing::MatchesRegex(".* While encoding " + function +
                                              " .command [0-9]+. in .RenderPass \"pass\". of "
                                              ".CommandBuffer \"frame\"..$"));
            const std::string message = finished.error().message;
            EXPECT_EQ(message.substr(0, message.find(" While encoding")), rows[i].message);
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        }
    }
    void expect(const std::string& function, const std::vector<Recorded>& rows) {
        expect(w_.pass_desc(), function, rows);
    }

    /// The world's pipeline with a change.
    RenderPipeline pipeline(const std::function<void(RenderPipelineDesc&)>& change) {
        RenderPipelineDesc desc = w_.pipeline_desc();
        change(desc);
        return take(w_.device.create_render_pipeline(desc));
    }

    World w_;
};

TEST_F(Draw, PipelinesMatchThePass) {
    const RenderPipeline red = pipeline([](auto& d) { d.targets[0].format = Format::R8Unorm; });
    const RenderPipeline none = pipeline([](auto& d) { d.targets.clear(); });
    const RenderPipeline depth24 =
        pipeline([](auto& d) { d.depth_stencil->format = Format::Depth24UnormStencil8; });
    const RenderPipeline flat = pipeline([](auto& d) { d.depth_stencil.reset(); });
    const RenderPipeline four = pipeline([](auto& d) { d.sample_count = 4; });
    const auto set = [](RenderPipelineId id) {
        return [id](RenderPassEncoder& pass) { pass.set_pipeline(id); };
    };
    expect("set_pipeline",
           {
               {set(w_.pipeline), valid},
               {set({}), "A RenderPipeline is needed, but the id is empty."},
               {set(red),
                "The format of target 0 of [RenderPipeline \"pipeline\"] is R8Unorm, but that of "
                "the attachment is Rgba8Unorm."},
               {set(none),
                "The number of targets (0) of [RenderPipeline \"pipeline\"] is not the number of "
                "color attachments (1)."},
               {set(depth24),
                "The depth-stencil format of [RenderPipeline \"pipeline\"] is "
                "Depth24UnormStencil8, but that of the attachment is Depth32FloatStencil8."},
               {set(flat),
                "The depth-stencil format of [RenderPipeline \"pipeline\"] is Undefined, but that "
                "of the attachment is Depth32FloatStencil8."},
               {set(four),
                "The sample count of [RenderPipeline \"pipeline\"] is 4, but that of the "
                "attachments is 1."},
           });
}

TEST_F(Draw, ReadOnlyAspectsAreNotWritten) {
    const auto set = [](RenderPipelineId id) {
        return [id](RenderPassEncoder& pass) { pass.set_pipeline(id); };
    };
    const RenderPipeline tests_only = pipeline([](auto& d) {
        d.depth_stencil->depth_write_enabled = false;
        d.depth_stencil->stencil_front.pass_op = StencilOp::Keep;
    });
    const RenderPipeline writes_depth =
        pipeline([](auto& d) { d.depth_stencil->stencil_front.pass_op = StencilOp::Keep; });
    const auto stencil_writer = [&](const std::function<void(RenderPipelineDesc&)>& change) {
        return pipeline([&](auto& d) {
            d.depth_stencil->depth_write_enabled = false;
            change(d);
        });
    };
    const RenderPipeline writes_stencil = stencil_writer([](auto&) {});
    const RenderPipeline masked =
        stencil_writer([](auto& d) { d.depth_stencil->stencil_write_mask = 0; });
    const RenderPipeline culled =
        stencil_writer([](auto& d) { d.primitive.cull_mode = CullMode::Front; });
    const RenderPipeline other_culled =
        stencil_writer([](auto& d) { d.primitive.cull_mode = CullMode::Back; });

    RenderPassDesc desc = w_.pass_desc();
    desc.depth_stencil = DepthStencilAttachment{
        .texture = w_.depth, .depth_read_only = true, .stencil_read_only = true};
    const char* stencil_message =
        "[RenderPipeline \"pipeline\"] writes stencil, which is read-only in the pass.";
    expect(desc, "set_pipeline",
           {
               {set(tests_only), valid},
               {set(masked), valid},
               {set(culled), valid},
               {set(writes_depth),
                "[RenderPipeline \"pipeline\"] writes depth, which is read-only in the pass."},
               {set(writes_stencil), stencil_message},
               {set(other_culled), stencil_message},
           });
}

TEST_F(Draw, BindGroups) {
    const BindGroup attached = take(w_.device.create_bind_group(
        {.label = "attached",
         .layout = w_.texture_layout,
         .entries = {{.binding = 1, .texture = w_.color, .sampler = w_.sampler}}}));
    const auto set = [](std::uint32_t group, BindGroupId id, std::vector<std::uint32_t> offsets) {
        return [=](RenderPassEncoder& pass) { pass.set_bind_group(group, id, offsets); };
    };
    // uniform_group: offset 256, size 64 of a buffer of 1024 bytes.
    expect("set_bind_group",
           {
               {set(3, w_.texture_group, {}), valid},
               {set(4, w_.texture_group, {}), "The group (4) is not below max_bind_groups (4)."},
               {set(0, {}, {}), "A BindGroup is needed, but the id is empty."},
               {set(1, attached, {}),
                "[Texture \"color\"] is bound by [BindGroup \"attached\"], but is an attachment of "
                "the pass."},
               {set(0, w_.uniform_group, {}),
                "The number of dynamic offsets (0) is not the number (1) that [BindGroup "
                "\"uniform_group\"] has."},
               {set(0, w_.uniform_group, {0, 0, 0, 0, 0}),
                "The number of dynamic offsets (5) is not the number (1) that [BindGroup "
                "\"uniform_group\"] has."},
               {set(1, w_.texture_group, {0}),
                "The number of dynamic offsets (1) is not the number (0) that [BindGroup "
                "\"texture_group\"] has."},
               {set(0, w_.uniform_group, {512}), valid},
               {set(0, w_.uniform_group, {128}),
                "The dynamic offset (128) of binding 0 is not a multiple of "
                "min_uniform_buffer_offset_alignment (256)."},
               {set(0, w_.uniform_group, {768}),
                "The dynamic offset (768) of binding 0 brings the range (offset 256, size 64) "
                "beyond the end of [Buffer \"uniforms\"] (size 1024)."},
               {set(0, w_.uniform_group, {0xFFFFFF00}),
                "The dynamic offset (4294967040) of binding 0 brings the range (offset 256, size "
                "64) beyond the end of [Buffer \"uniforms\"] (size 1024)."},
           });
}

TEST_F(Draw, Buffers) {
    const auto vertex = [](std::uint32_t slot, BufferId id, std::uint64_t offset) {
        return [=](RenderPassEncoder& pass) { pass.set_vertex_buffer(slot, id, offset); };
    };
    expect("set_vertex_buffer",
           {
               {vertex(7, w_.vertices, 120), valid},
               {vertex(8, w_.vertices, 0), "The slot (8) is not below max_vertex_buffers (8)."},
               {vertex(0, {}, 0), "A Buffer is needed, but the id is empty."},
               {vertex(0, w_.indices, 0),
                "The usage (CopySrc | Index) of [Buffer \"indices\"] lacks Vertex."},
               {vertex(0, w_.vertices, 2), "The offset (2) is not a multiple of 4."},
               {vertex(0, w_.vertices, 124),
                "The offset (124) exceeds the size (120) of [Buffer \"vertices\"]."},
           });
    const auto index = [](BufferId id, IndexFormat format, std::uint64_t offset) {
        return [=](RenderPassEncoder& pass) { pass.set_index_buffer(id, format, offset); };
    };
    expect("set_index_buffer",
           {
               {index(w_.indices, IndexFormat::Uint16, 22), valid},
               {index(w_.indices, IndexFormat::Uint32, 24), valid},
               {index({}, IndexFormat::Uint32, 0), "A Buffer is needed, but the id is empty."},
               {index(w_.vertices, IndexFormat::Uint32, 0),
                "The usage (CopyDst | Vertex) of [Buffer \"vertices\"] lacks Index."},
               {index(w_.indices, IndexFormat::Uint32, 2),
                "The offset (2) is not a multiple of the index size (4)."},
               {index(w_.indices, IndexFormat::Uint16, 3),
                "The offset (3) is not a multiple of the index size (2)."},
               {index(w_.indices, IndexFormat::Uint32, 28),
                "The offset (28) exceeds the size (24) of [Buffer \"indices\"]."},
           });
}

TEST_F(Draw, NeedsAPipelineItsGroupsAndItsBuffers) {
    const BindGroupLayout two = take(
        w_.device.create_bind_group_layout({"two",
                                            {{.binding = 0,
                                              .visibility = ShaderStage::Vertex,
                                              .has_dynamic_offset = true,
                                              .min_binding_size = 64},
                                             {.binding = 2, .visibility = ShaderStage::Vertex}}}));
    const BindGroup two_group = take(w_.device.create_bind_group(
        {"two_group",
         two,
         {{.binding = 0, .buffer = w_.uniforms}, {.binding = 2, .buffer = w_.uniforms}}}));
    const BindGroupLayout larger = take(w_.device.create_bind_group_layout(
        {"larger",
         {{.binding = 0, .visibility = ShaderStage::Vertex, .has_dynamic_offset = true}}}));
    const BindGroup larger_group = take(w_.device.create_bind_group(
        {"larger_group", larger, {{.binding = 0, .buffer = w_.uniforms}}}));
    const BindGroupLayout nothing = take(w_.device.create_bind_group_layout({"nothing", {}}));
    const BindGroup nothing_group =
        take(w_.device.create_bind_group({"nothing_group", nothing, {}}));
    const RenderPipeline with_hole = pipeline([&](auto& d) {
        d.bind_group_layouts = {w_.uniform_layout, nothing, w_.texture_layout};
    });
    const std::uint32_t zero = 0;

    expect("draw",
           {
               {[&](auto& p) { w_.set_state(p), p.draw(3, 1); }, valid},
               {[](auto& p) { p.draw(3); }, "No pipeline is set."},
               {[&](auto& p) {
                    p.set_pipeline(w_.pipeline);
                    p.set_vertex_buffer(0, w_.vertices);
                    p.set_vertex_buffer(1, w_.instances);
                    p.set_bind_group(0, w_.uniform_group, {&zero, 1});
                    p.draw(3);
                },
                "[RenderPipeline \"pipeline\"] needs a bind group 1, but none is set."},
               {[&](auto& p) {
                    w_.set_state(p);
                    p.set_bind_group(0, two_group, {&zero, 1});
                    p.draw(3);
                },
                "The layout of [BindGroup \"two_group\"] is not that of group 0 of [RenderPipeline "
                "\"pipeline\"]. The bind group alone has binding 2."},
               {[&](auto& p) {
                    w_.set_state(p);
                    p.set_bind_group(0, nothing_group);
                    p.draw(3);
                },
                "The layout of [BindGroup \"nothing_group\"] is not that of group 0 of "
                "[RenderPipeline \"pipeline\"]. The pipeline alone has binding 0."},
               {[&](auto& p) {
                    w_.set_state(p);
                    p.set_bind_group(0, larger_group, {&zero, 1});
                    p.draw(3);
                },
                "The layout of [BindGroup \"larger_group\"] is not that of group 0 of "
                "[RenderPipeline \"pipeline\"]. Binding 0 differs."},
               {[&](auto& p) {
                    w_.set_state(p);
                    p.set_pipeline(with_hole);
                    p.set_bind_group(2, w_.texture_group);
                    p.draw(3);
                },
                valid},
               {[&](auto& p) {
                    p.set_pipeline(w_.pipeline);
                    p.set_bind_group(0, w_.uniform_group, {&zero, 1});
                    p.set_bind_group(1, w_.texture_group);
                    p.set_vertex_buffer(0, w_.vertices);
                    p.draw(3);
                },
                "[RenderPipeline \"pipeline\"] needs a vertex buffer 1, but none is set."},
           });
    expect("draw_indexed", {
                               {[&](auto& p) { w_.set_state(p), p.draw_indexed(6); }, valid},
                               {[](auto& p) { p.draw_indexed(3); }, "No pipeline is set."},
                               {[&](auto& p) {
                                    p.set_pipeline(w_.pipeline);
                                    p.set_bind_group(0, w_.uniform_group, {&zero, 1});
                                    p.set_bind_group(1, w_.texture_group);
                                    p.set_vertex_buffer(0, w_.vertices);
                                    p.set_vertex_buffer(1, w_.instances);
                                    p.draw_indexed(3);
                                },
                                "No index buffer is set."},
                           });
}

TEST_F(Draw, EquivalentLayoutsMayStandForEachOther) {
    // Same entries in another order, with members set that their kind ignores.
    const BindGroupLayout twin =
        take(w_.device.create_bind_group_layout({"twin",
                                                 {{.binding = 0,
                                                   .visibility = ShaderStage::Vertex,
                                                   .has_dynamic_offset = true,
                                                   .min_binding_size = 64,
                                                   .sample_type = SampleType::Uint}}}));
    const BindGroup twin_group = take(
        w_.device.create_bind_group({"twin_group", twin, {{.binding = 0, .buffer = w_.uniforms}}}));
    const std::uint32_t zero = 0;
    expect("draw", {{[&](auto& p) {
                         w_.set_state(p);
                         p.set_bind_group(0, twin_group, {&zero, 1});
                         p.draw(3);
                     },
                     valid}});
}

TEST_F(Draw, RangesLieWithinTheBuffers) {
    // 10 vertices of 12 bytes, 2 instances of 16 bytes, 6 indices of 4 bytes or 12 of 2.
    const auto draw = [&](std::uint32_t count, std::uint32_t instances, std::uint32_t first,
                          std::uint32_t first_instance) {
        return [=, this](RenderPassEncoder& p) {
            w_.set_state(p);
            p.draw(count, instances, first, first_instance);
        };
    };
    expect("draw",
           {
               {draw(10, 2, 0, 0), valid},
               {draw(1, 1, 9, 1), valid},
               {draw(0, 1, 11, 0), valid},
               {draw(1, 0, 0, 5), valid},
               {draw(11, 1, 0, 0), "The vertices 0 to 10 are drawn, but the buffers hold 10."},
               {draw(2, 1, 9, 0), "The vertices 9 to 10 are drawn, but the buffers hold 10."},
               {draw(0xFFFFFFFF, 1, 0xFFFFFFFF, 0),
                "The vertices 4294967295 to 8589934589 are drawn, but the buffers hold 10."},
               {draw(3, 3, 0, 0), "The instances 0 to 2 are drawn, but the buffers hold 2."},
               {draw(3, 1, 0, 2), "The instances 2 to 2 are drawn, but the buffers hold 2."},
               {[&](auto& p) {
                    w_.set_state(p);
                    p.set_vertex_buffer(0, w_.vertices, 108);
                    p.draw(2);
                },
                "The vertices 0 to 1 are drawn, but the buffers hold 1."},
               {[&](auto& p) {
                    w_.set_state(p);
                    p.set_vertex_buffer(0, w_.vertices, 112);
                    p.draw(1);
                },
                "The vertices 0 to 0 are drawn, but the buffers hold 0."},
           });
    const auto indexed = [&](std::uint32_t count, std::uint32_t instances, std::uint32_t first,
                             IndexFormat format = IndexFormat::Uint32, std::uint64_t offset = 0) {
        return [=, this](RenderPassEncoder& p) {
            w_.set_state(p);
            p.set_index_buffer(w_.indices, format, offset);
            p.draw_indexed(count, instances, first, -7);
        };
    };
    expect("draw_indexed",
           {
               {indexed(6, 2, 0), valid},
               {indexed(12, 1, 0, IndexFormat::Uint16), valid},
               {indexed(0, 1, 99), valid},
               {indexed(7, 1, 0), "The indices 0 to 6 are drawn, but the buffers hold 6."},
               {indexed(1, 1, 6), "The indices 6 to 6 are drawn, but the buffers hold 6."},
               {indexed(6, 1, 0, IndexFormat::Uint32, 4),
                "The indices 0 to 5 are drawn, but the buffers hold 5."},
               {indexed(13, 1, 0, IndexFormat::Uint16),
                "The indices 0 to 12 are drawn, but the buffers hold 12."},
               {indexed(6, 3, 0), "The instances 0 to 2 are drawn, but the buffers hold 2."},
           });
}

TEST_F(Draw, StrideZeroAndSlotsWithoutAttributes) {
    const RenderPipeline constant = pipeline([](auto& d) { d.vertex_buffers[0].array_stride = 0; });
    const RenderPipeline unused = pipeline([](auto& d) { d.vertex_buffers[0].attributes.clear(); });
    const auto draw_with = [&](RenderPipelineId id, std::uint64_t offset) {
        return [=, this](RenderPassEncoder& p) {
            w_.set_state(p);
            p.set_pipeline(id);
            p.set_vertex_buffer(0, w_.vertices, offset);
            p.draw(1000);
        };
    };
    expect("draw", {
                       {draw_with(constant, 108), valid},
                       {draw_with(constant, 112),
                        "The vertices 0 to 999 are drawn, but the buffers hold 0."},
                       {draw_with(unused, 120), valid},
                   });
}

TEST_F(Draw, StateDoesNotReachTheNextPass) {
    CommandEncoder encoder = w_.device.create_command_encoder("frame");
    {
        RenderPassEncoder pass = encoder.begin_render_pass(w_.pass_desc());
        w_.set_state(pass);
        pass.draw(3);
    }
    {
        RenderPassEncoder pass = encoder.begin_render_pass(w_.pass_desc());
        pass.draw(3);
    }
    expect_outcome(encoder.finish(),
                   "No pipeline is set. While encoding draw (command 10) in [RenderPass \"pass\"] "
                   "of [CommandBuffer \"frame\"].");
}

}  // namespace
}  // namespace gnomon::gpu::test
