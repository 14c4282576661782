// SPDX-License-Identifier: MIT
//
// Which pairs the shadow system leaves to the GPU, what it does for them as things move, and when
// it takes them back.
#include <gnomon/shadows/edge_quads.hpp>
#include <gnomon/shadows/shadow_system.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;

View perspective() {
    return {look_at({0, 5, 30}, {0, 0, 0}, {0, 1, 0}), infinite_perspective(1, 1.5, 0.1)};
}
View parallel() {
    return {look_at({0, 5, 30}, {0, 0, 0}, {0, 1, 0}), orthographic(20, 15, 0.1, 100),
            ProjectionKind::Orthographic};
}

struct World {
    ShadowSystem system;
    std::shared_ptr<const ShadowMesh> mesh;
    glm::dvec4 light{3, 7, 2, 1};
    glm::dmat4 pose{1.0};
    NearCaps near_caps = NearCaps::Facing;

    World(std::shared_ptr<const ShadowMesh> m, const SystemOptions& options)
        : system(std::move(ShadowSystem::create(options)).value()), mesh(std::move(m)) {}

    DrawList frame(const View& view = perspective()) {
        auto frame = system.begin_frame();
        frame.caster({.key = 5, .mesh = mesh, .world_from_local = pose, .near_caps = near_caps});
        frame.light({.key = 1, .position_world = light});
        return std::move(frame).finish(view);
    }
};

std::uint64_t count(const DrawList& list, Reason reason) {
    return list.stats.reasons[static_cast<std::size_t>(reason)];
}

std::vector<std::uint32_t> sorted_indices(const VolumeDraw& draw) {
    std::vector<std::uint32_t> indices = draw.volume->indices;
    std::ranges::sort(indices);
    return indices;
}

constexpr std::array<std::string_view, 2> both{"gpu_quads", "gpu_quads_float"};

TEST(QuadPairs, AreClosedAndLitFromOutside) {
    for (const std::string_view name : both) {
        World world(test::build(test::sphere(8, 9)), {.silhouette = name});
        const DrawList list = world.frame();
        EXPECT_EQ(list.stats.silhouette, name);
        EXPECT_EQ(list.stats.quad_pairs, 1U);
        ASSERT_EQ(list.draws.size(), 1U);
        ASSERT_TRUE(list.draws[0].quads);
        EXPECT_EQ(list.draws[0].quads->light.position, glm::vec4(3, 7, 2, 1));
        EXPECT_EQ(list.draws[0].quads->bits != nullptr, name == "gpu_quads");
        EXPECT_TRUE(list.draws[0].volume->empty());
    }
}

TEST(QuadPairs, OthersAreTheCpus) {
    const auto ball = test::build(test::sphere(8, 9));
    for (const std::string_view name : both) {
        const auto quads = [&](World& world) {
            const DrawList list = world.frame();
            EXPECT_EQ(list.draws.size(), 1U);
            EXPECT_EQ(list.draws[0].quads.has_value(), list.stats.quad_pairs == 1);
            EXPECT_EQ(list.draws[0].volume->indices.empty(), list.stats.quad_pairs == 1);
            EXPECT_EQ(list.stats.pairs_redetected + list.stats.pairs_reused, 1U);
            return list.stats.quad_pairs;
        };
        World open(test::build(test::sheet(3)), {.silhouette = name});
        EXPECT_EQ(quads(open), 0U) << "open";
        World hollow(test::build(test::inside_out(test::box())), {.silhouette = name});
        EXPECT_EQ(quads(hollow), 0U) << "inside out";

        World deformed(ball->deformed(test::sphere(8, 9).positions).value(), {.silhouette = name});
        EXPECT_EQ(quads(deformed), 0U) << "its textures would be new in each frame";

        World world(ball, {.silhouette = name});
        EXPECT_EQ(quads(world), 1U);
        world.light = {0.1, 0.2, 0.3, 1};
        EXPECT_EQ(quads(world), 0U) << "the light is in the mesh";
        world.light = {3, 7, 2, 1};
        EXPECT_EQ(quads(world), 1U) << "and out of it again";
        world.pose = glm::scale(glm::dmat4(1.0), glm::dvec3(1, 0, 1));
        EXPECT_EQ(quads(world), 0U) << "flattened";
    }
}

// Byte for byte what the CPU would have drawn, at every step; and no work where none is due.
TEST(QuadPairs, FollowAMotion) {
    GNOMON_RANDOM(random);
    for (int motion = 0; motion < 40; ++motion) {
        const auto mesh = test::build(motion % 2 == 0 ? test::sphere(7, 11) : test::torus(6, 9));
        World quads(mesh, {.silhouette = "gpu_quads"});
        World plain(mesh, {.silhouette = "brute_force", .caps = CapOptions::plain()});
        std::shared_ptr<const FaceBits> last;
        std::uint64_t revision = 0;
        for (int step = 0; step < 40; ++step) {
            if (random.chance(0.1))
                quads.light = {5.0 * random.unit_vector(), random.integer(0, 1)};
            if (random.chance(0.8)) {
                quads.light += glm::dvec4(
                    std::pow(10.0, random.uniform(-7.0, 0.0)) * random.unit_vector(), 0.0);
            }
            if (random.chance(0.1)) {
                quads.near_caps =
                    quads.near_caps == NearCaps::Facing ? NearCaps::Averted : NearCaps::Facing;
            }
            plain.light = quads.light;
            plain.near_caps = quads.near_caps;
            const View view = random.chance(0.5) ? perspective() : parallel();
            const DrawList actual = quads.frame(view);
            const DrawList expected = plain.frame(view);
            ASSERT_EQ(actual.stats.reasons, expected.stats.reasons) << "step " << step;
            ASSERT_EQ(actual.stats.pairs_redetected, expected.stats.pairs_redetected);
            ASSERT_EQ(actual.draws.size(), expected.draws.size());
            if (actual.draws.empty()) continue;
            const VolumeDraw& draw = actual.draws[0];
            ASSERT_EQ(draw.extrusion.offset, expected.draws[0].extrusion.offset) << step;
            ASSERT_EQ(draw.extrusion.scale, expected.draws[0].extrusion.scale) << step;
            if (!draw.quads) continue;
            const bool one_far_point =
                draw.quads->light.is_directional() && draw.extrusion.offset.w == 0.0F;
            Volume volume =
                quad_volume(*mesh, *draw.quads->bits, draw.quads->near_caps, one_far_point);
            std::vector<std::uint32_t> wanted = expected.draws[0].volume->indices;
            std::ranges::sort(volume.indices);
            std::ranges::sort(wanted);
            ASSERT_EQ(volume.indices, wanted) << "step " << step;
            ASSERT_EQ(draw.quads->bits == last, draw.revision == revision) << "step " << step;
            last = draw.quads->bits;
            revision = draw.revision;
        }
    }
}

TEST(QuadPairs, WhoseShaderDecidesCostNothingWhileTheLightIsOutside) {
    World world(test::build(test::sphere(20, 30)),
                {.silhouette = "gpu_quads_float", .layer_bound = LayerBound::Promised});
    world.light = {6, 0, 0, 1};
    DrawList list = world.frame();
    const std::uint64_t revision = list.draws[0].revision;
    std::uint64_t list_revision = list.revision;
    EXPECT_EQ(world.frame().revision, list_revision) << "nothing moved";
    EXPECT_EQ(list.stats.detection.faces_tested, 0U);
    for (int step = 1; step <= 20; ++step) {
        const double angle = 0.02 * step;
        world.light = {6.0 * std::cos(angle), 6.0 * std::sin(angle), 0, 1};
        list = world.frame();
        ASSERT_TRUE(list.draws[0].quads);
        EXPECT_EQ(count(list, Reason::WithinMargin), 1U);
        EXPECT_EQ(list.stats.detection.faces_tested, 0U);
        EXPECT_EQ(list.draws[0].revision, revision);
        EXPECT_GT(list.revision, list_revision) << "the light is another";
        list_revision = list.revision;
        EXPECT_EQ(list.draws[0].quads->light.position, glm::vec4(world.light));
    }
    world.light = {0, 1, 0, 0};
    EXPECT_EQ(world.frame().stats.detection.faces_tested, 0U);
    world.light = {1, -3, 2, 0};
    EXPECT_EQ(count(world.frame(), Reason::WithinMargin), 1U) << "any sun will do";
}

// A pair that had to be taken back is exact from then on, however small the steps.
TEST(QuadPairs, ThatWereTakenBackAreExact) {
    const auto mesh = test::build(test::sphere(20, 30));
    for (const std::string_view name : both) {
        World taken(mesh, {.silhouette = name, .max_layers = 1});
        World plain(mesh, {.silhouette = "brute_force", .max_layers = 1});
        for (int step = 0; step < 200; ++step) {
            const double angle = 0.002 * step;
            taken.light = {6.0 * std::cos(angle), 6.0 * std::sin(angle), 0.3, 1};
            plain.light = taken.light;
            const DrawList actual = taken.frame();
            const DrawList expected = plain.frame();
            ASSERT_EQ(actual.stats.quad_pairs, 0U);
            ASSERT_EQ(actual.draws.size(), expected.draws.size());
            for (std::size_t i = 0; i < actual.draws.size(); ++i) {
                ASSERT_EQ(sorted_indices(actual.draws[i]), sorted_indices(expected.draws[i]))
                    << name << ", step " << step;
            }
        }
    }
}

TEST(QuadPairs, StayWhereTheHostPromisesFewLayers) {
    const auto mesh = test::build(test::sphere(20, 30));
    for (const std::string_view name : both) {
        World proved(mesh, {.silhouette = name});
        EXPECT_EQ(proved.frame().stats.quad_pairs, 0U) << "600 of 1,140 faces: too coarse a bound";
        World promised(mesh, {.silhouette = name, .layer_bound = LayerBound::Promised});
        const DrawList list = promised.frame();
        EXPECT_EQ(list.stats.quad_pairs, 1U);
        EXPECT_EQ(list.lights[0].batches, 1U);
        EXPECT_EQ(list.stats.stencil_batches, 1U);
    }
}

}  // namespace
}  // namespace gnomon::shadows
