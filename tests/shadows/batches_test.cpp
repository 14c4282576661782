// SPDX-License-Identifier: MIT
//
// Which lights the shadow system splits into batches, and that it works them out once.
#include <gnomon/shadows/shadow_system.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/shadows/layer_bound.hpp>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

View above() {
    View view;
    view.view_from_world = look_at({0, 40, 60}, {0, 0, 0}, {0, 1, 0});
    view.clip_from_view = infinite_perspective(0.8, 1.5, 0.01);
    return view;
}

struct World {
    ShadowSystem system;
    std::shared_ptr<const ShadowMesh> mesh = test::build(test::box());
    std::vector<glm::dmat4> poses;
    glm::dvec4 light{0.0, 1.0, 0.0, 0.0};

    explicit World(SystemOptions options = {})
        : system((options.fill = FillOptions::none(), *ShadowSystem::create(options))) {}

    DrawList frame() {
        auto frame = system.begin_frame();
        for (std::size_t i = 0; i < poses.size(); ++i) {
            frame.caster({.key = i, .mesh = mesh, .world_from_local = poses[i]});
        }
        frame.light({.key = 1, .position_world = light});
        return std::move(frame).finish(above());
    }
};

glm::dmat4 at(double x, double y, double z) {
    return glm::translate(glm::dmat4(1.0), glm::dvec3(x, y, z));
}

std::vector<std::uint32_t> batches_of(const DrawList& list) {
    std::vector<std::uint32_t> batches;
    for (const VolumeDraw& draw : list.draws) batches.push_back(draw.batch);
    return batches;
}

TEST(Batches, ACityIsNotSplit) {
    for (const glm::dvec4& light : {glm::dvec4(0.3, 1.0, 0.2, 0.0), glm::dvec4(3.0, 30.0, 2.0, 1.0),
                                    glm::dvec4(3.0, 2.0, 3.0, 1.0)}) {
        World world;
        world.light = light;
        for (int x = 0; x < 40; ++x) {
            for (int z = 0; z < 40; ++z) world.poses.push_back(at(6.0 * x - 120, 0, 6.0 * z - 120));
        }
        const DrawList list = world.frame();
        EXPECT_EQ(list.lights[0].batches, 1U);
        EXPECT_EQ(list.draws.size(), 1600U);
        EXPECT_EQ(list.stats.stencil_batches, 1U);
        EXPECT_EQ(list.stats.split_lights, 0U);
    }
}

TEST(Batches, ATowerOfCastersIsSplitAndEachBatchIsWithinTheLimit) {
    for (const int count : {127, 255, 256, 1000}) {
        for (const double w : {0.0, 1.0}) {
            World world;
            world.light = {w == 0.0 ? 1e-5 : 0.3, w == 0.0 ? 1.0 : 9000.0, w == 0.0 ? 2e-5 : 0.2,
                           w};
            for (int i = 0; i < count; ++i) world.poses.push_back(at(0, 3.0 * i, 0));
            const DrawList list = world.frame();
            ASSERT_EQ(list.draws.size(), static_cast<std::size_t>(count));
            EXPECT_EQ(list.lights[0].batches > 1, count > 255);
            EXPECT_LE(list.lights[0].batches, static_cast<std::uint32_t>(count) / 127 + 1);
            EXPECT_EQ(list.stats.stencil_batches, list.lights[0].batches);
            const auto batches = batches_of(list);
            EXPECT_TRUE(std::is_sorted(batches.begin(), batches.end()));
            EXPECT_EQ(batches.back() + 1, list.lights[0].batches);
            for (std::uint32_t b = 0; list.lights[0].batches > 1 && b <= batches.back(); ++b) {
                EXPECT_LE(std::count(batches.begin(), batches.end(), b), 127);
                EXPECT_GE(std::count(batches.begin(), batches.end(), b), 1);
            }
        }
    }
}

TEST(Batches, TowersSideBySideShareBatches) {
    World world;
    world.light = {0.3, 9000.0, 0.2, 1.0};
    for (int x = 0; x < 5; ++x) {
        for (int i = 0; i < 300; ++i) world.poses.push_back(at(20.0 * x, 3.0 * i, 0));
    }
    EXPECT_LE(world.frame().lights[0].batches, 4U);
}

test::Triangles many_sheets(int count) {
    test::Triangles mesh;
    for (int i = 0; i < count; ++i) {
        mesh =
            test::merged(std::move(mesh),
                         test::moved(test::sheet(2), {0.0F, 0.01F * static_cast<float>(i), 0.0F}));
    }
    return mesh;
}

TEST(Batches, OneMeshBecomesParts) {
    World world;
    world.mesh = test::build(many_sheets(300));
    world.poses = {at(0, 0, 0), at(50, 0, 0)};
    const DrawList list = world.frame();
    EXPECT_EQ(list.draws.size(), 6U);
    EXPECT_EQ(list.stats.split_lights, 1U);
    std::set<std::uint64_t> revisions;
    for (const VolumeDraw& draw : list.draws) {
        revisions.insert(draw.revision);
        EXPECT_LE(layer_bound(*draw.mesh, *draw.volume, {glm::dmat4(1.0), world.light}), 127U);
    }
    EXPECT_EQ(revisions.size(), 6U);
}

TEST(Batches, WhatDidNotMoveIsNotSplitAgain) {
    World world;
    world.mesh = test::build(many_sheets(300));
    world.poses = {at(0, 0, 0), at(0, 5, 0)};
    const DrawList first = world.frame();
    const DrawList second = world.frame();
    ASSERT_EQ(second.draws.size(), first.draws.size());
    for (std::size_t i = 0; i < first.draws.size(); ++i) {
        EXPECT_EQ(second.draws[i].revision, first.draws[i].revision);
        EXPECT_EQ(second.draws[i].volume, first.draws[i].volume);
        EXPECT_EQ(second.draws[i].batch, first.draws[i].batch);
    }
    world.poses[1] = at(0, 5, 100);
    const DrawList third = world.frame();
    EXPECT_EQ(third.lights[0].batches, 3U) << "side by side now";
    world.poses.pop_back();
    world.mesh = test::build(many_sheets(200));
    const DrawList fourth = world.frame();
    EXPECT_EQ(fourth.lights[0].batches, 1U);
    EXPECT_EQ(fourth.draws.size(), 1U);
}

TEST(Batches, OfVolumesThatTakeTheFinestBoundDoNotDependOnEarlierFrames) {
    World before;
    before.mesh = test::build(many_sheets(150));
    std::vector<std::uint32_t> batches;
    // One hides the other or not; a third comes and goes.
    for (const double x : {50.0, 0.1, 0.3, 50.0, 0.2}) {
        before.poses = {at(0, 0, 0), at(x, 5, 0)};
        if (x < 0.25) before.poses.push_back(at(0.5 * x, 10, 0));
        World anew;
        anew.mesh = before.mesh;
        anew.poses = before.poses;
        const DrawList list = before.frame();
        const DrawList expected = anew.frame();
        ASSERT_EQ(list.draws.size(), expected.draws.size());
        for (std::size_t i = 0; i < list.draws.size(); ++i) {
            EXPECT_EQ(list.draws[i].batch, expected.draws[i].batch) << x;
        }
        batches.push_back(list.lights[0].batches);
    }
    EXPECT_EQ(batches[0], 1U) << "side by side";
    EXPECT_GT(batches[1], 1U);
    EXPECT_GT(batches[2], 1U);
    EXPECT_EQ(batches[3], 1U);
    EXPECT_EQ(batches[4], batches[1]);
}

TEST(Batches, ALightThatCreepsWithinTheMarginIsBoundedAnew) {
    // Seen from straight above the two stacks lie side by side; a step of the light that changes no
    // face's side brings one behind the other.
    World world({.max_layers = 5});
    world.mesh =
        test::build(test::merged(many_sheets(4), test::moved(many_sheets(4), {2.1F, 40.0F, 0.0F})));
    world.poses = {at(0, 0, 0)};
    EXPECT_EQ(world.frame().lights[0].batches, 1U);
    world.light = {0.05, 1.0, 0.0, 0.0};
    const DrawList list = world.frame();
    EXPECT_EQ(list.stats.reasons[static_cast<std::size_t>(Reason::WithinMargin)], 1U);
    EXPECT_EQ(list.lights[0].batches, 2U);
}

TEST(Batches, TheLimitIsWhatEightBitsCount) {
    EXPECT_TRUE(ShadowSystem::create({.max_layers = 255}));
    for (const std::uint32_t limit : {0U, 256U}) {
        const auto refused = ShadowSystem::create({.max_layers = limit});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::InvalidInput);
        EXPECT_NE(refused.error().message.find(std::to_string(limit)), std::string::npos);
    }
}

}  // namespace
}  // namespace gnomon::shadows
