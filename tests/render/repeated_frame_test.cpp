// SPDX-License-Identifier: MIT
//
// A frame whose commands would be the last one's is not recorded again, and looks as if it were.
#include <gnomon/render/renderer.hpp>

#include <gtest/gtest.h>

#include <gnomon/scene/shadow_adapter.hpp>

#include "tests/rows/picture.hpp"
#include "tests/rows/rows.hpp"
#include "tests/shadows/random_meshes.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {
namespace {

// One system's draw lists, drawn by a renderer that may repeat itself and by one that never does.
class RepeatedFrame : public DeviceTest {
protected:
    void start(const char* name) {
        const auto found = std::ranges::find(rows(), std::string_view(name), &Row::name);
        setting_ = found->make();
        system_ = *shadows::ShadowSystem::create({.receivers = shadows::Receivers::Submitted});
        for (auto* renderer : {&repeating_, &recording_}) {
            *renderer = must(
                render::Renderer::create(device(), {.width = row_width, .height = row_height}));
            ASSERT_TRUE((*renderer)->upload(setting_.scene));
        }
    }

    // Whether it was recorded.
    bool draw() {
        auto frame = system_->begin_frame();
        EXPECT_TRUE(adapter_.submit(setting_.scene, frame));
        const shadows::DrawList& list = std::move(frame).finish(setting_.view);
        EXPECT_TRUE(repeating_->render({.scene = setting_.scene,
                                        .view = setting_.view,
                                        .shadows = list,
                                        .environment = environment_}));
        const auto reads = [](std::size_t) { return Status(); };
        EXPECT_TRUE(recording_->render({.scene = setting_.scene,
                                        .view = setting_.view,
                                        .shadows = list,
                                        .after_light = reads,
                                        .environment = environment_}));
        EXPECT_TRUE(recording_->times().recorded);
        EXPECT_EQ(must(device().read_texture(repeating_->picture())),
                  must(device().read_texture(recording_->picture())));
        return repeating_->times().recorded;
    }

    template <class Component>
    std::vector<scene::Entity> all() {
        std::vector<scene::Entity> entities;
        setting_.scene.registry.each<Component>(
            [&](scene::Entity entity, const auto&) { entities.push_back(entity); });
        return entities;
    }

    glm::dmat4& pose(scene::Entity entity) {
        return setting_.scene.registry.get<scene::WorldTransform>(entity).world_from_local;
    }

    Setting setting_;
    render::Environment environment_;
    std::optional<shadows::ShadowSystem> system_;
    scene::ShadowAdapter adapter_;
    std::optional<render::Renderer> repeating_, recording_;
};

TEST_P(RepeatedFrame, is_submitted_again_while_nothing_moves) {
    start("pillars_two_lights");
    EXPECT_TRUE(draw());
    EXPECT_FALSE(draw());
    EXPECT_FALSE(draw());
    ASSERT_TRUE(repeating_->upload(setting_.scene));
    EXPECT_TRUE(draw()) << "materials may be others";
    EXPECT_FALSE(draw());
}

TEST_P(RepeatedFrame, looks_as_if_it_were_recorded_whatever_changes) {
    GNOMON_RANDOM(random);
    start("pillars_two_lights");
    const auto casters = all<scene::Caster>();
    int repeated = 0;
    for (int step = 0; step < 24; ++step) {
        const auto some = [&](const auto& entities) {
            return entities[random.below(static_cast<std::uint32_t>(entities.size()))];
        };
        switch (random.below(7)) {
            case 0: setting_.view.view_from_world[3] += glm::dvec4(random.in_cube(0.2), 0.0); break;
            case 1: pose(some(casters))[3] += glm::dvec4(random.in_cube(0.5), 0.0); break;
            case 2: {
                const auto lights = all<scene::PointLight>();
                if (!lights.empty()) pose(some(lights))[3] += glm::dvec4(random.in_cube(0.5), 0.0);
                break;
            }
            case 3: {
                auto& registry = setting_.scene.registry;
                const scene::Entity caster = some(casters);
                if (registry.has<scene::Receiver>(caster)) {
                    registry.remove<scene::Receiver>(caster);
                } else {
                    registry.emplace<scene::Receiver>(caster);
                }
                break;
            }
            case 4:
                for (const scene::Entity light : all<scene::PointLight>()) {
                    setting_.scene.registry.get<scene::PointLight>(light).intensity *= 0.8F;
                }
                break;
            case 5:
                environment_.background.r += 0.1F;
                environment_.sky.g += 0.1F;
                environment_.exposure = environment_.exposure.value_or(0.2F) * 1.2F;
                break;
            default: break;
        }
        repeated += draw() ? 0 : 1;
        if (HasFailure()) FAIL() << "step " << step;
    }
    EXPECT_GT(repeated, 0);
    EXPECT_LT(repeated, 24);
}

INSTANTIATE_TEST_SUITE_P(Devices, RepeatedFrame, testing::ValuesIn(drawing_devices()),
                         device_case_name);

}  // namespace
}  // namespace gnomon::test
