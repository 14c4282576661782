// SPDX-License-Identifier: MIT
//
// A guest in command buffers of a Vulkan host's: what runs before all of one, and so cannot change
// in the midst of it; what is submitted besides; and frames that do not wait for one another.
#include <gmock/gmock.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/shadow_pass/light_masks.hpp>

#include "tests/guest/masks.hpp"
#include "tests/guest/vk_host.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {
namespace {

using shadow_pass::GuestPass;
using shadow_pass::LightMasks;
using testing::HasSubstr;

constexpr auto floats = gpu::Format::Depth32FloatStencil8;

gpu::TextureDesc host_desc(gpu::Format format, std::uint32_t samples = 1) {
    return {.label = "host",
            .width = row_width,
            .height = row_height,
            .format = format,
            .usage = gpu::TextureUsage::RenderAttachment,
            .sample_count = samples};
}

class VkCommands : public testing::Test {
protected:
    void make(const VkHostWay& way) {
        auto made = VkHost::create(way);
        if (!made) GTEST_SKIP() << made.error().message;
        host_ = std::move(*made);
        auto adopted = must(vk::adopt_device(host_->device()));
        device_.emplace(std::move(adopted.backend));
        commands_ = std::move(adopted.commands);
        target_ = must(device_->import_texture(host_desc(floats, way.samples), host_->image()));
        desc_ = {.target = target_,
                 .size = {row_width, row_height},
                 .format = floats,
                 .sample_count = way.samples,
                 .conventions = host_->conventions()};
    }
    void TearDown() override {
        if (!host_) return;
        EXPECT_THAT(host_->messages, testing::IsEmpty());
        target_.reset();
        device_.reset();
        EXPECT_THAT(host_->messages, testing::IsEmpty());
    }

    // The row's camera, moved to the right.
    [[nodiscard]] shadows::HostView view_from(float right_m) const {
        VkHost::Camera camera = host_->camera_of(setting_of(row_));
        camera.view_from_world[3][0] -= right_m;
        return must(shadows::view_of_host(camera.view_from_world, camera.clip_from_view,
                                          host_->conventions()));
    }
    [[nodiscard]] shadows::DrawList list_from(const shadows::HostView& view) const {
        return list_of(row_, {}, view.view);
    }
    // With a mask of its own each.
    [[nodiscard]] LightMasks make_masks(std::size_t& number) {
        number = host_->make_mask(VK_FORMAT_R32_UINT);
        textures_.push_back(
            must(device_->import_texture(host_desc(gpu::Format::R32Uint), host_->mask(number))));
        return must(LightMasks::create(*device_, {.host = desc_, .masks = {textures_.back()}}));
    }

    std::string row_ = "still_life_three_lights";
    std::unique_ptr<VkHost> host_;
    std::optional<gpu::Device> device_;
    std::shared_ptr<vk::HostCommands> commands_;
    gpu::Texture target_;
    std::vector<gpu::Texture> textures_;
    shadow_pass::GuestPassDesc desc_;
};

TEST_F(VkCommands, two_views_in_one_buffer_take_a_pass_each) {
    make({.name = "host"});
    if (!host_) return;
    const shadows::HostView left = view_from(0.0F);
    const shadows::HostView right = view_from(1.0F);
    const shadows::DrawList of_left = list_from(left);
    const shadows::DrawList of_right = list_from(right);
    std::size_t first = 0;
    std::size_t second = 0;
    LightMasks one = make_masks(first);
    LightMasks other = make_masks(second);
    host_->draw(setting_of(row_));

    // Each by itself, submitted at once.
    must(one.prepare(of_left, left));
    must(one.resolve());
    const auto left_bits = host_->read_bits(first);
    must(one.prepare(of_right, right));
    must(one.resolve());
    const auto right_bits = host_->read_bits(first);
    EXPECT_NE(left_bits, right_bits);

    // By one: the second view's matrices would be there for both.
    must(one.prepare(of_left, left));
    commands_->command_buffer = host_->begin();
    must(one.resolve());
    const Status refused = one.prepare(of_right, right);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::InvalidInput);
    EXPECT_THAT(refused.error().message,
                HasSubstr("would change what commands read that are in the host's command buffer "
                          "already, since writes run before all of that: submit it first and set "
                          "HostCommands::command_buffer to null or to another, or give each view"));
    EXPECT_FALSE(one.resolve());
    // By another in the same buffer.
    must(other.prepare(of_right, right));
    must(other.resolve());
    commands_->command_buffer = nullptr;
    host_->end();
    EXPECT_EQ(host_->read_bits(first), left_bits);
    EXPECT_EQ(host_->read_bits(second), right_bits);

    // Or by one, with a submission between.
    must(one.prepare(of_left, left));
    commands_->command_buffer = host_->begin();
    must(one.resolve());
    host_->end();
    commands_->command_buffer = nullptr;
    EXPECT_EQ(host_->read_bits(first), left_bits);
    // In what may have the same handle.
    commands_->command_buffer = host_->begin();
    must(one.prepare(of_right, right));
    must(one.resolve());
    host_->end();
    EXPECT_EQ(host_->read_bits(first), right_bits);
    commands_->command_buffer = host_->begin();
    must(one.prepare(of_left, left));
    must(one.resolve());
    commands_->command_buffer = nullptr;
    host_->end();
    EXPECT_EQ(host_->read_bits(first), left_bits);
}

// What is freed while the host records is there until it has submitted that.
TEST_F(VkCommands, what_a_buffer_reads_lives_until_it_is_submitted) {
    make({.name = "host"});
    if (!host_) return;
    const shadows::HostView view = view_from(0.0F);
    const shadows::DrawList list = list_from(view);
    std::size_t number = 0;
    host_->draw(setting_of(row_));
    commands_->command_buffer = host_->begin();
    {
        LightMasks masks = make_masks(number);
        must(masks.prepare(list, view));
        must(masks.resolve());
    }
    must(device_->wait_idle());
    host_->end();
    commands_->command_buffer = nullptr;
    must(device_->wait_idle());
    EXPECT_THAT(host_->read_bits(number), testing::Contains(testing::Ne(0U)));
}

TEST_F(VkCommands, nothing_is_submitted_for_what_waits_already) {
    make({.name = "host"});
    if (!host_) return;
    auto guest = must(GuestPass::create(*device_, desc_));
    const shadows::HostView view = view_from(0.0F);
    const shadows::DrawList list = list_from(view);
    ASSERT_GE(list.lights.size(), 2U);
    host_->draw(setting_of(row_));
    must(guest.prepare(list, view));
    host_->waits = false;  // so that what is freed has to wait
    // Something to free, as a frame has it that makes larger buffers.
    const auto free_one = [&] {
        static_cast<void>(must(device_->create_buffer(
            {.label = "freed", .size = 64, .usage = gpu::BufferUsage::Uniform})));
    };
    const auto frame = [&] {
        const std::size_t before = VkHost::submissions();
        commands_->command_buffer = host_->begin();
        for (int again = 0; again < 4; ++again) {
            must(guest.count(0));
            must(guest.count(1));
        }
        host_->end();
        commands_->command_buffer = nullptr;
        return VkHost::submissions() - before;
    };
    EXPECT_EQ(frame(), 1U) << "the uploads";
    EXPECT_EQ(frame(), 0U);
    free_one();
    EXPECT_EQ(frame(), 1U) << "whose fence tells that it may be freed";
    EXPECT_EQ(frame(), 0U);
    host_->wait();
}

// The second's uploads come while the first's commands may still run.
TEST_F(VkCommands, frames_do_not_wait_for_one_another) {
    make({.name = "host"});
    if (!host_) return;
    std::size_t number = 0;
    LightMasks masks = make_masks(number);
    const auto frame = [&](float right_m) {
        host_->draw(setting_of(row_));
        const shadows::HostView view = view_from(right_m);
        must(masks.prepare(list_from(view), view));
        commands_->command_buffer = host_->begin();
        must(masks.resolve());
        host_->end();
        commands_->command_buffer = nullptr;
    };
    frame(1.0F);
    const auto alone = host_->read_bits(number);
    host_->waits = false;
    for (const float right_m : {0.0F, 0.5F, 1.0F}) frame(right_m);
    host_->waits = true;
    EXPECT_EQ(host_->read_bits(number), alone);
}

// Without sampleRateShading there are four samples all the same, but for bits.
TEST_F(VkCommands, only_bits_of_samples_run_once_a_sample) {
    make({.name = "host", .samples = 4, .sample_shading = false});
    if (!host_) return;
    auto guest = must(GuestPass::create(*device_, desc_));
    const shadows::HostView view = view_from(0.0F);
    const shadows::DrawList list = list_from(view);
    host_->draw(setting_of(row_));
    must(guest.prepare(list, view));
    must(guest.count(0));
    EXPECT_FALSE(device_->caps().features.sample_shading);

    const auto import = [&](gpu::Format format, std::uint32_t samples, VkFormat vk_format) {
        return must(device_->import_texture(host_desc(format, samples),
                                            host_->mask(host_->make_mask(vk_format, samples))));
    };
    const auto bits = import(gpu::Format::R32Uint, 4, VK_FORMAT_R32_UINT);
    const auto refused = LightMasks::create(*device_, {.host = desc_, .masks = {bits}});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(refused.error().message,
                HasSubstr("Shader 'light bits' runs once a sample, but "
                          "HostDevice::enabled_features lacks \"sampleRateShading\": make the "
                          "device with that feature, and name it there"));
    const auto share = import(gpu::Format::R8Unorm, 1, VK_FORMAT_R8_UNORM);
    auto shares = must(LightMasks::create(*device_, {.host = desc_, .masks = {share}}));
    must(shares.prepare(list, view));
    must(shares.resolve(1, 1));
    EXPECT_THAT(host_->read_bytes(1), testing::Contains(testing::Ne(0)));
}

}  // namespace
}  // namespace gnomon::test
