// SPDX-License-Identifier: MIT
//
// A guest in Vulkan: on the host's device and queue, in its image, by its matrices, in submissions
// of its own or in the host's command buffer, the mask is the truth and the validation layer has
// nothing to say.
#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/guest/masks.hpp"
#include "tests/guest/vk_host.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {
namespace {

using testing::HasSubstr;

struct VkGuestCase {
    VkHostWay way;
    std::string row;
    MaskOptions options = {};
};

void PrintTo(const VkGuestCase& c, std::ostream* out) { *out << c.way.name << " " << c.row; }

std::vector<VkGuestCase> cases() {
    const std::string still = "still_life_three_lights";
    const std::string inside = "eye_inside_a_volume";
    const MaskOptions depth_fail{.technique = shadows::Technique::DepthFail};
    const VkHostWay plain{.name = "plain"};
    const VkHostWay forward{.name = "forward",
                            .reversed = false,
                            .record_into_its_commands = true,
                            .layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL};
    const VkHostWay finite{
        .name = "finite", .reversed = false, .finite = true, .layout = VK_IMAGE_LAYOUT_GENERAL};
    const VkHostWay recorded{.name = "recorded", .record_into_its_commands = true};
    return {{plain, still},     {plain, inside, depth_fail},
            {forward, still},   {finite, inside, depth_fail},
            {recorded, inside}, {recorded, still, depth_fail}};
}

class GuestInVk : public testing::TestWithParam<VkGuestCase> {};

gpu::TextureDesc image_desc() {
    return {.label = "host",
            .width = row_width,
            .height = row_height,
            .format = gpu::Format::Depth32FloatStencil8,
            .usage = gpu::TextureUsage::RenderAttachment};
}

std::vector<std::vector<std::uint8_t>> masks_of(const VkGuestCase& c, VkHost& host) {
    auto adopted = must(vk::adopt_device(host.device()));
    gpu::Device device(std::move(adopted.backend));
    const auto target = must(device.import_texture(image_desc(), host.image()));
    auto guest =
        must(shadow_pass::GuestPass::create(device, {.target = target,
                                                     .size = {row_width, row_height},
                                                     .format = gpu::Format::Depth32FloatStencil8,
                                                     .conventions = host.conventions()}));
    const VkHost::Camera camera = host.camera_of(setting_of(c.row));
    const auto view = must(
        shadows::view_of_host(camera.view_from_world, camera.clip_from_view, host.conventions()));
    std::vector<std::vector<std::uint8_t>> masks;
    // Twice, so that buffers are written again and freed while the host's commands have used them.
    for (const MaskOptions& options : {MaskOptions{}, c.options}) {
        masks.clear();
        host.draw(setting_of(c.row));
        const shadows::DrawList list = list_of(c.row, options, view.view);
        must(guest.prepare(list, view));
        for (std::size_t light = 0; light < list.lights.size(); ++light) {
            if (c.way.record_into_its_commands) adopted.commands->command_buffer = host.begin();
            must(guest.count(light));
            if (c.way.record_into_its_commands) host.end();
            adopted.commands->command_buffer = nullptr;
            masks.push_back(host.stencil());
        }
    }
    return masks;
}

TEST_P(GuestInVk, the_mask_in_its_image_is_the_truth) {
    const VkGuestCase& c = GetParam();
    auto host = VkHost::create(c.way);
    if (!host) GTEST_SKIP() << host.error().message;
    expect_true(c.row, c.options, masks_of(c, **host));
    EXPECT_THAT((*host)->messages, testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Ways, GuestInVk, testing::ValuesIn(cases()), [](const auto& info) {
    return info.param.way.name + "_" + info.param.row +
           (info.param.options.technique ? "_depth_fail" : "");
});

// Nor a stencil: what a pass would discard of the host's is stored.
TEST(VkGuest, discards_nothing_of_the_hosts) {
    auto made = VkHost::create({.name = "host"});
    if (!made) GTEST_SKIP() << made.error().message;
    VkHost& host = **made;
    gpu::Device device(must(vk::adopt_device(host.device())).backend);
    const auto target = must(device.import_texture(image_desc(), host.image()));
    host.draw(setting_of("still_life_three_lights"));
    for (int twice = 0; twice < 2; ++twice) {
        auto encoder = device.create_command_encoder("discards");
        {
            const auto pass =
                encoder.begin_render_pass({.label = "discards",
                                           .depth_stencil = gpu::DepthStencilAttachment{
                                               .texture = target,
                                               .depth_store_op = gpu::StoreOp::Discard,
                                               .stencil_store_op = gpu::StoreOp::Discard}});
        }
        must(device.submit(must(encoder.finish())));
    }
    EXPECT_THAT(host.stencil(), testing::Each(0x55));
    EXPECT_THAT(host.messages, testing::IsEmpty());
}

TEST(VkGuestRefusals, what_cannot_work_is_refused) {
    auto made = VkHost::create({.name = "host"});
    if (!made) GTEST_SKIP() << made.error().message;
    VkHost& host = **made;
    vk::HostDevice wrong = host.device();
    wrong.queue = nullptr;
    EXPECT_THAT(vk::adopt_device(wrong).error().message, HasSubstr("HostDevice::queue is null"));
    wrong = host.device();
    wrong.queue_family = 1234;
    EXPECT_THAT(vk::adopt_device(wrong).error().message, HasSubstr("queue family 1234"));

    gpu::Device device(must(vk::adopt_device(host.device())).backend);
    const auto refusal = [&](const gpu::TextureDesc& desc, const gpu::NativeTexture& native) {
        const auto imported = device.import_texture(desc, native);
        return imported ? std::string("imported") : imported.error().message;
    };
    EXPECT_EQ(refusal(image_desc(), host.image()), "imported");
    EXPECT_THAT(refusal(image_desc(), 17), HasSubstr("vk::HostImage"));
    EXPECT_THAT(refusal(image_desc(), vk::HostImage{0, 3}), HasSubstr("VK_NULL_HANDLE"));
    vk::HostImage image = host.image();
    image.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    EXPECT_THAT(refusal(image_desc(), image), HasSubstr("layout in which it has no contents"));
    gpu::TextureDesc desc = image_desc();
    desc.usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc;
    EXPECT_THAT(refusal(desc, host.image()), HasSubstr("usage RenderAttachment and no other"));
    desc = image_desc();
    desc.mip_level_count = 2;
    EXPECT_THAT(refusal(desc, host.image()), HasSubstr("can only have 1 mip level, not 2"));
    image.layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    EXPECT_THAT(refusal(image_desc(), image), HasSubstr("depth and stencil must be in one layout"));
    const auto target = must(device.import_texture(image_desc(), host.image()));
    const auto pass = shadow_pass::GuestPass::create(
        device, {.target = target,
                 .size = {row_width, row_height},
                 .format = gpu::Format::Depth32FloatStencil8,
                 .conventions = {shadows::HostDepth::MinusOneToOne, false}});
    ASSERT_FALSE(pass);
    EXPECT_THAT(pass.error().message, HasSubstr("set it to ZeroToOne"));
    EXPECT_THAT(host.messages, testing::IsEmpty());
}

}  // namespace
}  // namespace gnomon::test
