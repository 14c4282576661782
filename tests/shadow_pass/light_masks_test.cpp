// SPDX-License-Identifier: MIT
//
// What light masks ask of a device, on one that draws nothing and on one that fails anywhere.
#include <gnomon/shadow_pass/light_masks.hpp>

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/gpu/fault_backend.hpp>
#include <gnomon/gpu/null_backend.hpp>

namespace gnomon::shadow_pass {
namespace {

constexpr shadows::HostConventions conventions{shadows::HostDepth::ZeroToOne, true};
constexpr TargetSize size{16, 8};

// Three lights over one caster.
class World {
public:
    World() : system_(*shadows::ShadowSystem::create()) {
        static const std::array<glm::vec3, 4> positions{
            {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        static const std::array<std::uint32_t, 12> indices{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
        mesh_ = *shadows::ShadowMesh::build(
            {.positions = reinterpret_cast<const std::byte*>(positions.data()),
             .vertex_count = positions.size(),
             .indices = indices});
        shadows::View view;
        view.view_from_world = shadows::look_at({0, 1, 6}, {0, 0, 0}, {0, 1, 0});
        view.clip_from_view = shadows::infinite_perspective(0.8, 2.0, 0.01);
        this->view = {view, view, conventions};
    }

    const shadows::DrawList& frame() {
        auto frame = system_.begin_frame();
        frame.caster({.key = 1, .mesh = mesh_});
        for (std::uint64_t l = 0; l < 3; ++l) {
            frame.light({.key = l, .position_world = {2.0 - static_cast<double>(l), 4, x, 1}});
        }
        return std::move(frame).finish(view.view);
    }

    shadows::HostView view;
    double x = 1.0;

private:
    std::shared_ptr<const shadows::ShadowMesh> mesh_;
    shadows::ShadowSystem system_;
};

Result<gpu::Texture> texture(gpu::Device& device, gpu::Format format, std::uint32_t samples = 1) {
    return device.create_texture({.label = "texture",
                                  .width = size.width,
                                  .height = size.height,
                                  .format = format,
                                  .usage = gpu::TextureUsage::RenderAttachment,
                                  .sample_count = samples});
}

LightMasksDesc describe(gpu::TextureId depth, std::vector<gpu::TextureId> masks,
                        std::uint32_t samples = 1) {
    return {.host = {.target = depth,
                     .size = size,
                     .format = gpu::Format::Depth32FloatStencil8,
                     .sample_count = samples,
                     .conventions = conventions},
            .masks = std::move(masks)};
}

TEST(LightMasks, of_bits_are_two_render_passes_whatever_the_lights) {
    gpu::Device device(gpu::create_null_backend());
    const auto depth = texture(device, gpu::Format::Depth32FloatStencil8);
    const auto mask = texture(device, gpu::Format::R32Uint);
    auto masks = LightMasks::create(device, describe(*depth, {*mask}));
    ASSERT_TRUE(masks) << masks.error().message;
    World world;
    for (int frame = 0; frame < 3; ++frame) {
        // The second is the first again; in the third the lights have moved.
        if (frame == 2) world.x = 1.5;
        ASSERT_TRUE(masks->prepare(world.frame(), world.view));
        EXPECT_EQ(masks->stats().uploaded_bytes == 0, frame == 1);
        const gpu::DeviceCounters before = device.counters();
        ASSERT_TRUE(masks->resolve());
        const gpu::DeviceCounters after = device.counters();
        EXPECT_EQ(after.submissions - before.submissions, 1U);
        EXPECT_EQ(after.render_passes - before.render_passes, 2U);
        // One triangle a light, one that packs.
        EXPECT_EQ(after.draw_calls - before.draw_calls, masks->stats().draw_calls + 3 + 1);
        EXPECT_EQ(after.uploaded_bytes, before.uploaded_bytes);
    }
}

TEST(LightMasks, of_bytes_are_a_render_pass_each) {
    gpu::Device device(gpu::create_null_backend());
    const auto depth = texture(device, gpu::Format::Depth32FloatStencil8, 4);
    std::vector<gpu::Texture> owned;
    std::vector<gpu::TextureId> ids;
    for (int i = 0; i < 4; ++i) {
        owned.push_back(*texture(device, gpu::Format::R8Unorm));
        ids.push_back(owned.back());
    }
    auto masks = LightMasks::create(device, describe(*depth, ids, 4));
    ASSERT_TRUE(masks) << masks.error().message;
    World world;
    ASSERT_TRUE(masks->prepare(world.frame(), world.view));
    const gpu::DeviceCounters before = device.counters();
    ASSERT_TRUE(masks->resolve());
    const gpu::DeviceCounters after = device.counters();
    EXPECT_EQ(after.submissions - before.submissions, 1U);
    EXPECT_EQ(after.render_passes - before.render_passes, 4U);
    EXPECT_EQ(after.draw_calls - before.draw_calls, masks->stats().draw_calls + 3);
}

// Every fallible call of the device fails once: each failure comes back as a Result and nothing is
// left behind.
TEST(LightMasks, survive_a_device_that_fails_anywhere) {
    for (const bool bits : {true, false}) {
        bool succeeded = false;
        for (std::uint64_t fail_at = 1; !succeeded && fail_at < 200; ++fail_at) {
            gpu::FaultPlan plan{.fail_at = fail_at};
            gpu::Device device(gpu::create_fault_backend(gpu::create_null_backend(), plan));
            {
                const std::uint32_t samples = bits ? 1 : 4;
                const auto depth = texture(device, gpu::Format::Depth32FloatStencil8, samples);
                const auto mask =
                    texture(device, bits ? gpu::Format::R32Uint : gpu::Format::R8Unorm);
                if (!depth || !mask) continue;
                auto masks = LightMasks::create(device, describe(*depth, {*mask}, samples));
                if (masks) {
                    World world;
                    Status status = masks->prepare(world.frame(), world.view);
                    if (status) status = masks->resolve(0, 1);
                    succeeded = status.has_value();
                    // A failed frame does no harm to the next one.
                    if (!status) {
                        EXPECT_TRUE(masks->prepare(world.frame(), world.view));
                        EXPECT_TRUE(masks->resolve(0, 1));
                    }
                }
                EXPECT_EQ(succeeded, plan.calls < fail_at);
            }
            EXPECT_EQ(device.counters().objects_alive, 0U) << "failing at call " << fail_at;
        }
        EXPECT_TRUE(succeeded);
    }
}

}  // namespace
}  // namespace gnomon::shadow_pass
