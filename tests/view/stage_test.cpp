// SPDX-License-Identifier: MIT
//
// What the viewer lets one change: that it changes the picture, and no more than it should.
#include "view/stage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/render/camera.hpp>

#include "tests/support/devices.hpp"
#include "view/orbit_camera.hpp"

namespace gnomon::cli {
namespace {

using gnomon::test::must;

constexpr glm::uvec2 size{320, 240};

class OnStage : public gnomon::test::DeviceTest {
protected:
    void open(const std::string& source) {
        RenderOptions options;
        options.scene = source;
        stage.emplace(must(Stage::load(options)));
        must(stage->set_device(device(), size));
        const Shot& shot = stage->shot();
        camera = OrbitCamera(shot.camera, shot.world_from_camera, shot.near_m, shot.bounds);
    }
    void TearDown() override {
        stage.reset();
        DeviceTest::TearDown();
    }
    std::vector<std::byte> draw() {
        must(stage->draw(view(), size));
        return must(device().read_texture(stage->picture()));
    }
    [[nodiscard]] shadows::View view() const { return camera.view({.size_px = size}); }
    [[nodiscard]] std::uint64_t pairs_of(shadows::Reason reason) const {
        return stage->figures().shadows.reasons[static_cast<std::size_t>(reason)];
    }

    std::optional<Stage> stage;
    OrbitCamera camera;
};

TEST_P(OnStage, lights_and_their_shadows_go_out_and_on_again) {
    open("builtin:pillars");
    ASSERT_EQ(stage->lights().size(), 2U);
    const auto all = draw();
    stage->lights()[0].on = false;
    const auto one = draw();
    EXPECT_NE(one, all);
    EXPECT_EQ(stage->draw_list().lights.size(), 1U);
    stage->lights()[0].on = true;
    EXPECT_EQ(draw(), all);
    stage->lights()[0].casts = false;
    const auto shines_through = draw();
    EXPECT_NE(shines_through, all);
    EXPECT_NE(shines_through, one);
    stage->lights()[0].casts = true;
    EXPECT_EQ(draw(), all);
    stage->lights()[0].on = false;
    stage->lights()[1].on = false;
    static_cast<void>(draw());
    EXPECT_TRUE(stage->draw_list().lights.empty());
}

TEST_P(OnStage, every_choice_draws_the_same_shadows) {
    open("builtin:pillars");
    const auto picture = draw();
    RenderOptions& options = stage->options();
    for (const auto technique : {shadows::Technique::DepthFail, shadows::Technique::DepthPass}) {
        options.technique = technique;
        stage->shadows_changed();
        EXPECT_EQ(draw(), picture);
        EXPECT_EQ(stage->figures().shadows.zpass_pairs == 0,
                  technique == shadows::Technique::DepthFail);
    }
    options.technique.reset();
    options.silhouette = "brute_force";
    options.fill = shadows::FillOptions::none();
    stage->shadows_changed();
    EXPECT_EQ(draw(), picture);
    options.overlays.silhouettes = true;
    EXPECT_NE(draw(), picture);
    options.overlays = {};
    EXPECT_EQ(draw(), picture);
}

TEST_P(OnStage, masks_are_what_the_stencil_holds_of_each_light_that_casts) {
    open("builtin:pillars");
    stage->options().overlays.fill = true;  // shown in the picture, and in no mask
    const auto picture = draw();
    const auto masks = must(stage->draw_masks(view(), size));
    ASSERT_EQ(masks.size(), 2U);
    EXPECT_LT(masks[0].light.key, masks[1].light.key);
    for (const LightMask& mask : masks) {
        ASSERT_EQ(mask.samples.size(), 1U);
        ASSERT_EQ(mask.samples[0].size(), std::size_t{size.x} * size.y);
        const auto lit = std::ranges::count(mask.samples[0], std::byte{0});
        EXPECT_GT(lit, 0);
        EXPECT_LT(lit, std::int64_t{size.x} * size.y);
    }
    EXPECT_NE(masks[0].samples, masks[1].samples);
    EXPECT_EQ(draw(), picture);
    // The other light's is as it was when the first one is off.
    stage->lights()[0].on = false;
    const auto one = must(stage->draw_masks(view(), size));
    ASSERT_EQ(one.size(), 1U);
    EXPECT_NE(one[0].light.key, stage->lights()[0].entity.key());
    const auto& before = masks[masks[0].light.key == one[0].light.key ? 0 : 1];
    EXPECT_EQ(one[0].samples, before.samples);
    stage->options().samples = 4;
    const auto of_four = must(stage->draw_masks(view(), size));
    ASSERT_EQ(of_four.size(), 1U);
    ASSERT_EQ(of_four[0].samples.size(), 4U);
    EXPECT_NE(of_four[0].samples[0], of_four[0].samples[3]);
}

TEST_P(OnStage, dragging_a_light_finds_its_silhouettes_alone) {
    open("builtin:pillars");
    static_cast<void>(draw());
    const auto before = draw();
    EXPECT_EQ(stage->figures().shadows.pairs_redetected, 0U);
    const auto lantern = std::ranges::find_if(stage->lights(), [&](const panel::LightLine& l) {
        return !panel::is_directional(stage->shot().scene.registry, l.entity);
    });
    ASSERT_NE(lantern, stage->lights().end());
    const auto start = stage->shot().scene.registry.get<scene::LocalTransform>(lantern->entity);
    must(stage->move(lantern->entity, start,
                     glm::translate(glm::dmat4(1.0), glm::dvec3(1.5, 0.5, 0.0))));
    EXPECT_NE(draw(), before);
    EXPECT_GT(pairs_of(shadows::Reason::LightMoved), 0U);
    EXPECT_LE(stage->figures().shadows.pairs_redetected, stage->figures().shadows.casters);
    must(stage->move(lantern->entity, start, glm::dmat4(1.0)));
    EXPECT_EQ(draw(), before);
}

TEST_P(OnStage, dragging_a_caster_moves_its_shadow) {
    open("builtin:pillars");
    static_cast<void>(draw());
    const auto before = draw();
    // It has holes.
    std::optional<panel::Hit> knot;
    for (double x = 100.0; x < 220.0 && !knot; x += 5.0) {
        const auto hit = stage->pick(panel::ray_through(view(), {x, 100.0}, size));
        if (hit && stage->name_of(hit->entity) == "knot") knot = hit;
    }
    ASSERT_TRUE(knot);
    const auto start = stage->shot().scene.registry.get<scene::LocalTransform>(knot->entity);
    must(stage->move(knot->entity, start,
                     glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 1.0, 0.0))));
    EXPECT_NE(draw(), before);
    EXPECT_EQ(pairs_of(shadows::Reason::CasterMoved), stage->figures().shadows.pairs_redetected);
    EXPECT_LE(stage->figures().shadows.pairs_redetected, 2U);
}

// The probe says what the picture shows: where it says "in shadow", the stencil has a count.
TEST_P(OnStage, the_probe_and_the_stencil_agree) {
    open("builtin:pillars");
    for (std::size_t i = 1; i < stage->lights().size(); ++i) stage->lights()[i].on = false;
    static_cast<void>(draw());
    render::Renderer renderer =
        must(render::Renderer::create(device(), {.width = size.x, .height = size.y}));
    must(renderer.upload(stage->shot().scene));
    must(renderer.render({stage->shot().scene, view(), stage->draw_list()}));
    const auto counts = must(render::read_stencil(device(), renderer));
    int shadowed = 0;
    int lit = 0;
    int wrong = 0;
    for (unsigned y = 4; y < size.y; y += 6) {
        for (unsigned x = 4; x < size.x; x += 6) {
            const auto probe = must(stage->probe(panel::ray_through(view(), {x, y}, size)));
            if (!probe) continue;
            ASSERT_EQ(probe->answers.size(), 1U);
            if (probe->answers[0].faces_away) continue;
            const bool dark = probe->answers[0].exposure == shadows::Exposure::Shadowed;
            EXPECT_EQ(dark, probe->answers[0].surfaces > 0);
            const bool counted = counts[y * size.x + x] != std::byte{0};
            (dark ? shadowed : lit) += 1;
            wrong += dark != counted ? 1 : 0;
        }
    }
    EXPECT_GT(shadowed, 50);
    EXPECT_GT(lit, 50);
    // Pixels whose middle a shadow's edge passes.
    EXPECT_LE(wrong, (shadowed + lit) / 200);
}

TEST_P(OnStage, plays_what_the_scene_has) {
    open("builtin:walk");
    ASSERT_FALSE(stage->shot().scene.animations.empty());
    stage->play(scene::find_animations(stage->shot().scene));
    EXPECT_GT(stage->duration_s(), 0.0);
    must(stage->set_time(0.1));
    const auto early = draw();
    must(stage->set_time(0.4));
    EXPECT_NE(draw(), early);
    EXPECT_GT(pairs_of(shadows::Reason::MeshChanged), 0U);
    must(stage->set_time(0.1));
    EXPECT_EQ(draw(), early);
}

TEST_P(OnStage, a_skinned_figure_is_dragged_with_its_joints) {
    open("builtin:walk");
    const scene::Registry& registry = stage->shot().scene.registry;
    std::optional<scene::Entity> figure;
    registry.each<scene::Skin>([&](scene::Entity entity, const scene::Skin&) {
        if (!figure) figure = entity;
    });
    ASSERT_TRUE(figure);
    const scene::Bounds before = stage->bounds_of(*figure);
    const scene::Entity node = stage->handle_node(*figure);
    const auto start = stage->shot().scene.registry.get<scene::LocalTransform>(node);
    must(stage->move(node, start, glm::translate(glm::dmat4(1.0), glm::dvec3(0.5, 0.25, 0.0))));
    const scene::Bounds after = stage->bounds_of(*figure);
    EXPECT_NEAR(after.min.x - before.min.x, 0.5, 1e-5);
    EXPECT_NEAR(after.max.y - before.max.y, 0.25, 1e-5);
}

TEST_P(OnStage, a_ground_takes_the_shadow_and_goes_again) {
    open("builtin:open-shapes");
    const auto before = draw();
    stage->show_ground(true);
    EXPECT_TRUE(stage->has_ground());
    EXPECT_NE(draw(), before);
    stage->show_ground(false);
    EXPECT_EQ(draw(), before);
    const std::size_t materials = stage->shot().scene.materials.size();
    stage->show_ground(true);
    EXPECT_EQ(stage->shot().scene.materials.size(), materials) << "the one from before";
}

TEST_P(OnStage, who_picked_the_ground_learns_that_it_is_gone) {
    open("builtin:open-shapes");
    stage->show_ground(true);
    must(stage->set_time(0.0));
    static_cast<void>(draw());
    // Beyond whatever floor the scene has.
    const scene::Bounds& bounds = stage->shot().bounds;
    const auto hit =
        stage->pick({{bounds.min.x - 0.2 * bounds.diagonal(), bounds.max.y, bounds.center().z},
                     {0.0, -1.0, 0.0}});
    ASSERT_TRUE(hit);
    ASSERT_EQ(stage->name_of(hit->entity), "ground");
    EXPECT_TRUE(stage->is_there(hit->entity));
    stage->show_ground(false);
    EXPECT_FALSE(stage->is_there(hit->entity));
    stage->show_ground(true);
    EXPECT_FALSE(stage->is_there(hit->entity)) << "another one";
}

TEST_P(OnStage, the_probe_says_lit_of_lights_without_shadow) {
    open("builtin:pillars");
    static_cast<void>(draw());
    std::optional<panel::Ray> dark;
    std::size_t light = 0;
    for (unsigned y = 4; y < size.y && !dark; y += 6) {
        for (unsigned x = 4; x < size.x && !dark; x += 6) {
            const panel::Ray ray = panel::ray_through(view(), {x, y}, size);
            const auto probe = must(stage->probe(ray));
            if (!probe) continue;
            for (const panel::Probe::Answer& answer : probe->answers) {
                if (answer.exposure != shadows::Exposure::Shadowed) continue;
                dark = ray;
                light = answer.light;
            }
        }
    }
    ASSERT_TRUE(dark);
    const auto answer = [&] {
        static_cast<void>(draw());
        const auto probe = must(stage->probe(*dark));
        return *std::ranges::find(probe->answers, light, &panel::Probe::Answer::light);
    };
    EXPECT_GT(answer().surfaces, 0U);
    stage->lights()[light].casts = false;
    EXPECT_EQ(answer().exposure, shadows::Exposure::Lit);
    EXPECT_EQ(answer().surfaces, 0U);
    stage->lights()[light].casts = true;
    stage->options().max_shadowed_lights = 0;
    EXPECT_EQ(answer().exposure, shadows::Exposure::Lit);
    stage->options().max_shadowed_lights.reset();
    EXPECT_EQ(answer().exposure, shadows::Exposure::Shadowed);
}

TEST_P(OnStage, goes_on_with_another_device) {
    open("builtin:pillars");
    EXPECT_FALSE(stage->has_drawn());
    const auto before = draw();
    EXPECT_TRUE(stage->has_drawn());
    stage->drop_device();
    EXPECT_FALSE(stage->has_drawn());
    const auto other = must(gnomon::test::open_device(GetParam()));
    must(stage->set_device(other->device, size));
    must(stage->draw(view(), size));
    EXPECT_EQ(must(other->device.read_texture(stage->picture())), before);
    // Without drop_device() between.
    must(stage->set_device(device(), size));
    EXPECT_FALSE(stage->has_drawn());
    EXPECT_EQ(draw(), before);
    stage->shadows_changed();
    EXPECT_FALSE(stage->has_drawn());
}

INSTANTIATE_TEST_SUITE_P(Devices, OnStage, testing::ValuesIn(gnomon::test::drawing_devices()),
                         gnomon::test::device_case_name);

}  // namespace
}  // namespace gnomon::cli
