// SPDX-License-Identifier: MIT
//
// Every GL object that is made is deleted: by its owner, else by the backend.
#include <gnomon/gl/backend.hpp>

#include "tests/gl/counting_context.hpp"
#include "tests/gl/small_scene.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::gl_tests {
namespace {

using test::must;

class Lifetime : public testing::Test {
protected:
    void SetUp() override {
        auto context = gl::create_osmesa_context();
        if (context) return;
        ASSERT_FALSE(test::is_required("gl_osmesa_separate")) << context.error().message;
        GTEST_SKIP() << context.error().message;
    }
    gpu::Device make_device() {
        return gpu::Device(must(gl::create_backend(
            make_counting_context(must(gl::create_osmesa_context()), counts_), {.debug = true})));
    }
    /// One of everything, drawn with.
    static void use_everything(gpu::Device& device) {
        const SmallScene scene = draw_small_scene(device);
        const auto buffer = must(
            device.create_buffer({.label = "b",
                                  .size = 256,
                                  .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst}));
        const auto sampler = must(device.create_sampler({.label = "s"}));
        const auto queries = must(
            device.create_query_set({.label = "q", .type = gpu::QueryType::Occlusion, .count = 3}));
        static_cast<void>(must(device.read_texture(scene.color)));
        EXPECT_FALSE(device.create_shader({.label = "broken",
                                           .stage = gpu::ShaderStage::Vertex,
                                           .source = {.spirv = {}, .glsl = "nonsense"}}));
    }
    ObjectCounts counts_;
};

TEST_F(Lifetime, FiftyCyclesLeaveNothingBehind) {
    gpu::Device device = make_device();
    use_everything(device);
    const auto alive_before = counts_.alive;
    const auto made_before = counts_.made;
    for (int cycle = 0; cycle < 50; ++cycle) use_everything(device);
    EXPECT_EQ(counts_.alive, alive_before);
    for (const char* kind :
         {"Buffers", "Textures", "Samplers", "Framebuffers", "Queries", "Shaders", "Programs"}) {
        EXPECT_GE(counts_.made[kind], made_before.at(kind) + 50) << kind << " were not used";
    }
    EXPECT_EQ(counts_.alive["Textures"], 0);
    EXPECT_EQ(counts_.alive["Framebuffers"], 0);
    EXPECT_EQ(device.counters().objects_alive, 0U);
}

TEST_F(Lifetime, TheBackendFreesWhatItsOwnersKept) {
    {
        gpu::Texture kept;
        gpu::Buffer kept_buffer;
        {
            gpu::Device device = make_device();
            kept = draw_small_scene(device).color;
            kept_buffer = must(device.create_buffer(
                {.label = "kept", .size = 16, .usage = gpu::BufferUsage::CopyDst}));
            EXPECT_EQ(counts_.alive["Textures"], 1);
        }
        for (const auto& [kind, alive] : counts_.alive) EXPECT_EQ(alive, 0) << kind;
    }
}

TEST_F(Lifetime, FiftyDevicesComeAndGo) {
    for (int cycle = 0; cycle < 50; ++cycle) {
        gpu::Device device = make_device();
        draw_small_scene(device);
    }
    for (const auto& [kind, alive] : counts_.alive) EXPECT_EQ(alive, 0) << kind;
    EXPECT_GE(counts_.made["Programs"], 50);
}

}  // namespace
}  // namespace gnomon::gl_tests
