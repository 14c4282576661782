// SPDX-License-Identifier: MIT
//
// What is drawn, held against what the rules know, and device against device: in the middle of each
// recording.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assets.hpp"
#include "drawing.hpp"
#include "recording.hpp"
#include "tests/support/devices.hpp"
#include "tests/support/share.hpp"
#include "world.hpp"

namespace gnomon::game {
namespace {

using Masks = std::vector<std::vector<std::byte>>;
constexpr std::uint32_t width = 480;
constexpr std::uint32_t height = 270;

/// A level as it is in the middle of its recording. Simulated once.
World& middle_of(const std::string& name) {
    static std::map<std::string, World> worlds;
    const auto known = worlds.find(name);
    if (known != worlds.end()) return known->second;
    const auto assets = std::filesystem::path(GNOMON_GAME_ASSETS);
    World world = test::must(World::create(test::must(load_named_level(assets, name))));
    const Recording recording =
        test::must(load_recording(assets / "recordings" / (name + ".replay")));
    const std::size_t half = std::min<std::size_t>(recording.inputs.size() / 2, 500);
    for (std::size_t i = 0; i < half; ++i) test::must(world.tick(recording.inputs[i]));
    return worlds.emplace(name, std::move(world)).first->second;
}

shadows::View view_of(World& world) {
    return follow(world.level(), world.player(), static_cast<double>(width) / height);
}

struct Shot {
    Masks masks;  ///< of each light, in the order of their keys
    std::vector<std::byte> rgba;
};

Shot take(gpu::Device& device, World& world) {
    Drawing drawing = test::must(
        Drawing::create(device, world.stage(), {.width = width, .height = height, .samples = 1}));
    Shot shot;
    test::must(
        drawing.draw(world.stage(), world.level(), view_of(world), [&](std::size_t) -> Status {
            auto mask = render::read_stencil(device, drawing.renderer());
            if (!mask) return forward_error(mask);
            shot.masks.push_back(std::move(*mask));
            return {};
        }));
    shot.rgba = test::must(drawing.read_picture());
    return shot;
}

class Pictures : public test::DeviceTest {};

/// That something is to be seen.
void expect_neither_black_nor_white(const std::vector<std::byte>& rgba) {
    std::size_t dark = 0;
    std::size_t bright = 0;
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        const int green = std::to_integer<int>(rgba[i + 1]);
        dark += green < 4 ? 1U : 0U;
        bright += green > 250 ? 1U : 0U;
    }
    EXPECT_LT(dark, width * height / 4);
    EXPECT_LT(bright, width * height / 100);
}

TEST_P(Pictures, have_the_masks_of_every_other_device) {
    static std::map<std::string, Masks> first;
    for (const std::string& name : test::must(level_names(GNOMON_GAME_ASSETS))) {
        World& world = middle_of(name);
        const std::uint64_t hash = world.hash();
        const Shot shot = take(device(), world);
        const Masks& masks = shot.masks;
        expect_neither_black_nor_white(shot.rgba);
        EXPECT_EQ(world.hash(), hash) << "drawing changes nothing";
        EXPECT_GE(masks.size(), 2U);
        const auto [known, is_first] = first.emplace(name, masks);
        if (is_first) continue;
        EXPECT_EQ(masks, known->second) << name;
    }
}

/// Where a point of the world is in the picture, if it is.
std::optional<glm::ivec2> pixel_of(const shadows::View& view, const glm::dvec3& point) {
    const glm::dvec4 clip = view.clip_from_world() * glm::dvec4(point, 1.0);
    if (clip.w <= 0.0) return std::nullopt;
    const glm::dvec2 at((clip.x / clip.w * 0.5 + 0.5) * width,
                        (0.5 - clip.y / clip.w * 0.5) * height);
    const glm::ivec2 pixel(glm::floor(at));
    const bool inside = pixel.x >= 0 && pixel.y >= 0 && pixel.x < static_cast<int>(width) &&
                        pixel.y < static_cast<int>(height);
    return inside ? std::optional(pixel) : std::nullopt;
}

// What you see is what they know: points of the ground that the camera sees, under every light.
TEST_P(Pictures, show_what_the_meter_knows) {
    const std::vector<std::string> names = test::must(level_names(GNOMON_GAME_ASSETS));
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (!test::falls_to(number(), i, names.size())) continue;
        const std::string& name = names[i];
        World& world = middle_of(name);
        const Shot shot = take(device(), world);
        const shadows::View view = view_of(world);
        Stage& stage = world.stage();
        const shadows::ShadowQueries& queries = stage.queries();
        std::vector<shadows::Light> lights;
        for (const MeterLight& light : stage.lights()) lights.push_back(light.shadow);
        std::ranges::sort(lights, {}, &shadows::Light::key);
        ASSERT_EQ(lights.size(), shot.masks.size());
        const shadows::Light eye{
            .key = 1,
            .position_world = glm::dvec4(glm::dvec3(glm::inverse(view.view_from_world)[3]), 1.0)};

        std::size_t asked = 0;
        std::size_t shadowed = 0;
        std::size_t wrong = 0;
        const glm::dvec2 half = world.level().size_m * 0.5;
        for (double z = -half.y; z < half.y; z += 0.21) {
            for (double x = -half.x; x < half.x; x += 0.21) {
                const glm::dvec3 point(x, 0.0, z);
                const auto pixel = pixel_of(view, point);
                const glm::dvec2 plan(x, z);
                const glm::dvec2 from_exit = glm::abs(plan - world.level().exit);
                const bool may_be_hidden_by_what_casts_nothing =
                    glm::length(plan - world.player().at) < 1.0 ||
                    (from_exit.x < 1.5 && from_exit.y < 1.5);
                if (!pixel || may_be_hidden_by_what_casts_nothing) continue;
                // A pixel and a half about it all must be alike, seen, and lit or not; more densely
                // than bars are thick.
                const auto all_are = [&](const shadows::Light& light, shadows::Exposure exposure) {
                    for (const double dx : {-0.06, -0.03, 0.0, 0.03, 0.06}) {
                        for (const double dz : {-0.06, -0.03, 0.0, 0.03, 0.06}) {
                            if (queries.at(light, point + glm::dvec3(dx, 0.0, dz)) != exposure) {
                                return false;
                            }
                        }
                    }
                    return true;
                };
                if (!all_are(eye, shadows::Exposure::Lit)) continue;
                for (std::size_t l = 0; l < lights.size(); ++l) {
                    const bool lit = all_are(lights[l], shadows::Exposure::Lit);
                    if (!lit && !all_are(lights[l], shadows::Exposure::Shadowed)) continue;
                    const auto place = static_cast<std::size_t>(pixel->y) * width +
                                       static_cast<std::size_t>(pixel->x);
                    const bool drawn_lit = shot.masks[l][place] == std::byte{0};
                    ++asked;
                    shadowed += lit ? 0U : 1U;
                    wrong += lit == drawn_lit ? 0U : 1U;
                }
            }
        }
        EXPECT_GT(asked, 1000U) << name;
        EXPECT_GT(shadowed, 50U) << name;
        EXPECT_EQ(wrong, 0U) << name << ", of " << asked;
    }
}

// What the panel switches is the picture's alone.
TEST_P(Pictures, without_a_light_are_others_and_change_no_rule) {
    World& world = middle_of("courtyard");
    const std::uint64_t hash = world.hash();
    DrawingOptions options{.width = 160, .height = 90, .samples = 1};
    Drawing drawing = test::must(Drawing::create(device(), world.stage(), options));
    const auto draw = [&] {
        test::must(drawing.configure(options));
        test::must(drawing.draw(world.stage(), world.level(), view_of(world)));
        return test::must(drawing.read_picture());
    };
    const auto all = draw();
    const std::size_t lights = drawing.draw_list()->lights.size();
    EXPECT_GT(drawing.draw_calls(), 0U);
    std::size_t seen = 0;  // of the lights, in the picture
    for (const MeterLight& meter : world.stage().lights()) {
        const scene::Entity light = scene::Entity::from_key(meter.shadow.key);
        options.off = {light};
        options.unshadowed.clear();
        const auto without = draw();
        EXPECT_EQ(drawing.draw_list()->lights.size(), lights - 1);
        std::swap(options.off, options.unshadowed);
        const auto through = draw();
        EXPECT_EQ(drawing.draw_list()->lights.size(), lights - 1);
        seen += without != all && through != all && without != through ? 1 : 0;
    }
    EXPECT_GE(seen, 2U);
    options.unshadowed.clear();
    EXPECT_EQ(draw(), all);
    for (const char* strategy : {"brute_force", "dual_bvh"}) {
        options.silhouette = strategy;
        EXPECT_EQ(draw(), all) << strategy;
        EXPECT_EQ(drawing.shadow_stats().silhouette, strategy);
    }
    EXPECT_EQ(world.hash(), hash);
    options.silhouette = "guess";
    EXPECT_FALSE(drawing.configure(options));
}

INSTANTIATE_TEST_SUITE_P(Devices, Pictures, testing::ValuesIn(test::drawing_devices()),
                         test::device_case_name);

}  // namespace
}  // namespace gnomon::game
