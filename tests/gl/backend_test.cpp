// SPDX-License-Identifier: MIT
//
// What the backend says when the driver refuses, and that it leaves a shared context tidy.
#include <gmock/gmock.h>
#include <gnomon/gl/backend.hpp>
#include <gnomon_shaders/gl_tests.hpp>

#include "tests/gl/small_scene.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::gl_tests {
namespace {

using test::must;
using testing::AllOf;
using testing::HasSubstr;

class GlBackend : public test::DeviceTest {};

TEST_P(GlBackend, ABadShaderIsOneSentenceWithTheLog) {
    log().expect("error");  // Mesa repeats the compiler's log as a debug message
    log().expect("syntax");
    const auto shader = device().create_shader(
        {.label = "broken",
         .stage = gpu::ShaderStage::Fragment,
         .source = {.spirv = {}, .glsl = "#version 430\nvoid main() { nonsense }\n"}});
    ASSERT_FALSE(shader);
    EXPECT_EQ(shader.error().code, ErrorCode::InvalidInput);
    EXPECT_THAT(shader.error().message,
                AllOf(HasSubstr("fragment shader of [Shader \"broken\"]"), HasSubstr("error")));
    EXPECT_NE(shader.error().message.back(), '\n');
}

TEST_P(GlBackend, ShadersThatDoNotFitAreNamed) {
    log().expect("link");
    const auto vertex = must(device().create_shader({.label = "writes vec3",
                                                     .stage = gpu::ShaderStage::Vertex,
                                                     .source = shaders::triangle_vert}));
    const auto fragment = must(device().create_shader({.label = "wants ivec4",
                                                       .stage = gpu::ShaderStage::Fragment,
                                                       .source = shaders::mismatch_frag}));
    const auto pipeline =
        device().create_render_pipeline({.label = "mismatched",
                                         .vertex = vertex,
                                         .fragment = fragment,
                                         .targets = {{.format = gpu::Format::Rgba8Unorm}}});
    if (pipeline) GTEST_SKIP() << "this driver links what does not fit";
    EXPECT_THAT(pipeline.error().message,
                AllOf(HasSubstr("\"writes vec3\""), HasSubstr("\"wants ivec4\""),
                      HasSubstr("\"mismatched\"")));
}

TEST_P(GlBackend, BindingsBeyondTheDriversUnitsAreRefused) {
    const auto layout = device().create_bind_group_layout(
        {.label = "far",
         .entries = {{.binding = 5000,
                      .visibility = gpu::ShaderStage::Fragment,
                      .type = gpu::BindingType::SampledTexture}}});
    ASSERT_FALSE(layout);
    EXPECT_EQ(layout.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(layout.error().message, AllOf(HasSubstr("\"far\""), HasSubstr("binding 5000")));
}

TEST_P(GlBackend, LimitsAreTheDriversOwn) {
    const gpu::Limits& limits = device().caps().limits;
    EXPECT_GE(limits.max_texture_dimension_2d, 16384U);  // OpenGL 4.3 requires these four
    EXPECT_GE(limits.max_color_attachments, 8U);
    EXPECT_GE(limits.max_vertex_attributes, 16U);
    EXPECT_GE(limits.max_uniform_buffer_binding_size, 16384U);
    EXPECT_LE(limits.min_uniform_buffer_offset_alignment, 256U);
    EXPECT_GE(limits.min_uniform_buffer_offset_alignment, 1U);
}

TEST_P(GlBackend, DeepDebugGroupsAndLongLabelsDoNoHarm) {
    const auto target =
        must(device().create_texture({.label = std::string(2000, 'x'),
                                      .width = 4,
                                      .height = 4,
                                      .format = gpu::Format::Rgba8Unorm,
                                      .usage = gpu::TextureUsage::RenderAttachment}));
    gpu::CommandEncoder encoder = device().create_command_encoder("deep");
    for (int i = 0; i < 200; ++i) encoder.push_debug_group(std::string(10000, 'g'));
    encoder.begin_render_pass({.color_attachments = {{.texture = target}}}).end();
    for (int i = 0; i < 200; ++i) encoder.pop_debug_group();
    must(device().submit(must(encoder.finish())));
}

TEST_P(GlBackend, AFreedTextureTakesItsFramebuffersAlong) {
    // GL hands the names out again: a stale framebuffer would show the old picture.
    for (int round = 0; round < 4; ++round) {
        const SmallScene scene = draw_small_scene(device());
        EXPECT_EQ(must(device().read_texture(scene.color))[0], std::byte{255});
    }
}

INSTANTIATE_TEST_SUITE_P(Devices, GlBackend, testing::ValuesIn([] {
                             auto cases = test::drawing_devices();
                             std::erase_if(cases, [](const test::DeviceCase& c) {
                                 return c.name.rfind("gl_", 0) != 0;
                             });
                             return cases;
                         }()),
                         test::device_case_name);

}  // namespace
}  // namespace gnomon::gl_tests
