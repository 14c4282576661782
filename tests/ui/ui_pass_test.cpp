// SPDX-License-Identifier: MIT
//
// A panel on every device: what is drawn, where, and the same bytes everywhere.
#include <gtest/gtest.h>
#include <imgui.h>
#include <gnomon/ui/context.hpp>
#include <gnomon/ui/ui_pass.hpp>

#include <algorithm>
#include <array>
#include <cstring>

#include "tests/support/devices.hpp"

namespace gnomon::ui {
namespace {

using test::must;

constexpr std::uint32_t width = 320;
constexpr std::uint32_t height = 200;
using Pixel = std::array<std::uint8_t, 4>;

struct Picture {
    std::vector<std::byte> bytes;
    [[nodiscard]] Pixel at(std::uint32_t x, std::uint32_t y) const {
        Pixel pixel{};
        std::memcpy(pixel.data(), bytes.data() + std::size_t{4} * (y * width + x), 4);
        return pixel;
    }
    // Pixels of a rectangle for which it is true.
    template <class Condition>
    [[nodiscard]] int count(glm::uvec2 min, glm::uvec2 max, Condition condition) const {
        int found = 0;
        for (std::uint32_t y = min.y; y < max.y; ++y) {
            for (std::uint32_t x = min.x; x < max.x; ++x) found += condition(at(x, y)) ? 1 : 0;
        }
        return found;
    }
};

// Over a blue-grey target, in the built-in font, which has the same bytes everywhere.
template <class Widgets>
Picture draw(gpu::Device& device, Widgets widgets, int frames = 1) {
    Context context({.fonts = {}});
    UiPass pass = must(UiPass::create(device, context.fonts()));
    const gpu::Texture target = must(device.create_texture(
        {.label = "picture",
         .width = width,
         .height = height,
         .format = gpu::Format::Rgba8Unorm,
         .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc}));
    for (int i = 0; i < frames; ++i) {
        gpu::CommandEncoder encoder = device.create_command_encoder("clear");
        encoder
            .begin_render_pass({.label = "clear",
                                .color_attachments = {{.texture = target,
                                                       .load_op = gpu::LoadOp::Clear,
                                                       .clear_value = {0.2, 0.4, 0.6, 1.0}}}})
            .end();
        must(device.submit(must(encoder.finish())));
        context.begin_frame({}, {width, height}, 1.0 / 60.0);
        widgets();
        must(pass.draw(context.end_frame(), target, width, height));
    }
    return {must(device.read_texture(target))};
}

constexpr Pixel background{51, 102, 153, 255};

void panel() {
    ImGui::SetNextWindowPos({20, 10});
    ImGui::SetNextWindowSize({200, 150});
    ImGui::Begin("lights", nullptr, ImGuiWindowFlags_NoCollapse);
    static bool on = true;
    static float value = 0.4F;
    ImGui::Checkbox("lamp", &on);
    ImGui::SliderFloat("range", &value, 0.0F, 1.0F);
    ImGui::Text("%d casters", 256);
    ImGui::GetWindowDrawList()->AddCircle({200, 140}, 12.0F, IM_COL32(255, 200, 80, 255), 0, 2.5F);
    ImGui::End();
}

class UiPassOnDevice : public test::DeviceTest {};

TEST_P(UiPassOnDevice, blends_premultiplied) {
    const Picture picture = draw(device(), [] {
        ImDrawList& list = *ImGui::GetForegroundDrawList();
        list.AddRectFilled({10, 10}, {30, 30}, IM_COL32(255, 0, 0, 255));
        list.AddRectFilled({40, 10}, {60, 30}, IM_COL32(255, 0, 0, 102));
    });
    EXPECT_EQ(picture.at(20, 20), (Pixel{255, 0, 0, 255}));
    const Pixel mixed = picture.at(50, 20);
    EXPECT_NEAR(mixed[0], 51 + 0.4 * (255 - 51), 1);
    EXPECT_NEAR(mixed[1], 102 * 0.6, 1);
    EXPECT_NEAR(mixed[2], 153 * 0.6, 1);
    EXPECT_EQ(mixed[3], 255);
    EXPECT_EQ(picture.at(9, 20), background);
    EXPECT_EQ(picture.at(30, 20), background);
    EXPECT_EQ(picture.at(20, 9), background);
    EXPECT_EQ(picture.at(20, 30), background);
}

TEST_P(UiPassOnDevice, cuts_at_clip_rectangles) {
    const Picture picture = draw(device(), [] {
        ImDrawList& list = *ImGui::GetForegroundDrawList();
        list.PushClipRect({100, 50}, {140, 80});
        list.AddRectFilled({0, 0}, {320, 200}, IM_COL32(255, 255, 255, 255));
        list.PopClipRect();
        list.PushClipRect({-50, 190}, {5, 400});  // reaches out of the picture
        list.AddRectFilled({-100, 0}, {320, 300}, IM_COL32(0, 255, 0, 255));
        list.PopClipRect();
        list.PushClipRect({400, 50}, {500, 80});  // outside of it
        list.AddRectFilled({0, 0}, {500, 200}, IM_COL32(255, 0, 0, 255));
        list.PopClipRect();
    });
    const auto white = [](const Pixel& p) { return p == Pixel{255, 255, 255, 255}; };
    const auto green = [](const Pixel& p) { return p == Pixel{0, 255, 0, 255}; };
    EXPECT_EQ(picture.count({100, 50}, {140, 80}, white), 40 * 30);
    EXPECT_EQ(picture.count({0, 190}, {5, 200}, green), 5 * 10);
    EXPECT_EQ(
        picture.count({0, 0}, {width, height}, [](const Pixel& p) { return p == background; }),
        static_cast<int>(width * height) - 40 * 30 - 5 * 10);
}

TEST_P(UiPassOnDevice, text_is_upright_and_where_it_belongs) {
    const Picture picture = draw(device(), [] {
        ImDrawList& list = *ImGui::GetForegroundDrawList();
        list.AddText({50, 60}, IM_COL32(255, 255, 255, 255), "LLLL");
    });
    // The built-in font is 13 pixels high and 7 wide. An L has its stroke on the left and below.
    const auto bright = [](const Pixel& p) { return p[0] > 200; };
    EXPECT_EQ(picture.count({50, 60}, {78, 73}, bright),
              picture.count({0, 0}, {width, height}, bright));
    int lowest = 0;
    int most = 0;
    for (std::uint32_t y = 60; y < 73; ++y) {
        const int row = picture.count({50, y}, {78, y + 1}, bright);
        if (row > 0) lowest = static_cast<int>(y);
        if (row > most) most = row;
    }
    const auto foot = static_cast<std::uint32_t>(lowest);
    EXPECT_EQ(picture.count({50, foot}, {78, foot + 1}, bright), most) << "upside down";
    EXPECT_GT(most, 4 * 3);
    EXPECT_EQ(picture.count({50, foot - 3}, {78, foot - 2}, bright), 4) << "one stroke a letter";
}

TEST_P(UiPassOnDevice, a_frame_may_need_larger_buffers_than_the_last) {
    int frame = 0;
    const Picture picture = draw(
        device(),
        [&frame] {
            ImDrawList& list = *ImGui::GetForegroundDrawList();
            // The last frame is many times the first; 20,000 rectangles need two draw lists' worth
            // of 16-bit indices.
            const int count = frame++ == 0 ? 4 : 20000;
            for (int i = 0; i < count; ++i) {
                const auto x = static_cast<float>(i % 160 * 2);
                const auto y = static_cast<float>(i / 160);
                list.AddRectFilled({x, y}, {x + 1, y + 1}, IM_COL32(255, 255, 255, 255));
            }
        },
        2);
    const auto white = [](const Pixel& p) { return p == Pixel{255, 255, 255, 255}; };
    EXPECT_EQ(picture.count({0, 0}, {width, height}, white), 20000);
}

TEST_P(UiPassOnDevice, uploads_and_draws_what_it_must) {
    Context context({.fonts = {}});
    const std::uint64_t before = device().counters().objects_alive;
    {
        UiPass pass = must(UiPass::create(device(), context.fonts()));
        context.begin_frame({}, {width, height}, 0.0);
        panel();
        must(pass.prepare(context.end_frame()));
        const std::uint64_t uploaded = device().counters().uploaded_bytes;
        context.begin_frame({}, {width, height}, 0.0);
        panel();
        const ImDrawData& data = context.end_frame();
        must(pass.prepare(data));
        const auto vertices = static_cast<std::uint64_t>(data.TotalVtxCount) * sizeof(ImDrawVert);
        const auto indices = static_cast<std::uint64_t>(data.TotalIdxCount) * sizeof(ImDrawIdx);
        EXPECT_EQ(device().counters().uploaded_bytes - uploaded,
                  16 + vertices + (indices + 3) / 4 * 4);
    }
    EXPECT_EQ(device().counters().objects_alive, before);
}

INSTANTIATE_TEST_SUITE_P(Devices, UiPassOnDevice, testing::ValuesIn(test::drawing_devices()),
                         test::device_case_name);

// One panel with all that widgets are made of: text, rounded corners, antialiased lines.
TEST(UiPassParity, a_panel_has_the_same_bytes_on_every_device) {
    std::string first_name;
    Picture first;
    int devices = 0;
    for (const test::DeviceCase& device_case : test::drawing_devices()) {
        const auto opened = test::shared_device(device_case);
        if (!opened) continue;
        ++devices;
        const Picture picture = draw((*opened)->device, panel, 2);
        if (first.bytes.empty()) {
            first = picture;
            first_name = device_case.name;
            const auto light = [](const Pixel& p) { return p[0] > 190 && p[1] > 190; };
            EXPECT_GT(first.count({20, 10}, {220, 160}, light), 200) << "text";
            EXPECT_EQ(first.at(19, 80), background);
            EXPECT_NE(first.at(24, 80), background);
            continue;
        }
        std::size_t differ = 0;
        int largest = 0;
        for (std::size_t i = 0; i < picture.bytes.size(); ++i) {
            const int difference = std::abs(std::to_integer<int>(picture.bytes[i]) -
                                            std::to_integer<int>(first.bytes[i]));
            differ += difference != 0 ? 1 : 0;
            largest = std::max(largest, difference);
        }
        EXPECT_EQ(differ, 0U) << device_case.name << " differs from " << first_name << " by up to "
                              << largest;
    }
    if (devices < 2) GTEST_SKIP() << "There are fewer than two devices that draw.";
}

}  // namespace
}  // namespace gnomon::ui
