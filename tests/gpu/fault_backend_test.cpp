// SPDX-License-Identifier: MIT
//
// Every call of a realistic sequence is made to fail once: each failure is a Result that names the
// call, and nothing leaks.
#include <gnomon/gpu/fault_backend.hpp>

#include "world.hpp"

namespace gnomon::gpu::test {
namespace {

#define TRY(variable, expression)                                    \
    auto variable##_result = (expression);                           \
    if (!variable##_result) return forward_error(variable##_result); \
    auto& variable = *variable##_result
#define TRY_STATUS(expression) \
    if (Status s = (expression); !s) return s

Status whole_sequence(Device& device) {
    TRY(vertices,
        device.create_buffer(
            {"vertices", 36, BufferUsage::Vertex | BufferUsage::CopyDst | BufferUsage::CopySrc}));
    TRY(uniforms,
        device.create_buffer({"uniforms", 64, BufferUsage::Uniform | BufferUsage::CopyDst}));
    TRY(color, device.create_texture(target_desc("color", Format::Rgba8Unorm)));
    TRY(depth, device.create_texture(target_desc("depth", Format::Depth32FloatStencil8)));
    TRY(albedo, device.create_texture({"albedo", 1, 1, Format::Rgba8Unorm,
                                       TextureUsage::TextureBinding | TextureUsage::CopyDst}));
    TRY(sampler, device.create_sampler({"sampler"}));
    TRY(vertex, device.create_shader(shader_desc("vertex", ShaderStage::Vertex)));
    TRY(fragment, device.create_shader(shader_desc("fragment", ShaderStage::Fragment)));
    TRY(layout, device.create_bind_group_layout({"layout",
                                                 {{.binding = 0, .visibility = ShaderStage::Vertex},
                                                  {.binding = 1,
                                                   .visibility = ShaderStage::Fragment,
                                                   .type = BindingType::SampledTexture}}}));
    TRY(group, device.create_bind_group({"group",
                                         layout,
                                         {{.binding = 0, .buffer = uniforms},
                                          {.binding = 1, .texture = albedo, .sampler = sampler}}}));
    TRY(pipeline, device.create_render_pipeline(
                      {.label = "pipeline",
                       .bind_group_layouts = {layout},
                       .vertex = vertex,
                       .fragment = fragment,
                       .vertex_buffers = {{.array_stride = 12, .attributes = {{}}}},
                       .depth_stencil = DepthStencilState{.format = Format::Depth32FloatStencil8,
                                                          .depth_compare = Compare::Greater},
                       .targets = {{.format = Format::Rgba8Unorm}}}));
    TRY(queries, device.create_query_set({"queries", QueryType::Occlusion, 1}));

    TRY_STATUS(device.write_buffer(vertices, 0, std::vector<std::byte>(36)));
    TRY_STATUS(device.write_texture(albedo, 0, std::vector<std::byte>(4)));

    CommandEncoder encoder = device.create_command_encoder("frame");
    {
        RenderPassEncoder pass =
            encoder.begin_render_pass({.label = "pass",
                                       .color_attachments = {{.texture = color}},
                                       .depth_stencil = DepthStencilAttachment{.texture = depth},
                                       .occlusion_query_set = queries});
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, group);
        pass.set_vertex_buffer(0, vertices);
        pass.begin_occlusion_query(0);
        pass.draw(3);
        pass.end_occlusion_query();
    }
    TRY(commands, encoder.finish());
    TRY_STATUS(device.submit(commands));
    TRY_STATUS(device.wait_idle());
    TRY(bytes, device.read_buffer(vertices, 0, 36));
    TRY(pixels, device.read_texture(color));
    TRY(samples, device.read_query_set(queries));
    EXPECT_EQ(bytes.size(), 36U);
    EXPECT_EQ(pixels.size(), 64U * 32U * 4U);
    EXPECT_EQ(samples.size(), 1U);
    return device.present(color);
}

#undef TRY
#undef TRY_STATUS

TEST(FaultBackend, EveryFailureIsAResultAndNothingLeaks) {
    const std::vector<std::string> calls = {"create_buffer",
                                            "create_buffer",
                                            "create_texture",
                                            "create_texture",
                                            "create_texture",
                                            "create_sampler",
                                            "create_shader",
                                            "create_shader",
                                            "create_bind_group_layout",
                                            "create_bind_group",
                                            "create_render_pipeline",
                                            "create_query_set",
                                            "write_buffer",
                                            "write_texture",
                                            "submit",
                                            "wait_idle",
                                            "read_buffer",
                                            "read_texture",
                                            "read_query_set",
                                            "present"};
    FaultPlan plan;
    for (std::uint64_t n = 1; n <= calls.size(); ++n) {
        SCOPED_TRACE(n);
        plan = {.fail_at = n};
        Device device(create_fault_backend(create_null_backend(), plan));
        const Status status = whole_sequence(device);
        ASSERT_FALSE(status.has_value());
        EXPECT_EQ(status.error().code, ErrorCode::OutOfMemory);
        EXPECT_EQ(status.error().message,
                  "The fault plan let call " + std::to_string(n) + ", " + calls[n - 1] + ", fail.");
        EXPECT_EQ(plan.calls, n);
        EXPECT_EQ(device.counters().objects_alive, 0U);
        EXPECT_EQ(device.counters().submissions, n > 15 ? 1U : 0U);
        EXPECT_EQ(device.counters().uploaded_bytes, n > 14 ? 40U : n > 13 ? 36U : 0U);
    }
    plan = {.fail_at = calls.size() + 1};
    Device device(create_fault_backend(create_null_backend(), plan));
    expect_outcome(whole_sequence(device), valid);
    EXPECT_EQ(plan.calls, calls.size());
    EXPECT_EQ(device.counters().objects_alive, 0U);
}

TEST(FaultBackend, ThePlanChoosesTheCodeAndZeroMeansNone) {
    FaultPlan plan{.fail_at = 2, .code = ErrorCode::DeviceLost};
    Device device(create_fault_backend(create_null_backend(), plan));
    EXPECT_EQ(device.caps().backend, "null");
    expect_outcome(device.wait_idle(), valid);
    const Status lost = device.wait_idle();
    ASSERT_FALSE(lost.has_value());
    EXPECT_EQ(lost.error().code, ErrorCode::DeviceLost);
    plan = {};
    for (int i = 0; i < 5; ++i) expect_outcome(device.wait_idle(), valid);
    EXPECT_EQ(plan.calls, 5U);
}

}  // namespace
}  // namespace gnomon::gpu::test
