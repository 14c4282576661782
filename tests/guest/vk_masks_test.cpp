// SPDX-License-Identifier: MIT
//
// A guest in Vulkan: on the host's device and queue, in its image, by its matrices, in submissions
// of its own or in the host's command buffer, the mask is the truth and the validation layer has
// nothing to say.
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/shadow_pass/light_masks.hpp>

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
class MasksInVk : public testing::TestWithParam<VkGuestCase> {};

gpu::TextureDesc image_desc(gpu::Format format = gpu::Format::Depth32FloatStencil8,
                            std::uint32_t samples = 1) {
    return {.label = "host",
            .width = row_width,
            .height = row_height,
            .format = format,
            .usage = gpu::TextureUsage::RenderAttachment,
            .sample_count = samples};
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

// Bits in an image of the host's, which is in no layout the first time.
TEST_P(MasksInVk, bits_in_the_hosts_image_are_the_truth) {
    const VkGuestCase& c = GetParam();
    auto made = VkHost::create(c.way);
    if (!made) GTEST_SKIP() << made.error().message;
    VkHost& host = **made;
    const auto stencils = masks_of(c, host);
    auto adopted = must(vk::adopt_device(host.device()));
    gpu::Device device(std::move(adopted.backend));
    const auto target = must(device.import_texture(image_desc(), host.image()));
    const std::size_t image = host.make_mask(VK_FORMAT_R32_UINT);
    const auto mask =
        must(device.import_texture(image_desc(gpu::Format::R32Uint), host.mask(image)));
    auto masks = must(shadow_pass::LightMasks::create(
        device, {.host = {.target = target,
                          .size = {row_width, row_height},
                          .format = gpu::Format::Depth32FloatStencil8,
                          .conventions = host.conventions()},
                 .masks = {mask}}));
    const VkHost::Camera camera = host.camera_of(setting_of(c.row));
    const auto view = must(
        shadows::view_of_host(camera.view_from_world, camera.clip_from_view, host.conventions()));
    const shadows::DrawList list = list_of(c.row, c.options, view.view);
    for (int twice = 0; twice < 2; ++twice) {
        host.draw(setting_of(c.row));
        must(masks.prepare(list, view));
        if (c.way.record_into_its_commands) adopted.commands->command_buffer = host.begin();
        must(masks.resolve());
        if (c.way.record_into_its_commands) host.end();
        adopted.commands->command_buffer = nullptr;
        const auto bits = host.read_bits(image);
        expect_true_bits(c.row, bits);
        EXPECT_EQ(wrong_bits(bits, stencils), 0U);
    }
    EXPECT_THAT(host.stencil(), testing::Each(0));
    EXPECT_THAT(host.messages, testing::IsEmpty());
}

std::vector<VkGuestCase> mask_cases() {
    return {{{.name = "plain"}, "still_life_three_lights"},
            {{.name = "recorded",
              .reversed = false,
              .record_into_its_commands = true,
              .layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL},
             "eye_inside_a_volume"}};
}

INSTANTIATE_TEST_SUITE_P(Ways, MasksInVk, testing::ValuesIn(mask_cases()),
                         [](const auto& info) { return info.param.way.name; });

// Sample by sample: the stencil, the bits of a mask with four samples, and shares in one of one.
TEST(FourSamplesInVk, each_is_the_truth_where_it_lies) {
    const std::string row = "hidden_caster";
    auto made = VkHost::create({.name = "four", .samples = 4});
    if (!made) GTEST_SKIP() << made.error().message;
    VkHost& host = **made;
    gpu::Device device(must(vk::adopt_device(host.device())).backend);
    constexpr auto floats = gpu::Format::Depth32FloatStencil8;
    const auto target = must(device.import_texture(image_desc(floats, 4), host.image()));
    const shadow_pass::GuestPassDesc desc{.target = target,
                                          .size = {row_width, row_height},
                                          .format = floats,
                                          .sample_count = 4,
                                          .conventions = host.conventions()};
    auto guest = must(shadow_pass::GuestPass::create(device, desc));
    const VkHost::Camera camera = host.camera_of(setting_of(row));
    const auto view = must(
        shadows::view_of_host(camera.view_from_world, camera.clip_from_view, host.conventions()));
    const shadows::DrawList list = list_of(row, {}, view.view);
    host.draw(setting_of(row));
    must(guest.prepare(list, view));
    std::vector<std::vector<std::vector<std::uint8_t>>> stencils;
    for (std::size_t light = 0; light < list.lights.size(); ++light) {
        must(guest.count(light));
        stencils.emplace_back();
        for (std::uint32_t s = 0; s < 4; ++s) stencils.back().push_back(host.stencil_sample(s));
    }
    expect_true_samples(row, stencils, false);

    const std::size_t image = host.make_mask(VK_FORMAT_R32_UINT, 4);
    const auto mask =
        must(device.import_texture(image_desc(gpu::Format::R32Uint, 4), host.mask(image)));
    auto masks = must(shadow_pass::LightMasks::create(device, {.host = desc, .masks = {mask}}));
    must(masks.prepare(list, view));
    must(masks.resolve());
    for (std::uint32_t s = 0; s < 4; ++s) {
        std::vector<std::vector<std::uint8_t>> of_sample;
        for (const auto& of_light : stencils) of_sample.push_back(of_light[s]);
        EXPECT_EQ(wrong_bits(host.read_bits(image, s), of_sample), 0U);
    }

    std::vector<gpu::Texture> bytes;
    std::vector<gpu::TextureId> ids;
    for (std::size_t light = 0; light < stencils.size(); ++light) {
        const std::size_t number = host.make_mask(VK_FORMAT_R8_UNORM);
        bytes.push_back(
            must(device.import_texture(image_desc(gpu::Format::R8Unorm), host.mask(number))));
        ids.push_back(bytes.back());
    }
    auto shares = must(shadow_pass::LightMasks::create(device, {.host = desc, .masks = ids}));
    must(shares.prepare(list, view));
    must(shares.resolve());
    for (std::size_t light = 0; light < stencils.size(); ++light) {
        const auto said = host.read_bytes(1 + light);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < said.size(); ++i) {
            int in_shadow = 0;
            for (std::size_t s = 0; s < 4; ++s) in_shadow += stencils[light][s][i] != 0 ? 1 : 0;
            wrong += std::abs(said[i] - 63.75 * in_shadow) > 1.0 ? 1 : 0;
        }
        EXPECT_EQ(wrong, 0U);
    }
    EXPECT_THAT(host.messages, testing::IsEmpty());
}

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
    desc = image_desc(gpu::Format::R32Uint);
    image.layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    EXPECT_THAT(refusal(desc, image), HasSubstr("which is not one of colour"));
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
