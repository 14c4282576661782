// SPDX-License-Identifier: MIT
#include <gnomon/render/renderer.hpp>

#include <gtest/gtest.h>

#include <gnomon/gpu/fault_backend.hpp>
#include <gnomon/gpu/null_backend.hpp>
#include <gnomon/scene/shadow_adapter.hpp>

#include "tests/rows/picture.hpp"
#include "tests/rows/rows.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {
namespace {

const Row& row(const char* name) {
    return *std::find_if(rows().begin(), rows().end(),
                         [&](const Row& r) { return r.name == name; });
}

// Draws one frame and gives the finished picture's bytes.
Result<std::vector<std::byte>> draw(gpu::Device& device, const Setting& setting,
                                    const render::RendererDesc& desc,
                                    const render::Environment& environment = {}) {
    auto renderer = render::Renderer::create(device, desc);
    if (!renderer) return forward_error(renderer);
    if (const Status uploaded = renderer->upload(setting.scene); !uploaded)
        return forward_error(uploaded);
    auto system = shadows::ShadowSystem::create();
    scene::ShadowAdapter adapter;
    auto frame = system->begin_frame();
    if (const Status submitted = adapter.submit(setting.scene, frame); !submitted)
        return forward_error(submitted);
    const shadows::DrawList list = std::move(frame).finish(setting.view);
    const Status rendered = renderer->render({.scene = setting.scene,
                                              .view = setting.view,
                                              .shadows = list,
                                              .environment = environment});
    if (!rendered) return forward_error(rendered);
    return device.read_texture(renderer->picture());
}

constexpr render::RendererDesc small{.width = row_width, .height = row_height};

double mean_brightness(const std::vector<std::byte>& rgba, const std::vector<std::uint8_t>& mask,
                       bool shadowed) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = row_width * row_height / 2; i < mask.size();
         ++i) {  // the lower half: ground, no sky
        if ((mask[i] != 0) != shadowed) continue;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            sum += std::to_integer<int>(rgba[4 * i + channel]);
        }
        count += 3.0;
    }
    return sum / count;
}

class Renderer : public DeviceTest {};

TEST_P(Renderer, what_the_mask_covers_is_darker) {
    const Setting setting = row("hidden_caster").make();
    const auto rgba = must(draw(device(), setting, small));
    const Picture picture = must(take_picture(device(), setting, {}));
    const auto& mask = picture.masks[0][0];
    EXPECT_GT(mean_brightness(rgba, mask, false), 1.4 * mean_brightness(rgba, mask, true));
}

// A light at the eye: the half vector is the viewer's direction, and their product rounds to more
// than one here and there.
TEST_P(Renderer, a_light_at_the_eye_leaves_no_black_pixels) {
    Setting setting = row("hidden_caster").make();
    scene::Registry& registry = setting.scene.registry;
    std::vector<scene::Entity> lights;
    registry.each<scene::PointLight>([&](scene::Entity e, auto&) { lights.push_back(e); });
    registry.each<scene::DirectionalLight>([&](scene::Entity e, auto&) { lights.push_back(e); });
    for (const scene::Entity light : lights) {
        registry.remove<scene::PointLight>(light);
        registry.remove<scene::DirectionalLight>(light);
    }
    const glm::dmat4 eye = glm::inverse(setting.view.view_from_world);
    const scene::Entity lamp = setting.scene.create_node("lamp", {.matrix = eye});
    registry.emplace<scene::PointLight>(lamp, scene::PointLight{.intensity = 40.0F});
    const auto rgba = must(draw(device(), setting, small));
    std::size_t black = 0;
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        black += rgba[i] == std::byte{0} && rgba[i + 1] == std::byte{0} ? 1U : 0U;
    }
    EXPECT_EQ(black, 0U);
}

TEST_P(Renderer, an_environment_says_what_is_seen_without_light_and_how_bright_light_is) {
    const Setting setting = row("hidden_caster").make();
    const auto pixel = [](const std::vector<std::byte>& rgba, std::size_t at) {
        return std::to_integer<int>(rgba[at]) + std::to_integer<int>(rgba[at + 1]) +
               std::to_integer<int>(rgba[at + 2]);
    };
    const auto sum = [&](const render::Environment& environment) {
        const auto rgba = must(draw(device(), setting, small, environment));
        double all = 0.0;
        for (std::size_t i = 0; i < rgba.size(); i += 4) all += pixel(rgba, i);
        return all;
    };
    const glm::vec3 black(0.0F);
    const double dark = sum({black, black, black, 0.0F});
    EXPECT_EQ(dark, 0.0);
    EXPECT_GT(sum({black, black, glm::vec3(0.0F, 1.0F, 0.0F), 0.0F}), 0.0) << "background";
    const double ambient = sum({glm::vec3(0.2F), glm::vec3(0.2F), black, 0.0F});
    EXPECT_GT(ambient, 0.0);
    const double dim = sum({glm::vec3(0.2F), glm::vec3(0.2F), black, 2.0F});
    EXPECT_GT(dim, ambient);
    EXPECT_GT(sum({glm::vec3(0.2F), glm::vec3(0.2F), black, 20.0F}), dim);
}

TEST_P(Renderer, every_overlay_shows) {
    const Setting setting = row("mirrored_and_sheared").make();
    const auto plain = must(draw(device(), setting, small));
    for (bool render::Overlays::*overlay :
         {&render::Overlays::volumes, &render::Overlays::silhouettes, &render::Overlays::caps,
          &render::Overlays::wireframe, &render::Overlays::count, &render::Overlays::fill}) {
        render::RendererDesc desc = small;
        desc.overlays.*overlay = true;
        EXPECT_NE(must(draw(device(), setting, desc)), plain);
    }
}

INSTANTIATE_TEST_SUITE_P(Devices, Renderer, testing::ValuesIn(drawing_devices()), device_case_name);

TEST(RendererFaults, a_device_that_fails_anywhere_gives_a_result_and_leaves_nothing) {
    const Setting setting = row("open_meshes").make();
    bool succeeded = false;
    for (std::uint64_t fail_at = 1; !succeeded && fail_at < 400; ++fail_at) {
        gpu::FaultPlan plan{.fail_at = fail_at};
        gpu::Device device(gpu::create_fault_backend(gpu::create_null_backend(), plan));
        succeeded = draw(device, setting, {.width = 16, .height = 16}).has_value();
        EXPECT_EQ(succeeded, plan.calls < fail_at);
        EXPECT_EQ(device.counters().objects_alive, 0U) << "failing at call " << fail_at;
    }
    EXPECT_TRUE(succeeded);
}

}  // namespace
}  // namespace gnomon::test
