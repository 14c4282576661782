// SPDX-License-Identifier: MIT
//
// A guest within a render pass that the host has begun, of either kind: its draws go between the
// host's, the mask is the truth, and the validation layer has nothing to say.
#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

#include <gnomon/shadow_pass/light_masks.hpp>
#include <gnomon_shaders/guest.hpp>

#include "tests/guest/masks.hpp"
#include "tests/guest/vk_host.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {
namespace {

using testing::HasSubstr;

constexpr auto floats = gpu::Format::Depth32FloatStencil8;

gpu::TextureDesc pass_desc(std::uint32_t samples = 1) {
    return {.label = "pass",
            .width = row_width,
            .height = row_height,
            .format = floats,
            .usage = gpu::TextureUsage::RenderAttachment,
            .sample_count = samples};
}

// An adopted device with a guest in the host's render pass.
struct GuestInPass {
    vk::AdoptedDevice adopted;
    gpu::Device device;
    gpu::Texture target;
    shadow_pass::GuestPassDesc desc;
    shadows::HostView view;

    // What `record` submits goes into the host's commands.
    template <class Record>
    void in(VkCommandBuffer commands, Record record) const {
        adopted.commands->command_buffer = commands;
        record();
        adopted.commands->command_buffer = nullptr;
    }
};

GuestInPass invite(VkHost& host, const VkHostWay& way, const std::string& row) {
    auto adopted = must(vk::adopt_device(host.device()));
    gpu::Device device(std::move(adopted.backend));
    auto target = must(device.import_texture(pass_desc(way.samples), host.render_pass()));
    const shadow_pass::GuestPassDesc desc{.target = target,
                                          .size = {row_width, row_height},
                                          .format = floats,
                                          .sample_count = way.samples,
                                          .conventions = host.conventions()};
    const VkHost::Camera camera = host.camera_of(setting_of(row));
    const auto view = must(
        shadows::view_of_host(camera.view_from_world, camera.clip_from_view, host.conventions()));
    return {std::move(adopted), std::move(device), std::move(target), desc, view};
}

struct PassCase {
    VkHostWay way;
    std::string row;
    MaskOptions options = {};
};

void PrintTo(const PassCase& c, std::ostream* out) { *out << c.way.name << " " << c.row; }

class InHostPass : public testing::TestWithParam<PassCase> {};

TEST_P(InHostPass, the_mask_is_the_truth) {
    const PassCase& c = GetParam();
    auto made = VkHost::create(c.way);
    if (!made) GTEST_SKIP() << made.error().message;
    VkHost& host = **made;
    GuestInPass guest = invite(host, c.way, c.row);
    auto pass = must(shadow_pass::GuestPass::create(guest.device, guest.desc));
    std::vector<std::vector<std::uint8_t>> masks;
    // Twice, so that buffers are written again and freed while the host's commands have used them.
    for (const MaskOptions& options : {MaskOptions{}, c.options}) {
        masks.clear();
        const shadows::DrawList list = list_of(c.row, options, guest.view.view);
        must(pass.prepare(list, guest.view));
        for (std::size_t light = 0; light < list.lights.size(); ++light) {
            host.draw(setting_of(c.row), [&](VkCommandBuffer commands) {
                // Whatever was counted before in the pass is cleared away.
                guest.in(commands, [&] {
                    must(pass.count((light + 1) % list.lights.size()));
                    must(pass.count(light));
                });
            });
            masks.push_back(host.stencil());
        }
    }
    expect_true(c.row, c.options, masks);
    EXPECT_THAT(host.messages, testing::IsEmpty());
}

std::vector<PassCase> cases() {
    const std::string still = "still_life_three_lights";
    const std::string inside = "eye_inside_a_volume";
    const MaskOptions depth_fail{.technique = shadows::Technique::DepthFail};
    const MaskOptions quads{.silhouette = "gpu_quads"};
    const VkHostWay classic{.name = "classic", .in_pass = InPass::Classic};
    const VkHostWay classic_finite{
        .name = "classic_finite", .reversed = false, .finite = true, .in_pass = InPass::Classic};
    const VkHostWay dynamic{.name = "dynamic", .in_pass = InPass::Dynamic};
    const VkHostWay dynamic_forward{
        .name = "dynamic_forward", .reversed = false, .in_pass = InPass::Dynamic};
    return {{classic, still, quads},
            {classic_finite, inside, depth_fail},
            {dynamic, inside, quads},
            {dynamic_forward, still, depth_fail}};
}

INSTANTIATE_TEST_SUITE_P(Ways, InHostPass, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.way.name; });

TEST(InHostPassOfFourSamples, the_mask_is_the_truth) {
    const std::string row = "hidden_caster";
    const VkHostWay way{.name = "four", .in_pass = InPass::Dynamic, .samples = 4};
    auto made = VkHost::create(way);
    if (!made) GTEST_SKIP() << made.error().message;
    VkHost& host = **made;
    GuestInPass guest = invite(host, way, row);
    auto pass = must(shadow_pass::GuestPass::create(guest.device, guest.desc));
    const shadows::DrawList list = list_of(row, {}, guest.view.view);
    must(pass.prepare(list, guest.view));
    std::vector<std::vector<std::vector<std::uint8_t>>> stencils;
    for (std::size_t light = 0; light < list.lights.size(); ++light) {
        host.draw(setting_of(row), [&](VkCommandBuffer commands) {
            guest.in(commands, [&] { must(pass.count(light)); });
        });
        stencils.emplace_back();
        for (std::uint32_t s = 0; s < 4; ++s) stencils.back().push_back(host.stencil_sample(s));
    }
    expect_true_samples(row, stencils, false);
    EXPECT_THAT(host.messages, testing::IsEmpty());
}

// However many textures were imported for it, a kind of pass has its pipelines once.
TEST(InHostPassPipelines, are_made_once_for_passes_that_are_alike) {
    const VkHostWay way{.name = "host", .in_pass = InPass::Classic};
    auto made = VkHost::create(way);
    if (!made) GTEST_SKIP() << made.error().message;
    VkHost& host = **made;
    const std::string row = "eye_inside_a_volume";
    GuestInPass guest = invite(host, way, row);
    const auto made_for = [&](const shadow_pass::GuestPassDesc& desc) {
        const std::size_t before = VkHost::pipelines();
        const auto pass = must(shadow_pass::GuestPass::create(guest.device, desc));
        return VkHost::pipelines() - before;
    };
    const std::size_t alone = made_for(guest.desc);
    EXPECT_GT(alone, 0U);
    std::vector<gpu::Texture> alike;
    for (int i = 0; i < 3; ++i) {
        alike.push_back(must(guest.device.import_texture(pass_desc(), host.render_pass())));
    }
    EXPECT_EQ(made_for(guest.desc), alone);
    // They serve each of them, also after the first was let go.
    shadow_pass::GuestPassDesc desc = guest.desc;
    desc.target = alike.back();
    auto pass = must(shadow_pass::GuestPass::create(guest.device, desc));
    guest.target.reset();
    alike.erase(alike.begin());
    const shadows::DrawList list = list_of(row, {}, guest.view.view);
    must(pass.prepare(list, guest.view));
    host.draw(setting_of(row),
              [&](VkCommandBuffer commands) { guest.in(commands, [&] { must(pass.count(0)); }); });
    EXPECT_THAT(host.stencil(), testing::Contains(testing::Ne(0)));
    EXPECT_THAT(host.messages, testing::IsEmpty());
}

TEST(InHostPassRefusals, what_cannot_work_is_refused) {
    const VkHostWay way{.name = "host", .in_pass = InPass::Classic};
    auto made = VkHost::create(way);
    if (!made) GTEST_SKIP() << made.error().message;
    VkHost& host = **made;
    const std::string row = "eye_inside_a_volume";
    GuestInPass guest = invite(host, way, row);
    const auto refusal = [&](const gpu::TextureDesc& desc, const vk::HostRenderPass& pass) {
        const auto imported = guest.device.import_texture(desc, pass);
        return imported ? std::string("imported") : imported.error().message;
    };
    EXPECT_EQ(refusal(pass_desc(), host.render_pass()), "imported");
    EXPECT_THAT(refusal(pass_desc(), {.color_formats = {VK_FORMAT_B8G8R8A8_UNORM}}),
                HasSubstr("begun by vkCmdBeginRendering(), but HostDevice::enabled_features lacks "
                          "\"dynamicRendering\""));
    gpu::TextureDesc desc = pass_desc();
    desc.format = gpu::Format::R32Uint;
    EXPECT_THAT(refusal(desc, host.render_pass()), HasSubstr("with a depth-stencil format"));
    vk::HostRenderPass many = host.render_pass();
    many.color_formats.resize(100);
    EXPECT_THAT(refusal(pass_desc(), many), HasSubstr("has 100 colour attachments, but"));

    // Outside of the host's pass there is nothing to draw into.
    auto pass = must(shadow_pass::GuestPass::create(guest.device, guest.desc));
    const shadows::DrawList list = list_of(row, {}, guest.view.view);
    must(pass.prepare(list, guest.view));
    EXPECT_THAT(
        pass.count(0).error().message,
        HasSubstr("set HostCommands::command_buffer to the one in which the host has begun"));

    // Masks have a pass of their own.
    const std::size_t image = host.make_mask(VK_FORMAT_R32_UINT);
    desc = pass_desc();
    desc.format = gpu::Format::R32Uint;
    const auto mask = must(guest.device.import_texture(desc, host.mask(image)));
    const auto masks =
        shadow_pass::LightMasks::create(guest.device, {.host = guest.desc, .masks = {mask}});
    ASSERT_FALSE(masks);
    EXPECT_EQ(masks.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(masks.error().message,
                HasSubstr("takes no colours of gnomon's beside it, such as light masks: import the "
                          "depth and stencil as a vk::HostImage"));

    // A pipeline that knew nothing of the pass.
    const auto vertex =
        must(guest.device.create_shader({.label = "early",
                                         .stage = gpu::ShaderStage::Vertex,
                                         .source = guest::shaders::full_screen_vert}));
    guest.target.reset();
    const auto early = must(guest.device.create_render_pipeline(
        {.label = "early",
         .vertex = vertex,
         .depth_stencil =
             gpu::DepthStencilState{.format = floats, .depth_compare = gpu::Compare::Always}}));
    const auto later = must(guest.device.import_texture(pass_desc(), host.render_pass()));
    auto encoder = guest.device.create_command_encoder("early");
    {
        auto drawing = encoder.begin_render_pass(
            {.label = "early", .depth_stencil = gpu::DepthStencilAttachment{.texture = later}});
        drawing.set_pipeline(early);
        drawing.draw(3);
    }
    const auto commands = must(encoder.finish());
    host.draw(setting_of(row), [&](VkCommandBuffer into) {
        guest.in(into, [&] {
            EXPECT_THAT(guest.device.submit(commands).error().message,
                        HasSubstr("was made before that was imported: import it first"));
        });
    });
    EXPECT_THAT(host.messages, testing::IsEmpty());
}

}  // namespace
}  // namespace gnomon::test
