// SPDX-License-Identifier: MIT
//
// What is switched off is really gone: extensions one by one, stencil paths forced, functions
// missing.
#include <gmock/gmock.h>
#include <gnomon/gl/backend.hpp>

#include "tests/gl/counting_context.hpp"
#include "tests/gl/small_scene.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::gl_tests {
namespace {

using test::must;
using testing::AllOf;
using testing::HasSubstr;

class Fallbacks : public testing::Test {
protected:
    void SetUp() override {
        const auto context = gl::create_osmesa_context();
        if (context) return;
        ASSERT_FALSE(test::is_required("gl_osmesa_separate")) << context.error().message;
        GTEST_SKIP() << context.error().message;
    }
    static Result<gpu::Device> make_device(const gl::BackendOptions& options) {
        auto backend = gl::create_backend(must(gl::create_osmesa_context()), options);
        if (!backend) return forward_error(backend);
        return gpu::Device(std::move(*backend));
    }
    static gpu::Device without(const std::string& extension) {
        return must(make_device({.disabled_extensions = {extension}, .debug = true}));
    }
    static Error refusal(const gl::BackendOptions& options) {
        const auto device = make_device(options);
        EXPECT_FALSE(device.has_value());
        return device ? Error{} : device.error();
    }
};

TEST_F(Fallbacks, WithoutClipControlThereIsNoDevice) {
    const Error error = refusal({.disabled_extensions = {"GL_ARB_clip_control"}});
    EXPECT_EQ(error.code, ErrorCode::Unsupported);
    EXPECT_THAT(error.message, AllOf(HasSubstr("GL_ARB_clip_control"), HasSubstr("OSMesa")));
}

TEST_F(Fallbacks, TwoSideNeedsItsExtensions) {
    for (const char* name : {"GL_EXT_stencil_two_side", "GL_EXT_stencil_wrap"}) {
        const Error error =
            refusal({.stencil_path = gl::StencilPath::TwoSide, .disabled_extensions = {name}});
        EXPECT_EQ(error.code, ErrorCode::Unsupported);
        EXPECT_THAT(error.message, AllOf(HasSubstr("two-side"), HasSubstr(name)));
    }
}

TEST_F(Fallbacks, CoreContextsHaveNoTwoSide) {
    auto egl = gl::create_egl_context();
    if (!egl) GTEST_SKIP() << egl.error().message;
    const auto backend =
        gl::create_backend(std::move(*egl), {.stencil_path = gl::StencilPath::TwoSide});
    ASSERT_FALSE(backend);
    EXPECT_EQ(backend.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(backend.error().message,
                AllOf(HasSubstr("GL_EXT_stencil_two_side"), HasSubstr("EGL")));
}

TEST_F(Fallbacks, PathsAreNamedInTheCaps) {
    EXPECT_EQ(must(make_device({})).caps().stencil_path, "separate");
    for (const auto& [path, name] : {std::pair(gl::StencilPath::TwoSide, "two-side"),
                                     std::pair(gl::StencilPath::Separate, "separate"),
                                     std::pair(gl::StencilPath::TwoPass, "two-pass")}) {
        EXPECT_EQ(must(make_device({.stencil_path = path})).caps().stencil_path, name);
    }
}

TEST_F(Fallbacks, SwitchedOffExtensionsTakeTheirFeatureAlong) {
    const gpu::Features all = must(make_device({})).caps().features;
    EXPECT_TRUE(all.sampled_stencil && all.unclipped_depth && all.timestamp_query &&
                all.occlusion_query && all.multisample_4);
    struct Row {
        const char* extension;
        bool gpu::Features::*feature;
    };
    for (const Row& row : {Row{"GL_ARB_stencil_texturing", &gpu::Features::sampled_stencil},
                           Row{"GL_ARB_depth_clamp", &gpu::Features::unclipped_depth},
                           Row{"GL_EXT_depth_bounds_test", &gpu::Features::depth_bounds},
                           Row{"GL_ARB_timer_query", &gpu::Features::timestamp_query},
                           Row{"GL_ARB_occlusion_query", &gpu::Features::occlusion_query},
                           Row{"GL_ARB_texture_multisample", &gpu::Features::multisample_4}}) {
        SCOPED_TRACE(row.extension);
        gpu::Device device = without(row.extension);
        EXPECT_FALSE(device.caps().features.*row.feature);
        // and nothing else
        gpu::Features rest = device.caps().features;
        rest.*row.feature = all.*row.feature;
        EXPECT_EQ(rest.sampled_stencil, all.sampled_stencil);
        EXPECT_EQ(rest.unclipped_depth, all.unclipped_depth);
        EXPECT_EQ(rest.depth_bounds, all.depth_bounds);
        EXPECT_EQ(rest.timestamp_query, all.timestamp_query);
        EXPECT_EQ(rest.occlusion_query, all.occlusion_query);
        EXPECT_EQ(rest.multisample_4, all.multisample_4);
        EXPECT_NO_THROW(draw_small_scene(device)) << "what needs none of it goes on working";
    }
}

TEST_F(Fallbacks, WithoutDebugExtensionNothingIsLabelled) {
    gpu::Device device = without("GL_KHR_debug");
    EXPECT_NO_THROW(draw_small_scene(device));
}

TEST_F(Fallbacks, BiasClampNeedsItsExtension) {
    gpu::Device device = without("GL_ARB_polygon_offset_clamp");
    EXPECT_NO_THROW(draw_small_scene(device));
    const auto shader = must(device.create_shader(
        {.label = "clamped",
         .stage = gpu::ShaderStage::Vertex,
         .source = {.spirv = {}, .glsl = "#version 430\nvoid main() { gl_Position = vec4(0); }"}}));
    const auto pipeline = device.create_render_pipeline(
        {.label = "clamped bias",
         .vertex = shader,
         .depth_stencil = gpu::DepthStencilState{.format = gpu::Format::Depth32Float,
                                                 .depth_compare = gpu::Compare::Greater,
                                                 .depth_bias = 1,
                                                 .depth_bias_clamp = 0.5F}});
    ASSERT_FALSE(pipeline);
    EXPECT_EQ(pipeline.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(pipeline.error().message,
                AllOf(HasSubstr("\"clamped bias\""), HasSubstr("GL_ARB_polygon_offset_clamp")));
}

TEST_F(Fallbacks, AMissingFunctionIsNamed) {
    for (const char* name : {"glGetString", "glTexStorage2D", "glClipControl"}) {
        ObjectCounts counts;
        const auto backend = gl::create_backend(
            make_counting_context(must(gl::create_osmesa_context()), counts, name));
        ASSERT_FALSE(backend);
        EXPECT_EQ(backend.error().code, ErrorCode::Unsupported);
        EXPECT_THAT(backend.error().message, HasSubstr(name));
    }
}

TEST_F(Fallbacks, TwoPassRefusesWhatItCannotDraw) {
    gpu::Device device = must(make_device({.stencil_path = gl::StencilPath::TwoPass}));
    const auto vertex = must(device.create_shader(
        {.label = "v",
         .stage = gpu::ShaderStage::Vertex,
         .source = {.spirv = {}, .glsl = "#version 430\nvoid main() { gl_Position = vec4(0); }"}}));
    const auto fragment = must(
        device.create_shader({.label = "f",
                              .stage = gpu::ShaderStage::Fragment,
                              .source = {.spirv = {},
                                         .glsl = "#version 430\nlayout(location = 0) out vec4 c;\n"
                                                 "void main() { c = vec4(1); }"}}));
    const gpu::RenderPipelineDesc legal{
        .label = "volume",
        .vertex = vertex,
        .fragment = fragment,
        .depth_stencil =
            gpu::DepthStencilState{
                .format = gpu::Format::Depth32FloatStencil8,
                .depth_compare = gpu::Compare::Greater,
                .stencil_front = {.depth_fail_op = gpu::StencilOp::DecrementWrap},
                .stencil_back = {.depth_fail_op = gpu::StencilOp::IncrementWrap}},
        .targets = {{.format = gpu::Format::Rgba8Unorm, .write_mask = gpu::ColorWrite::None}}};
    EXPECT_TRUE(device.create_render_pipeline(legal));

    const auto expect_refused = [&](const gpu::RenderPipelineDesc& desc, const char* reason) {
        const auto pipeline = device.create_render_pipeline(desc);
        ASSERT_FALSE(pipeline) << reason;
        EXPECT_EQ(pipeline.error().code, ErrorCode::Unsupported);
        EXPECT_THAT(pipeline.error().message,
                    AllOf(HasSubstr("\"volume\""), HasSubstr("two-pass"), HasSubstr(reason)));
    };
    gpu::RenderPipelineDesc desc = legal;
    desc.targets[0].write_mask = gpu::ColorWrite::Red;
    expect_refused(desc, "writes colour");
    desc = legal;
    desc.depth_stencil->depth_write_enabled = true;
    expect_refused(desc, "writes depth");
    desc = legal;
    desc.primitive.cull_mode = gpu::CullMode::Back;
    expect_refused(desc, "culls faces");
    desc = legal;
    desc.depth_stencil->stencil_back.depth_fail_op = gpu::StencilOp::IncrementClamp;
    expect_refused(desc, "order of the triangles");
    desc = legal;
    desc.depth_stencil->stencil_back.compare = gpu::Compare::Equal;
    expect_refused(desc, "order of the triangles");
    // a test on bits that are not written has no order
    desc.depth_stencil->stencil_read_mask = 0x80;
    desc.depth_stencil->stencil_write_mask = 0x7F;
    EXPECT_TRUE(device.create_render_pipeline(desc));
    // the same state on both faces needs no second pass
    desc = legal;
    desc.depth_stencil->stencil_back = desc.depth_stencil->stencil_front;
    desc.depth_stencil->depth_write_enabled = true;
    desc.targets[0].write_mask = gpu::ColorWrite::All;
    EXPECT_TRUE(device.create_render_pipeline(desc));
}

}  // namespace
}  // namespace gnomon::gl_tests
