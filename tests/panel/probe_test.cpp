// SPDX-License-Identifier: MIT
//
// The probe's answers, on a floor with a box over it.
#include <gnomon/panel/probe.hpp>

#include <gtest/gtest.h>

#include <memory>

#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/scene/transforms.hpp>

namespace gnomon::panel {
namespace {

class Probes : public testing::Test {
protected:
    void SetUp() override {
        scene.materials.emplace_back();
        add("floor", scene::make_plane(20.0F, 20.0F), {0, 0, 0}, false);
        add("box", scene::make_box({1, 1, 1}), {0, 2, 0}, true);
        const scene::Entity lamp = scene.create_node("lamp", {.translation = {0, 6, 0}});
        scene.registry.emplace<scene::PointLight>(lamp, glm::vec3(1.0F), 10.0F, 8.0);
        const scene::Entity low = scene.create_node("low", {.translation = {0, -1, 0}});
        scene.registry.emplace<scene::PointLight>(low, glm::vec3(1.0F), 10.0F, 1.5);
        scene::update_world_transforms(scene.registry);
        lights = lights_of(scene);
        const auto casters = adapter.casters(scene);
        ASSERT_TRUE(casters);
        queries.update(*casters);
    }
    void add(const char* name, scene::Mesh mesh, const glm::dvec3& at, bool casts) {
        const scene::Entity node = scene.create_node(name, {.translation = at});
        scene.registry.emplace<scene::MeshInstance>(
            node, std::make_shared<const scene::Mesh>(std::move(mesh)));
        scene.registry.emplace<scene::Receiver>(node);
        if (casts) scene.registry.emplace<scene::Caster>(node);
    }
    /// Of the point of the floor that a ray from above meets there.
    Probe probe(double x, double z, std::span<const scene::Entity> unshadowed = {}) {
        const auto hit = picker.pick(scene, {{x, 1.0, z}, {0, -1, 0}});
        EXPECT_TRUE(hit);
        return probe_at(*hit, scene.registry, queries, lights, unshadowed, 20.0);
    }
    scene::Scene scene;
    scene::ShadowAdapter adapter;
    shadows::ShadowQueries queries;
    Picker picker;
    std::vector<LightLine> lights;
};

TEST_F(Probes, tell_lit_from_shadow_and_what_is_between) {
    const Probe under = probe(0.2, 0.1);
    ASSERT_EQ(under.answers.size(), 2U);
    EXPECT_EQ(under.answers[0].exposure, shadows::Exposure::Shadowed);
    EXPECT_EQ(under.answers[0].surfaces, 2U);
    EXPECT_FALSE(under.answers[0].faces_away);
    EXPECT_TRUE(under.answers[1].faces_away) << "the floor is seen from above";
    const Probe beside = probe(3.0, 0.0);
    EXPECT_EQ(beside.answers[0].exposure, shadows::Exposure::Lit);
    EXPECT_EQ(beside.answers[0].surfaces, 0U);
    EXPECT_EQ(beside.answers[1].exposure, shadows::Exposure::OutOfRange);
}

TEST_F(Probes, leave_out_lights_that_are_off) {
    lights[0].on = false;
    const Probe under = probe(0.2, 0.1);
    ASSERT_EQ(under.answers.size(), 1U);
    EXPECT_EQ(under.answers[0].light, 1U);
}

TEST_F(Probes, say_lit_of_lights_without_shadow) {
    const std::vector<scene::Entity> unshadowed{lights[0].entity};
    for (const bool by_frame : {false, true}) {
        lights[0].casts = by_frame;
        const Probe under = by_frame ? probe(0.2, 0.1, unshadowed) : probe(0.2, 0.1);
        EXPECT_EQ(under.answers[0].exposure, shadows::Exposure::Lit);
        EXPECT_EQ(under.answers[0].surfaces, 0U);
    }
}

}  // namespace
}  // namespace gnomon::panel
