// SPDX-License-Identifier: MIT
//
// The rules of render pipelines.
#include <cmath>
#include <limits>

#include "world.hpp"

namespace gnomon::gpu::test {
namespace {

class Pipeline : public testing::Test {
protected:
    void expect(const std::vector<Row<RenderPipelineDesc>>& rows) {
        expect_rows(
            w_.pipeline_desc(), rows, "While creating [RenderPipeline \"pipeline\"].",
            [&](const RenderPipelineDesc& d) { return w_.device.create_render_pipeline(d); });
    }

    World w_;
};

TEST_F(Pipeline, Shaders) {
    expect({
        {[](auto& d) { d.vertex = {}; },
         "A Shader is needed, but the id is empty. While checking the vertex shader."},
        {[&](auto& d) { d.vertex = w_.fragment_shader; },
         "The stage of [Shader \"fragment_shader\"] is Fragment, but it is used as the Vertex "
         "shader. While checking the vertex shader."},
        {[&](auto& d) { d.fragment = w_.vertex_shader; },
         "The stage of [Shader \"vertex_shader\"] is Vertex, but it is used as the Fragment "
         "shader. While checking the fragment shader."},
        {[](auto& d) { d.fragment = {}; },
         "[RenderPipeline \"pipeline\"] writes color, but has no fragment shader. While checking "
         "target 0."},
        {[](auto& d) { d.fragment = {}, d.targets[0].write_mask = ColorWrite::None; }, valid},
        {[](auto& d) { d.fragment = {}, d.targets.clear(); }, valid},
    });
}

TEST_F(Pipeline, BindGroupLayouts) {
    std::vector<BindGroupLayout> more;
    for (std::uint32_t i = 0; i < 5; ++i) {
        more.push_back(take(w_.device.create_bind_group_layout(
            {"more", {{.binding = 10 + i, .visibility = ShaderStage::Vertex}}})));
    }
    expect({
        {[&](auto& d) {
             d.bind_group_layouts = {more[0], more[1], more[2], more[3]};
         },
         valid},
        {[&](auto& d) {
             d.bind_group_layouts = {more[0], more[1], more[2], more[3], more[4]};
         },
         "The number of bind group layouts (5) of [RenderPipeline \"pipeline\"] exceeds "
         "max_bind_groups (4)."},
        {[](auto& d) { d.bind_group_layouts[0] = {}; },
         "A BindGroupLayout is needed, but the id is empty."},
        {[&](auto& d) {
             d.bind_group_layouts = {more[2], more[0], more[2]};
         },
         "Binding 12 is in two bind group layouts of [RenderPipeline \"pipeline\"], but bindings "
         "are unique across all groups."},
    });
}

TEST_F(Pipeline, VertexBuffers) {
    const auto slots = [](RenderPipelineDesc& d, std::size_t count) {
        d.vertex_buffers.assign(count, {.array_stride = 4});
    };
    const auto attributes = [](RenderPipelineDesc& d, std::uint32_t count) {
        d.vertex_buffers.resize(1);
        d.vertex_buffers[0].attributes.clear();
        for (std::uint32_t i = 0; i < count; ++i) {
            d.vertex_buffers[0].attributes.push_back({.shader_location = i});
        }
    };
    expect({
        {[&](auto& d) { slots(d, 8); }, valid},
        {[&](auto& d) { slots(d, 9); },
         "The number of vertex buffers (9) of [RenderPipeline \"pipeline\"] exceeds "
         "max_vertex_buffers (8)."},
        {[&](auto& d) { attributes(d, 16); }, valid},
        {[&](auto& d) { attributes(d, 17); },
         "The number of vertex attributes (17) of [RenderPipeline \"pipeline\"] exceeds "
         "max_vertex_attributes (16)."},
        {[](auto& d) { d.vertex_buffers[0].array_stride = 14; },
         "The stride (14) is not a multiple of 4. While checking vertex buffer 0."},
        {[](auto& d) { d.vertex_buffers[0].array_stride = 2048; }, valid},
        {[](auto& d) { d.vertex_buffers[0].array_stride = 2052; },
         "The stride (2052) exceeds 2048. While checking vertex buffer 0."},
        {[](auto& d) { d.vertex_buffers[1].array_stride = 12; },
         "The attribute at location 1 (offset 0, 16 bytes) does not fit in the stride (12). While "
         "checking vertex buffer 1."},
        {[](auto& d) { d.vertex_buffers[1].attributes[0].offset = ~std::uint64_t{3}; },
         "The attribute at location 1 (offset 18446744073709551612, 16 bytes) does not fit in the "
         "stride (16). While checking vertex buffer 1."},
        {[](auto& d) { d.vertex_buffers[0].attributes[0].offset = 2; },
         "The offset (2) of the attribute at location 0 is not a multiple of 4. While checking "
         "vertex buffer 0."},
        {[](auto& d) { d.vertex_buffers[0].array_stride = 0; }, valid},
        {[](auto& d) {
             d.vertex_buffers[0].array_stride = 0;
             d.vertex_buffers[0].attributes[0].offset = 2040;
         },
         "The attribute at location 0 (offset 2040, 12 bytes) does not fit in the stride (2048). "
         "While checking vertex buffer 0."},
        {[](auto& d) { d.vertex_buffers[1].attributes[0].shader_location = 15; }, valid},
        {[](auto& d) { d.vertex_buffers[1].attributes[0].shader_location = 16; },
         "The location (16) of an attribute is not below max_vertex_attributes (16). While "
         "checking vertex buffer 1."},
        {[](auto& d) { d.vertex_buffers[1].attributes[0].shader_location = 0; },
         "The location 0 is used twice. While checking vertex buffer 1."},
    });
}

TEST_F(Pipeline, DepthStencil) {
    const auto bias_lines = [](RenderPipelineDesc& d) {
        d.primitive.topology = PrimitiveTopology::LineList;
        d.depth_stencil->depth_bias = 1;
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    expect({
        {[](auto& d) { d.depth_stencil.reset(); }, valid},
        {[](auto& d) { d.depth_stencil->format = Format::Undefined; },
         "The depth-stencil format (Undefined) of [RenderPipeline \"pipeline\"] is not a "
         "depth-stencil format."},
        {[](auto& d) { d.depth_stencil->format = Format::R8Uint; },
         "The depth-stencil format (R8Uint) of [RenderPipeline \"pipeline\"] is not a "
         "depth-stencil format."},
        {[](auto& d) { d.depth_stencil->depth_compare = Compare::Undefined; },
         "The depth_compare of [RenderPipeline \"pipeline\"] is Undefined, but its format "
         "(Depth32FloatStencil8) has a depth aspect."},
        {[](auto& d) { d.depth_stencil->format = Format::Depth32Float; },
         "The stencil is used by [RenderPipeline \"pipeline\"], but its format (Depth32Float) has "
         "no stencil aspect."},
        {[](auto& d) {
             d.depth_stencil->format = Format::Depth32Float;
             d.depth_stencil->stencil_front = {};
         },
         valid},
        {[](auto& d) { d.depth_stencil->stencil_back.compare = Compare::Undefined; },
         "The compare of stencil_back of [RenderPipeline \"pipeline\"] is Undefined."},
        {[](auto& d) { d.depth_stencil->stencil_read_mask = 0x100; },
         "The stencil_read_mask (0x100) of [RenderPipeline \"pipeline\"] exceeds 0xff."},
        {[](auto& d) { d.depth_stencil->stencil_write_mask = 0x1FF; },
         "The stencil_write_mask (0x1ff) of [RenderPipeline \"pipeline\"] exceeds 0xff."},
        {[](auto& d) { d.depth_stencil->depth_bias = 1; }, valid},
        {bias_lines,
         "The depth of [RenderPipeline \"pipeline\"] is biased, but its topology is not "
         "TriangleList."},
        {[](auto& d) { d.primitive.topology = PrimitiveTopology::LineList; }, valid},
        {[nan](auto& d) { d.depth_stencil->depth_bias_slope_scale = nan; },
         "The depth bias (slope scale nan, clamp 0) of [RenderPipeline \"pipeline\"] is not "
         "finite."},
    });
}

TEST_F(Pipeline, Targets) {
    const auto blend = [](RenderPipelineDesc& d, Format format) {
        d.targets[0] = {.format = format, .blend = BlendState{}};
    };
    expect({
        {[](auto& d) { d.targets.assign(8, {.format = Format::R8Unorm}); }, valid},
        {[](auto& d) { d.targets.assign(9, {.format = Format::R8Unorm}); },
         "The number of targets (9) of [RenderPipeline \"pipeline\"] exceeds "
         "max_color_attachments (8)."},
        {[](auto& d) { d.targets[0].format = Format::Undefined; },
         "The format (Undefined) is not a color format. While checking target 0."},
        {[](auto& d) { d.targets[0].format = Format::Depth32Float; },
         "The format (Depth32Float) is not a color format. While checking target 0."},
        {[](auto& d) { d.targets[0].write_mask = static_cast<ColorWrite>(16); },
         "The write mask (0x10) has unknown bits. While checking target 0."},
        {[&](auto& d) { blend(d, Format::Rgba16Float); }, valid},
        {[&](auto& d) { blend(d, Format::R32Uint); },
         "Blending is on, but the format (R32Uint) is not blendable. While checking target 0."},
        {[&](auto& d) {
             blend(d, Format::Rgba8Unorm);
             d.targets[0].blend->alpha.operation = BlendOperation::Max;
         },
         "The blend operation is Min or Max, but its factors are not both One. While checking "
         "target 0."},
        {[&](auto& d) {
             blend(d, Format::Rgba8Unorm);
             d.targets[0].blend->alpha = {BlendFactor::One, BlendFactor::One, BlendOperation::Max};
         },
         valid},
        {[](auto& d) { d.targets.clear(); }, valid},
        {[](auto& d) { d.targets.clear(), d.depth_stencil.reset(); },
         "[RenderPipeline \"pipeline\"] has neither a target nor a depth-stencil state."},
    });
}

TEST_F(Pipeline, Samples) {
    expect({
        {[](auto& d) { d.sample_count = 4; }, valid},
        {[](auto& d) { d.sample_count = 8; },
         "The sample count (8) of [RenderPipeline \"pipeline\"] is neither 1 nor 4."},
    });
}

TEST(PipelineFeatures, AreThoseOfTheAdapter) {
    struct Case {
        bool Features::*feature;
        std::function<void(RenderPipelineDesc&)> change;
        std::string message;
    };
    const std::vector<Case> cases = {
        {&Features::unclipped_depth, [](auto& d) { d.primitive.unclipped_depth = true; },
         "[RenderPipeline \"pipeline\"] uses unclipped_depth, which this adapter does not have."},
        {&Features::depth_bounds, [](auto& d) { d.depth_stencil->depth_bounds_test = true; },
         "[RenderPipeline \"pipeline\"] uses depth_bounds_test, which this adapter does not have."},
        {&Features::multisample_4, [](auto& d) { d.sample_count = 4; },
         "The sample count of [RenderPipeline \"pipeline\"] is 4, but this adapter has no "
         "multisample_4."},
        {&Features::depth24unorm_stencil8,
         [](auto& d) { d.depth_stencil->format = Format::Depth24UnormStencil8; },
         "The format of [RenderPipeline \"pipeline\"] is Depth24UnormStencil8, which this adapter "
         "does not have."},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.message);
        for (const bool able : {true, false}) {
            NullBackendOptions options;
            options.features.*c.feature = able;
            Device device(create_null_backend(options));
            const Shader vertex = take(device.create_shader(shader_desc("v", ShaderStage::Vertex)));
            RenderPipelineDesc desc{
                .label = "pipeline",
                .vertex = vertex,
                .depth_stencil = DepthStencilState{.format = Format::Depth32Float,
                                                   .depth_compare = Compare::Less}};
            c.change(desc);
            expect_outcome(
                device.create_render_pipeline(desc),
                able ? valid : c.message + " While creating [RenderPipeline \"pipeline\"].");
        }
    }
}

}  // namespace
}  // namespace gnomon::gpu::test
