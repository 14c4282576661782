// SPDX-License-Identifier: MIT
//
// Light by the mask: in shadow a surface looks as if the light were not there, elsewhere as if
// nothing cast; with four samples a pixel is the mean of what its samples would be, at shadow edges
// and where surfaces meet; however many lights there are.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <gnomon/render/light_choice.hpp>
#include <gnomon/render/renderer.hpp>
#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/shadow_adapter.hpp>

#include "tests/rows/rows.hpp"
#include "tests/rows/stage.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {
namespace {

enum class Lights { Shadowed, Unshadowed, Out };

struct Frame {
    std::vector<std::byte> rgba;
    std::vector<std::vector<std::byte>> masks;  // of the first light, by sample
    std::uint64_t draw_calls = 0;
    std::size_t lights = 0;
};

Frame draw(gpu::Device& device, const Setting& setting, std::uint32_t samples,
           Lights lights = Lights::Shadowed, bool read_masks = false) {
    auto renderer = must(render::Renderer::create(
        device, {.width = row_width, .height = row_height, .sample_count = samples}));
    must(renderer.upload(setting.scene));
    auto system = must(shadows::ShadowSystem::create({.fill = shadows::FillOptions::none()}));
    scene::ShadowAdapter adapter;
    auto frame = system.begin_frame();
    const render::LightChoice none =
        render::choose_shadowed_lights(setting.scene, {}, setting.view, 0);
    must(adapter.submit(setting.scene, frame, false, shadows::NearCaps::Facing,
                        lights == Lights::Shadowed ? std::span<const scene::Entity>()
                                                   : std::span(none.unshadowed)));
    const shadows::DrawList& list = std::move(frame).finish(setting.view);
    Frame result;
    render::FrameInput input{setting.scene, setting.view, list, {}, {}, {}};
    if (lights == Lights::Unshadowed) input.unshadowed = none.unshadowed;
    if (read_masks) {
        input.after_light = [&](std::size_t light) -> Status {
            for (std::uint32_t s = 0; s < samples && light == 0; ++s) {
                auto mask = render::read_stencil(device, renderer, s);
                if (!mask) return forward_error(mask);
                result.masks.push_back(std::move(*mask));
            }
            return {};
        };
    }
    result.lights = list.lights.size();
    const std::uint64_t before = device.counters().draw_calls;
    must(renderer.render(input));
    result.draw_calls = device.counters().draw_calls - before;
    result.rgba = must(device.read_texture(renderer.picture()));
    return result;
}

int level(const std::vector<std::byte>& rgba, std::size_t pixel, std::size_t channel) {
    return std::to_integer<int>(rgba[4 * pixel + channel]);
}

std::size_t pixels_apart(const std::vector<std::byte>& a, const std::vector<std::byte>& b,
                         int most) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        count += std::abs(std::to_integer<int>(a[i]) - std::to_integer<int>(b[i])) > most ? 1 : 0;
    }
    return count;
}

// tone_map.frag, there and back.
double displayed(double x) {
    x = std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
    return 255.0 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055);
}
double radiance_of(int shown) {
    double low = 0.0;
    double high = 16.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (displayed(middle) < shown ? low : high) = middle;
    }
    return low;
}

// A wall in the shadow of a sheet that is not drawn, and before the sheet a lit board, turned so
// that its edges cut pixels. Orthographic and by a sun: each surface has one colour.
Setting board_before_wall() {
    Stage stage;
    const glm::dmat4 upright = turned(90.0, {1, 0, 0});
    const auto plane = shared(scene::make_plane(1.0F, 1.0F, 1));
    stage.place(plane, moved({0, 0, -4}) * scaled(glm::dvec3(60)) * upright, false);
    stage.place(plane, moved({0, 0, -2}) * scaled(glm::dvec3(60)) * upright, true, false);
    stage.place(plane, turned(21.0, {0, 0, 1}) * scaled(glm::dvec3(3)) * upright, false);
    stage.sun({0.3, -0.4, -1.0});
    stage.look_orthographic({0, 0, 5}, {0, 0, 0}, 3.0, 0.1, 20.0);
    return stage.finish();
}

// The shadow of a ball that is not drawn, on the ground.
Setting shadow_alone() {
    Stage stage;
    stage.ground();
    stage.place(shared(scene::make_box(glm::vec3(1.5F))),
                moved({0, 3, 0}) * turned(33.0, {1, 2, 3}), true, false);
    stage.sun({0.3, -1.0, -0.2});
    stage.look({1, 9, 6}, {0, 0, 0});
    return stage.finish();
}

class LightMask : public DeviceTest {};

TEST_P(LightMask, a_surface_in_shadow_is_as_if_the_light_were_not_there) {
    for (const std::uint32_t samples : {1U, 4U}) {
        SCOPED_TRACE(samples);
        std::size_t of_one_light = 0;
        for (const Row& row : rows()) {
            const Setting setting = row.make();
            const Frame frame = draw(device(), setting, samples, Lights::Shadowed, true);
            if (row.cull_back_faces || frame.lights != 1) continue;
            ++of_one_light;
            const Frame lit = draw(device(), setting, samples, Lights::Unshadowed);
            const Frame dark = draw(device(), setting, samples, Lights::Out);
            std::array<std::size_t, 2> seen{};
            std::size_t wrong = 0;
            for (std::size_t i = 0; i < row_width * row_height; ++i) {
                const bool shadowed = frame.masks[0][i] != std::byte{0};
                const bool mixed = std::ranges::any_of(frame.masks, [&](const auto& mask) {
                    return (mask[i] != std::byte{0}) != shadowed;
                });
                if (mixed) continue;
                ++seen[shadowed ? 1 : 0];
                for (std::size_t c = 0; c < 3; ++c) {
                    const int expected = level((shadowed ? dark : lit).rgba, i, c);
                    wrong += std::abs(level(frame.rgba, i, c) - expected) > 1 ? 1 : 0;
                }
            }
            EXPECT_EQ(wrong, 0U) << row.name;
            EXPECT_GT(seen[0], 500U) << row.name;
            EXPECT_GT(seen[1], 500U) << row.name;
        }
        EXPECT_GT(of_one_light, 3U);
    }
}

TEST_P(LightMask, a_mixed_pixel_is_the_mean_of_its_samples) {
    if (!features().multisample_4) GTEST_SKIP() << "no multisample_4";
    for (const bool edge_of_shadow : {true, false}) {
        SCOPED_TRACE(edge_of_shadow ? "edge of a shadow" : "edge of a surface");
        const Setting setting = edge_of_shadow ? shadow_alone() : board_before_wall();
        const Frame frame = draw(device(), setting, 4, Lights::Shadowed, true);
        const Frame lit = draw(device(), setting, 4, Lights::Unshadowed);
        const Frame dark = draw(device(), setting, 4, Lights::Out);
        const auto count_lit = [&](std::size_t i) {
            return std::ranges::count_if(frame.masks,
                                         [&](const auto& mask) { return mask[i] == std::byte{0}; });
        };
        // Where each surface has one colour, that of the lit board and the dark wall.
        constexpr std::size_t board = row_width * (row_height / 2) + row_width / 2;
        constexpr std::size_t wall = row_width * 3 + 3;
        if (!edge_of_shadow) {
            ASSERT_EQ(count_lit(board), 4);
            ASSERT_EQ(count_lit(wall), 0);
            ASSERT_GT(level(lit.rgba, wall, 0), level(dark.rgba, wall, 0) + 20);
        }
        std::size_t mixed = 0;
        for (std::size_t i = 0; i < row_width * row_height; ++i) {
            const auto arriving = count_lit(i);
            if (arriving == 0 || arriving == 4) continue;
            ++mixed;
            for (std::size_t c = 0; c < 3; ++c) {
                const double with = radiance_of(level(lit.rgba, edge_of_shadow ? i : board, c));
                const double without = radiance_of(level(dark.rgba, edge_of_shadow ? i : wall, c));
                const double share = static_cast<double>(arriving) / 4.0;
                ASSERT_NEAR(level(frame.rgba, i, c),
                            displayed(share * with + (1.0 - share) * without), 2.0)
                    << "pixel " << i % row_width << "," << i / row_width << ", " << arriving
                    << " samples lit";
            }
        }
        EXPECT_GT(mixed, 100U);
    }
}

Setting lamps(int count, bool backwards) {
    Stage stage;
    stage.ground();
    stage.place(shared(scene::make_box(glm::vec3(1.0F))), moved({0, 1, 0}));
    for (int k = 0; k < count; ++k) {
        const double angle = 0.7 * (backwards ? count - 1 - k : k);
        stage.lamp({4.0 * std::cos(angle), 3.0, 4.0 * std::sin(angle)});
    }
    stage.look({3, 6, 8}, {0, 0, 0});
    return stage.finish();
}

TEST_P(LightMask, lights_beyond_eight_come_in_rounds) {
    for (const std::uint32_t samples : {1U, 4U}) {
        SCOPED_TRACE(samples);
        const Frame forwards = draw(device(), lamps(18, false), samples);
        const Frame backwards = draw(device(), lamps(18, true), samples);
        EXPECT_EQ(pixels_apart(forwards.rgba, backwards.rgba, 2), 0U);
        const Frame of_sixteen = draw(device(), lamps(16, false), samples);
        EXPECT_GT(pixels_apart(forwards.rgba, of_sixteen.rgba, 2), 1000U);
    }
}

TEST_P(LightMask, lights_that_reach_nothing_in_view_are_left_out) {
    Stage stage;
    stage.ground();
    stage.place(shared(scene::make_box(glm::vec3(1.0F))), moved({0, 1, 0}));
    stage.place(shared(scene::make_box(glm::vec3(1.0F))), moved({0, 1, 9.0}));
    stage.lamp({2, 4, 1});
    stage.lamp({1, 3, 9.5}, 4.0);  // behind the eye, with a caster
    stage.look({0, 2, 4}, {0, 1, 0});
    const Setting setting = stage.finish();
    const Frame without = draw(device(), setting, 1);
    const Frame with = draw(device(), setting, 1, Lights::Shadowed, true);
    EXPECT_LT(without.draw_calls, with.draw_calls);
    EXPECT_EQ(pixels_apart(without.rgba, with.rgba, 0), 0U);
    EXPECT_EQ(pixels_apart(without.rgba, with.rgba, 1), 0U);
}

INSTANTIATE_TEST_SUITE_P(Devices, LightMask, testing::ValuesIn(drawing_devices()),
                         device_case_name);

}  // namespace
}  // namespace gnomon::test
