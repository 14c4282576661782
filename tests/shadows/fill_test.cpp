// SPDX-License-Identifier: MIT
//
// What a ShadowSystem leaves out because nothing can be seen of it, and that it comes back.
#include <gnomon/shadows/shadow_system.hpp>

#include <map>

#include <gtest/gtest.h>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;

glm::dmat4 at(const glm::dvec3& place) {
    glm::dmat4 pose(1.0);
    pose[3] = glm::dvec4(place, 1.0);
    return pose;
}

View looking(const glm::dvec3& eye, const glm::dvec3& target) {
    return {.view_from_world = look_at(eye, target, {0, 1, 0}),
            .clip_from_view = infinite_perspective(0.8, 1.5, 0.1)};
}

class Fill : public testing::Test {
protected:
    // A ground of 40 m, boxes on it, a sun from above.
    Fill() {
        for (int i = -2; i <= 2; ++i) {
            casters_.push_back({.key = static_cast<std::uint64_t>(i + 10),
                                .mesh = box_,
                                .world_from_local = at({6.0 * i, 1.0, 0.0})});
        }
    }
    const DrawList& frame(ShadowSystem& system, const View& view) {
        auto frame = system.begin_frame();
        for (const Caster& caster : casters_) {
            frame.caster(caster);
            if (!frame.takes_receivers()) continue;
            frame.receiver(
                {.key = caster.key,
                 .bounds = {caster.world_from_local, glm::dvec3(caster.mesh->bounds_min()),
                            glm::dvec3(caster.mesh->bounds_max())}});
        }
        frame.light(light_);
        if (frame.takes_receivers()) {
            frame.receiver({.key = 1, .bounds = {glm::dmat4(1.0), {-20, -0.1, -20}, {20, 0, 20}}});
        }
        return std::move(frame).finish(view);
    }
    static std::uint64_t count(const DrawList& list, Reason reason) {
        return list.stats.reasons[static_cast<std::size_t>(reason)];
    }
    static ShadowSystem make(const FillOptions& fill, Receivers receivers = Receivers::Submitted) {
        return *ShadowSystem::create({.receivers = receivers, .fill = fill});
    }

    std::shared_ptr<const ShadowMesh> box_ = test::build(test::box());
    std::vector<Caster> casters_;
    Light light_{.key = 1, .position_world = {0.2, 1.0, 0.1, 0.0}};
    View all_ = looking({0, 12, 40}, {0, 0, 0});
};

TEST_F(Fill, VolumesEndBehindTheGround) {
    ShadowSystem system = make({});
    const DrawList& list = frame(system, all_);
    ASSERT_EQ(list.draws.size(), 5U);
    EXPECT_EQ(list.stats.pairs_clamped, 5U);
    for (const VolumeDraw& draw : list.draws) {
        EXPECT_EQ(draw.volume->made_with.far_vertices, FarVertices::OnPlane);
        EXPECT_FALSE(draw.far_caps) << "seen from above, nothing lies behind them";
        for (const glm::vec3& p : draw.mesh->positions()) {
            const glm::dvec4 far = draw.world_from_far * glm::dvec4(glm::dvec3(p), 1.0);
            EXPECT_LT(far.y / far.w, -0.1);
            EXPECT_GT(far.y / far.w, -0.2);
        }
    }
    EXPECT_TRUE(list.lights[0].clear_background);
    // From below the ground they would be in front of it.
    const DrawList& below = frame(system, looking({0, -8, 30}, {0, 0, 0}));
    EXPECT_FALSE(below.lights[0].clear_background) << "all have ends";
    for (const VolumeDraw& draw : below.draws) EXPECT_TRUE(draw.far_caps);
    ShadowSystem plain = make(FillOptions::none());
    EXPECT_EQ(frame(plain, all_).stats.pairs_clamped, 0U);
    EXPECT_EQ(frame(plain, all_).draws[0].bounds, ScreenBounds{});
    EXPECT_EQ(frame(plain, all_).draws[0].depth, DepthBounds{});
    EXPECT_NE(frame(system, all_).draws[0].depth, DepthBounds{});
}

// A shadow that nothing ends goes on to the far plane, also where rays are parallel.
TEST_F(Fill, DepthBoundsOfEndlessShadowsReachTheFarPlane) {
    ShadowSystem system = make({}, Receivers::Anywhere);
    for (const glm::dmat4& clip_from_view :
         {orthographic(20.0, 12.0, 0.5, 80.0), finite_perspective(0.8, 1.5, 0.1, 80.0),
          infinite_perspective(0.8, 1.5, 0.1)}) {
        View view = all_;
        view.clip_from_view = clip_from_view;
        view.projection = clip_from_view[3][3] == 1.0   ? ProjectionKind::Orthographic
                          : clip_from_view[2][2] != 0.0 ? ProjectionKind::FinitePerspective
                                                        : ProjectionKind::InfinitePerspective;
        const DrawList& list = frame(system, view);
        ASSERT_EQ(list.draws.size(), 5U);
        for (const VolumeDraw& draw : list.draws) {
            EXPECT_EQ(draw.depth.min, 0.0F);
            EXPECT_GT(draw.depth.max, 0.0F);
            EXPECT_LT(draw.depth.max, 1.0F);
        }
    }
}

TEST_F(Fill, WhatIsOutOfViewIsNotDetectedUntilItIsSeen) {
    ShadowSystem system = make({});
    const View away = looking({0, 12, 40}, {0, 12, 80});
    EXPECT_EQ(count(frame(system, away), Reason::OutOfView), 5U);
    EXPECT_EQ(frame(system, away).draws.size(), 0U);
    EXPECT_EQ(frame(system, away).stats.pairs_culled, 5U);
    const DrawList& seen = frame(system, all_);
    EXPECT_EQ(count(seen, Reason::New), 5U);
    EXPECT_EQ(seen.draws.size(), 5U);
    // A camera that turns away and back costs no detection.
    EXPECT_EQ(frame(system, away).stats.pairs_hidden, 5U);
    for (const VolumeDraw& draw : frame(system, away).draws) EXPECT_TRUE(draw.bounds.empty());
    EXPECT_TRUE(frame(system, away).lights[0].bounds.empty());
    EXPECT_EQ(frame(system, all_).stats.pairs_redetected, 0U);
    EXPECT_EQ(frame(system, all_).stats.pairs_hidden, 0U);
    // What moves meanwhile is detected when it comes into view.
    casters_[2].world_from_local =
        at({0.0, 1.0, 1.0}) * glm::dmat4(glm::dmat3(0, 1, 0, 1, 0, 0, 0, 0, -1));
    const DrawList& moved = frame(system, away);
    EXPECT_EQ(moved.stats.pairs_redetected, 0U);
    EXPECT_EQ(count(moved, Reason::OutOfView), 1U);
    EXPECT_EQ(moved.draws.size(), 4U);
    EXPECT_EQ(frame(system, all_).stats.pairs_redetected, 1U);
    EXPECT_EQ(system.memory().receivers > 0, true);
}

TEST_F(Fill, WhatMovesWithItsLightOutOfViewKeepsItsVolume) {
    ShadowSystem system = make({});
    light_.position_world = {0, 9, 0, 1};
    (void)frame(system, all_);
    const View away = looking({0, 12, 40}, {0, 12, 80});
    for (Caster& caster : casters_) caster.world_from_local[3].x += 0.5;
    light_.position_world.x += 0.5;
    const DrawList& list = frame(system, away);
    EXPECT_EQ(list.stats.pairs_redetected, 0U);
    EXPECT_EQ(count(list, Reason::Unchanged), 5U);
    EXPECT_EQ(list.stats.pairs_hidden, 5U);
}

TEST_F(Fill, AShadowThatReachesNothingIsNotMade) {
    ShadowSystem system = make({});
    const View view = looking({60, 12, 40}, {60, 5, 0});
    // Over the edge of the ground, and alone.
    auto frame = system.begin_frame();
    const Caster bird{.key = 1, .mesh = box_, .world_from_local = at({60, 10, 0})};
    frame.caster(bird);
    frame.light(light_);
    frame.receiver({.key = 1, .bounds = {glm::dmat4(1.0), {-20, -0.1, -20}, {20, 0, 20}}});
    EXPECT_EQ(count(std::move(frame).finish(view), Reason::ReachesNothing), 1U);
    // A ground comes under it, in a frame in which nothing else changes.
    auto more = system.begin_frame(Submission::Delta);
    more.receiver({.key = 2, .bounds = {at({60, 0, 0}), {-20, -0.1, -20}, {20, 0, 20}}});
    EXPECT_EQ(count(std::move(more).finish(view), Reason::New), 1U);
    auto less = system.begin_frame(Submission::Delta);
    less.remove_receiver(2);
    const DrawList& list = std::move(less).finish(view);
    EXPECT_EQ(list.stats.pairs_hidden, 1U) << "kept for when it comes back";
    // Who does not cull it draws it to the end of itself.
    ShadowSystem all = make({.cull_by_view = false, .cull_by_receivers = false, .scissor = false});
    auto drawn = all.begin_frame();
    drawn.caster(bird);
    drawn.light(light_);
    drawn.receiver({.key = 1, .bounds = {glm::dmat4(1.0), {-20, -0.1, -20}, {20, 0, 20}}});
    EXPECT_EQ(std::move(drawn).finish(view).draws.size(), 1U);
}

TEST_F(Fill, ALampReachesNoFartherThanItsRange) {
    ShadowSystem system = make({});
    light_.position_world = {0, 4, 0, 1};
    light_.range_m = 4.5;
    const DrawList& list = frame(system, all_);
    EXPECT_EQ(list.draws.size(), 1U);
    EXPECT_EQ(count(list, Reason::OutOfRange), 4U);
    // What a ground that is out of range receives does not count.
    light_.range_m = 3.9;
    const DrawList& dim = frame(system, all_);
    ASSERT_EQ(dim.draws.size(), 1U) << "the box itself";
    for (const glm::vec3& p : dim.draws[0].mesh->positions()) {
        const glm::dvec4 far = dim.draws[0].world_from_far * glm::dvec4(glm::dvec3(p), 1.0);
        EXPECT_GT(far.y / far.w, -0.05);
    }
}

TEST_F(Fill, WithoutReceiversNothingEndsButTheViewStillCulls) {
    ShadowSystem system = make({}, Receivers::Anywhere);
    EXPECT_EQ(frame(system, all_).stats.pairs_clamped, 0U);
    EXPECT_EQ(frame(system, all_).draws.size(), 5U);
    EXPECT_EQ(frame(system, looking({0, 12, 40}, {0, 40, 80})).stats.pairs_hidden, 5U);
}

// By light and caster: what can be seen.
std::map<std::pair<std::uint64_t, std::uint64_t>, const VolumeDraw*> seen(const DrawList& list) {
    std::map<std::pair<std::uint64_t, std::uint64_t>, const VolumeDraw*> found;
    for (const VolumeDraw& draw : list.draws) {
        if (!draw.bounds.empty()) found[{draw.light, draw.caster}] = &draw;
    }
    return found;
}

TEST_F(Fill, WhatIsSeenIsThatOfASystemThatSawNothingBefore) {
    GNOMON_RANDOM(random);
    const std::vector<std::shared_ptr<const ShadowMesh>> meshes{
        box_, test::build(test::sphere(6, 7)), test::build(test::sheet(2))};
    std::uint64_t drawn = 0;
    std::uint64_t hidden = 0;
    for (int run = 0; run < 15; ++run) {
        std::vector<Caster> casters;
        std::vector<Light> lights;
        std::map<std::uint64_t, Receiver> receivers;
        for (std::uint64_t key = 0; key < 20; ++key) {
            casters.push_back({.key = key,
                               .mesh = meshes[random.below(3)],
                               .world_from_local = at(random.in_cube(8.0))});
        }
        for (std::uint64_t key = 0; key < 3; ++key) {
            lights.push_back({.key = key,
                              .position_world = glm::dvec4(random.in_cube(10.0),
                                                           random.chance(0.4) ? 0.0 : 1.0)});
            if (random.chance(0.5)) lights.back().range_m = random.uniform(3.0, 15.0);
        }
        View view = looking(random.in_cube(15.0), random.in_cube(3.0));
        const auto submit = [&](ShadowSystem& system) -> const DrawList& {
            auto frame = system.begin_frame();
            for (const Caster& caster : casters) frame.caster(caster);
            for (const Light& light : lights) frame.light(light);
            for (const auto& [key, receiver] : receivers) frame.receiver(receiver);
            return std::move(frame).finish(view);
        };
        ShadowSystem system = make({.slabs = run % 2 == 1});
        for (int step = 0; step < 60; ++step) {
            SCOPED_TRACE(testing::Message() << "run " << run << ", step " << step);
            const DrawList& list = submit(system);
            ShadowSystem fresh = make({.slabs = run % 2 == 1});
            const DrawList& expected = submit(fresh);
            const auto now = seen(list);
            const auto then = seen(expected);
            ASSERT_EQ(now.size(), then.size());
            for (const auto& [pair, draw] : now) {
                ASSERT_TRUE(then.contains(pair));
                const VolumeDraw& other = *then.at(pair);
                ASSERT_EQ(draw->world_from_far, other.world_from_far);
                ASSERT_EQ(draw->bounds, other.bounds);
                ASSERT_EQ(draw->depth, other.depth);
                ASSERT_EQ(draw->slabs, other.slabs);
                ASSERT_EQ(draw->technique, other.technique);
                ASSERT_EQ(draw->far_caps, other.far_caps);
                ASSERT_EQ(draw->volume->silhouette_edges, other.volume->silhouette_edges);
                ASSERT_EQ(draw->volume->made_with.far_vertices,
                          other.volume->made_with.far_vertices);
            }
            drawn += now.size();
            hidden += list.stats.pairs_hidden;
            ASSERT_EQ(list.stats.pairs, list.stats.pairs_culled + list.stats.pairs_redetected +
                                            list.stats.pairs_reused);
            const std::uint32_t what = random.below(5);
            if (what == 0) view = looking(random.in_cube(15.0), random.in_cube(3.0));
            if (what == 1) casters[random.below(20)].world_from_local = at(random.in_cube(8.0));
            if (what == 2) lights[random.below(3)].position_world += glm::dvec4(0.3, 0.1, 0.0, 0.0);
            if (what == 3) {
                const std::uint64_t key = random.below(6);
                receivers[key] = {
                    .key = key,
                    .bounds = {at(random.in_cube(8.0)), glm::dvec3(-3.0), glm::dvec3(3.0)}};
            }
            if (what == 4) receivers.erase(random.below(6));
        }
    }
    EXPECT_GT(drawn, 5'000U);
    EXPECT_GT(hidden, 500U);
}

}  // namespace
}  // namespace gnomon::shadows
