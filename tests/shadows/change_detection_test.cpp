// SPDX-License-Identifier: MIT
//
// What costs a detection and what does not: the promise that work is done on what changed, and on
// all of it. Each claim is counted by FrameStats and, where a volume is kept, held against one made
// from nothing.
#include <gnomon/shadows/shadow_system.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;

glm::dmat4 translation(const glm::dvec3& t) { return glm::translate(glm::dmat4(1.0), t); }
glm::dmat4 turn(double degrees, const glm::dvec3& axis) {
    return glm::rotate(glm::dmat4(1.0), degrees * std::numbers::pi / 180.0, axis);
}
glm::dmat4 scaling(const glm::dvec3& s) { return glm::scale(glm::dmat4(1.0), s); }
glm::dvec4 point(const glm::dvec3& p) { return {p, 1.0}; }

View some_view() {
    return {look_at({0, 5, 30}, {0, 0, 0}, {0, 1, 0}), infinite_perspective(1, 1.5, 0.1)};
}

class ChangeDetection : public ::testing::Test {
protected:
    // Submits everything there is and finishes.
    DrawList frame(const View& view = some_view()) {
        auto frame = system_.begin_frame();
        for (const Caster& caster : casters_) frame.caster(caster);
        for (const Light& light : lights_) frame.light(light);
        return std::move(frame).finish(view);
    }
    // The same picture from a system that has seen nothing before.
    [[nodiscard]] DrawList from_nothing() const {
        auto fresh = ShadowSystem::create({.fill = FillOptions::none()});
        auto frame = fresh->begin_frame();
        for (const Caster& caster : casters_) frame.caster(caster);
        for (const Light& light : lights_) frame.light(light);
        return std::move(frame).finish(some_view());
    }
    static std::uint64_t count(const DrawList& list, Reason reason) {
        return list.stats.reasons[static_cast<std::size_t>(reason)];
    }
    void expect_as_from_nothing(const DrawList& list) const {
        const DrawList expected = from_nothing();
        ASSERT_EQ(list.draws.size(), expected.draws.size());
        for (std::size_t i = 0; i < list.draws.size(); ++i) {
            ASSERT_EQ(list.draws[i].volume->indices, expected.draws[i].volume->indices);
            ASSERT_EQ(list.draws[i].volume->ranges, expected.draws[i].volume->ranges);
        }
    }

    // Every far vertex, as the shader makes it, in the direction from the light to the near one.
    static void expect_shadows_fall_away_from(const glm::dvec3& light, const VolumeDraw& draw) {
        std::vector<glm::vec4> far;
        extrude(draw.mesh->positions(), draw.extrusion, far);
        double worst = 0.0;
        for (std::size_t i = 0; i < far.size(); ++i) {
            const glm::dvec4 p(glm::dvec3(draw.mesh->positions()[i]), 1.0);
            const glm::dvec3 away = glm::dvec3(draw.world_from_local * p) - light;
            const glm::dvec3 went(draw.world_from_far * glm::dvec4(far[i]));
            worst = std::max(worst, glm::length(glm::normalize(went) - glm::normalize(away)));
        }
        EXPECT_LT(worst, 1e-4);
    }

    std::shared_ptr<const ShadowMesh> ball_ = test::build(test::sphere(32, 33));  // 2,046 triangles
    std::shared_ptr<const ShadowMesh> box_ = test::build(test::box());
    std::vector<Caster> casters_{{.key = 1, .mesh = ball_}};
    std::vector<Light> lights_{{.key = 1, .position_world = point({3, 7, 2})}};
    ShadowSystem system_ = std::move(ShadowSystem::create({.fill = FillOptions::none()})).value();
};

TEST_F(ChangeDetection, NothingMovesNothingIsDone) {
    EXPECT_EQ(count(frame(), Reason::New), 1U);
    for (int i = 0; i < 10; ++i) {
        const DrawList list = frame();
        EXPECT_EQ(list.stats.pairs_redetected, 0U);
        EXPECT_EQ(list.stats.pairs_reused, 1U);
        EXPECT_EQ(list.stats.detection.faces_tested, 0U);
        EXPECT_EQ(count(list, Reason::Unchanged), 1U);
    }
}

TEST_F(ChangeDetection, ACameraCostsNothing) {
    std::uint64_t revision = frame().draws[0].revision;
    std::uint64_t caps_made = 0;
    GNOMON_RANDOM(random);
    for (int i = 0; i < 300; ++i) {
        View view = some_view();
        view.view_from_world =
            look_at(random.in_cube(20.0), random.in_cube(1.0), random.unit_vector());
        view.clip_from_view = infinite_perspective(random.uniform(0.3, 2.0), 1.5, 0.01);
        const DrawList list = frame(view);
        ASSERT_EQ(list.stats.pairs_redetected, 0U);
        ASSERT_EQ(count(list, Reason::Unchanged), 1U);
        // But for the caps, the first time that they are drawn.
        if (list.stats.caps_made > 0) {
            ASSERT_EQ(list.draws[0].technique, Technique::DepthFail);
            ASSERT_NE(list.draws[0].revision, revision);
            revision = list.draws[0].revision;
        }
        caps_made += list.stats.caps_made;
        ASSERT_EQ(list.draws[0].revision, revision);
    }
    EXPECT_EQ(caps_made, 1U);
}

TEST_F(ChangeDetection, RigidMotionOfCasterAndLightTogetherCostsNothing) {
    GNOMON_RANDOM(random);
    // Among them a box with the light in the plane of its top: any difference would show.
    const std::vector<std::pair<std::shared_ptr<const ShadowMesh>, glm::dvec3>> pairs{
        {ball_, {3, 7, 2}},
        {box_, {5, 1, 0.25}},
        {test::build(test::torus(30, 20)), {0.5, 0.1, 9}}};
    for (const auto& [mesh, light] : pairs) {
        for (const double w : {1.0, 0.0}) {
            casters_[0].mesh = mesh;
            const glm::dmat4 start =
                translation({4, -2, 1}) * turn(33.0, {0, 1, 0}) * scaling({1.5, 1.5, 1.5});
            const glm::dvec4 light_start = start * glm::dvec4(light, w);
            casters_[0].world_from_local = start;
            lights_[0].position_world = light_start;
            (void)frame();
            for (int i = 0; i < 1'000; ++i) {
                const glm::dmat4 motion =
                    translation(random.in_cube(1e4)) * glm::dmat4(random.rotation());
                casters_[0].world_from_local = motion * start;
                lights_[0].position_world = motion * light_start;
                const DrawList list = frame();
                ASSERT_EQ(list.stats.pairs_redetected, 0U) << "motion " << i << " w " << w;
                ASSERT_EQ(count(list, Reason::Unchanged), 1U) << "motion " << i << " w " << w;
            }
        }
    }
}

TEST_F(ChangeDetection, ARideOfManyStepsCostsNothing) {
    // The poses are composed step upon step, as a train's cars are: their own rounding grows, and
    // what they mean stays.
    const glm::dmat4 on_platform = translation({0, 2, 0}) * turn(20, {1, 0, 0});
    glm::dvec3 at(0.0);
    double heading = 0.0;
    std::uint64_t redetected = 0;
    for (int i = 0; i < 5'000; ++i) {
        heading += 0.37;
        at += glm::dvec3(turn(heading, {0, 1, 0}) * glm::dvec4(0.5, 0, 0, 0));
        const glm::dmat4 platform = translation(at) * turn(heading, {0, 1, 0});
        casters_[0].world_from_local = platform * on_platform;
        lights_[0].position_world = platform * point({3, 7, 2});
        redetected += frame().stats.pairs_redetected;
    }
    EXPECT_EQ(redetected, 1U);
}

TEST_F(ChangeDetection, TranslationUnderADirectionalLightCostsNothing) {
    GNOMON_RANDOM(random);
    lights_[0].position_world = {0.3, 1.0, 0.2, 0.0};
    casters_[0].world_from_local = turn(20, {0, 0, 1});
    const std::uint64_t revision = frame().draws[0].revision;
    for (int i = 0; i < 1'000; ++i) {
        casters_[0].world_from_local[3] = point(random.in_cube(1e4));
        const DrawList list = frame();
        ASSERT_EQ(list.stats.pairs_redetected, 0U);
        ASSERT_EQ(list.draws[0].revision, revision);
        ASSERT_EQ(list.draws[0].world_from_local, casters_[0].world_from_local);
    }
}

TEST_F(ChangeDetection, ScalingADirectionCostsNothing) {
    lights_[0].position_world = {0.3, 1.0, 0.2, 0.0};
    (void)frame();
    for (const double k : {2.0, 0.1, 1e6, 1e-6}) {
        lights_[0].position_world = glm::dvec4(k * glm::dvec3(0.3, 1.0, 0.2), 0.0);
        EXPECT_EQ(frame().stats.pairs_redetected, 0U) << k;
    }
}

TEST_F(ChangeDetection, ASmallMoveIsCertifiedALargeOneDetected) {
    casters_[0].mesh = box_;
    lights_[0].position_world = point({3, 4, 5});  // 2 m above the nearest side's plane
    (void)frame();
    lights_[0].position_world = point({3.5, 4, 5});
    DrawList list = frame();
    EXPECT_EQ(count(list, Reason::WithinMargin), 1U);
    EXPECT_EQ(list.stats.pairs_redetected, 0U);
    EXPECT_EQ(list.draws[0].extrusion.offset, glm::vec4(-3.5F, -4, -5, 0))
        << "but it falls elsewhere";
    lights_[0].position_world = point({0.5, 4, 5});
    list = frame();
    EXPECT_EQ(count(list, Reason::LightMoved), 1U);
    EXPECT_EQ(list.stats.pairs_redetected, 1U);
    expect_as_from_nothing(list);
}

TEST_F(ChangeDetection, OneOfFortyCastersTurns) {
    lights_.push_back({.key = 2, .position_world = point({-8, 9, 3})});
    lights_.push_back({.key = 3, .position_world = {0.2, 1, 0.3, 0}});
    casters_.clear();
    for (std::uint64_t i = 0; i < 40; ++i) {
        casters_.push_back({.key = i,
                            .mesh = ball_,
                            .world_from_local = translation({3.0 * static_cast<double>(i), 0, 0})});
    }
    EXPECT_EQ(frame().stats.pairs_redetected, 120U);
    casters_[17].world_from_local = casters_[17].world_from_local * turn(15, {0, 0, 1});
    const DrawList list = frame();
    EXPECT_EQ(list.stats.pairs_redetected, 3U);
    EXPECT_EQ(count(list, Reason::CasterMoved), 3U);
    EXPECT_EQ(count(list, Reason::Unchanged), 117U);
    for (const VolumeDraw& draw : list.draws) {
        EXPECT_EQ(draw.reason, draw.caster == 17 ? Reason::CasterMoved : Reason::Unchanged);
    }
    expect_as_from_nothing(list);
}

TEST_F(ChangeDetection, ALightMovesItsOwnPairsOnly) {
    lights_.push_back({.key = 2, .position_world = point({-8, 9, 3})});
    casters_.push_back({.key = 2, .mesh = box_, .world_from_local = translation({5, 0, 0})});
    (void)frame();
    lights_[1].position_world = point({8, -9, 3});
    const DrawList list = frame();
    EXPECT_EQ(list.stats.pairs_redetected, 2U);
    EXPECT_EQ(count(list, Reason::LightMoved), 2U);
    for (const VolumeDraw& draw : list.draws) {
        EXPECT_EQ(draw.reason, draw.light == 2 ? Reason::LightMoved : Reason::Unchanged);
    }
}

TEST_F(ChangeDetection, BothMoving) {
    (void)frame();
    casters_[0].world_from_local = turn(40, {0, 0, 1});
    lights_[0].position_world = point({3, 7, -2});
    EXPECT_EQ(count(frame(), Reason::BothMoved), 1U);
}

TEST_F(ChangeDetection, AReplacedMeshIsSeen) {
    (void)frame();
    casters_[0].mesh = box_;
    DrawList list = frame();
    EXPECT_EQ(count(list, Reason::MeshChanged), 1U);
    EXPECT_EQ(list.draws[0].mesh, box_);
    expect_as_from_nothing(list);
    // An equal mesh built anew is another one.
    casters_[0].mesh = test::build(test::box());
    EXPECT_EQ(count(frame(), Reason::MeshChanged), 1U);
    // Also when the caster moves in the same frame by less than the old mesh's margin.
    casters_[0].mesh = ball_;
    casters_[0].world_from_local = translation({1e-4, 0, 0});
    list = frame();
    EXPECT_EQ(list.stats.pairs_redetected, 1U);
    expect_as_from_nothing(list);
}

TEST_F(ChangeDetection, AnotherKindOfNearCapsIsDetectedOnce) {
    const std::uint64_t revision = frame().draws[0].revision;
    casters_[0].near_caps = NearCaps::Averted;
    const DrawList asked = frame();
    EXPECT_EQ(count(asked, Reason::NearCapsChanged), 1U);
    EXPECT_EQ(asked.stats.pairs_redetected, 1U);
    EXPECT_NE(asked.draws[0].revision, revision);
    EXPECT_GT(asked.draws[0].volume->near_cap_averted.faces, 0U);
    expect_as_from_nothing(asked);
    EXPECT_EQ(frame().stats.pairs_redetected, 0U);
    // Together with a move the reason is the caps: the move alone might have cost nothing.
    casters_[0].near_caps = NearCaps::Facing;
    casters_[0].world_from_local = translation({0.5, 0, 0});
    const DrawList back = frame();
    EXPECT_EQ(count(back, Reason::NearCapsChanged), 1U);
    EXPECT_EQ(back.draws[0].volume->near_cap_averted.faces, 0U);
    expect_as_from_nothing(back);
}

TEST_F(ChangeDetection, CapsOnAvertedFacesAreReusedAsOthersAre) {
    GNOMON_RANDOM(random);
    casters_[0].near_caps = NearCaps::Averted;
    const std::uint64_t revision = frame().draws[0].revision;
    for (int i = 0; i < 100; ++i) {
        const glm::dmat4 motion = translation(random.in_cube(1e4)) * glm::dmat4(random.rotation());
        casters_[0].world_from_local = motion;
        lights_[0].position_world = motion * point({3, 7, 2});
        View view = some_view();
        view.view_from_world =
            look_at(random.in_cube(20.0), random.in_cube(1.0), random.unit_vector());
        const DrawList list = frame(view);
        ASSERT_EQ(list.stats.pairs_redetected, 0U) << "motion " << i;
        ASSERT_EQ(list.draws[0].revision, revision);
    }
    // Until it moves by itself; then what comes is what a rebuild gives.
    lights_[0].position_world += glm::dvec4(random.unit_vector(), 0.0);
    const DrawList moved = frame();
    EXPECT_EQ(moved.stats.pairs_redetected, 1U);
    expect_as_from_nothing(moved);
}

TEST_F(ChangeDetection, AHalfTurnIsSeen) {
    test::Triangles wedge = test::tetrahedron({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 1});
    casters_[0].mesh = test::build(wedge);
    lights_[0].position_world = {0.1, 0.2, 1.0, 0.0};
    (void)frame();
    casters_[0].world_from_local = turn(180, {0, 1, 0});
    DrawList list = frame();
    EXPECT_EQ(list.stats.pairs_redetected, 1U);
    expect_as_from_nothing(list);
    // And so is the light on the opposite side.
    lights_[0].position_world *= -1.0;
    lights_[0].position_world.w = 0.0;
    list = frame();
    EXPECT_EQ(list.stats.pairs_redetected, 1U);
    expect_as_from_nothing(list);
}

TEST_F(ChangeDetection, ASlowDriftArrivesWhereARebuildDoes) {
    // 1e-5 degrees a frame: no single step is worth a detection, all of them together are.
    casters_[0].mesh = test::build(test::sphere(10, 12));
    std::uint64_t redetected = 0;
    for (int i = 0; i <= 100'000; ++i) {
        casters_[0].world_from_local = turn(1e-5 * i, {0.6, 0.8, 0});
        const DrawList list = frame();
        redetected += list.stats.pairs_redetected;
        if (i % 1'000 == 0) {
            SCOPED_TRACE(i);
            expect_as_from_nothing(list);
            if (HasFatalFailure()) return;
        }
    }
    EXPECT_GT(redetected, 2U);
    EXPECT_LT(redetected, 5'000U);
}

TEST_F(ChangeDetection, OneStepOfSinglePrecisionOffAPlaneIsSeen) {
    // What composing poses rounds is forgiven; anything that the shader could tell is not.
    casters_[0].mesh = box_;
    lights_[0].position_world = point({5, 1, 0.25});  // in the plane of the top
    EXPECT_EQ(frame().draws[0].volume->near_cap.faces, 2U);
    lights_[0].position_world.y = 1.0 + 0x1p-23;
    const DrawList list = frame();
    EXPECT_EQ(list.stats.pairs_redetected, 1U);
    EXPECT_EQ(list.draws[0].volume->near_cap.faces, 4U);
}

TEST_F(ChangeDetection, StepsBelowTheRoundingOfPosesAddUp) {
    // At 10 km the poses themselves round by more than each of these steps.
    casters_[0].mesh = box_;
    const glm::dvec3 away(1e4, -1e4, 1e4);
    casters_[0].world_from_local = translation(away);
    std::uint64_t unchanged = 0;
    for (int i = 0; i < 2'000; ++i) {
        lights_[0].position_world = point(away + glm::dvec3(5, 1.0 + 1e-10 * i, 0.25));
        unchanged += count(frame(), Reason::Unchanged);
    }
    EXPECT_GT(unchanged, 500U) << "steps too large to mean anything";
    expect_as_from_nothing(frame());
    EXPECT_EQ(frame().draws[0].volume->near_cap.faces, 4U) << "the light has left the top's plane";
}

TEST_F(ChangeDetection, JitterStaysCertified) {
    GNOMON_RANDOM(random);
    casters_[0].mesh = box_;
    lights_[0].position_world = point({3, 4, 5});
    (void)frame();
    for (int i = 0; i < 2'000; ++i) {
        lights_[0].position_world = point(glm::dvec3(3, 4, 5) + random.in_cube(0.2));
        const DrawList list = frame();
        ASSERT_EQ(list.stats.pairs_redetected, 0U);
        ASSERT_EQ(count(list, Reason::WithinMargin), 1U);
    }
}

TEST_F(ChangeDetection, RandomWalksAreAlwaysWhatARebuildIs) {
    GNOMON_RANDOM(random);
    std::uint64_t kept = 0;
    for (int walk = 0; walk < 60; ++walk) {
        casters_[0].mesh = test::build(test::random_mesh(random));
        glm::dvec3 light = random.in_cube(4.0);
        const double w = random.chance(0.4) ? 0.0 : 1.0;
        glm::dmat4 pose = translation(random.in_cube(2.0)) * glm::dmat4(random.rotation()) *
                          scaling({random.uniform(0.1, 3.0), random.uniform(0.1, 3.0),
                                   random.uniform(-3.0, -0.1)});
        for (int i = 0; i < 60; ++i) {
            light += random.in_cube(std::pow(10.0, random.uniform(-6.0, -0.5)));
            if (random.chance(0.3))
                pose = pose * turn(std::pow(10.0, random.uniform(-5, 1)), {0, 1, 0});
            casters_[0].world_from_local = pose;
            lights_[0].position_world = glm::dvec4(light, w);
            const DrawList list = frame();
            kept += list.stats.pairs_reused;
            SCOPED_TRACE(::testing::Message() << "walk " << walk << " step " << i);
            expect_as_from_nothing(list);
            if (HasFatalFailure()) return;
        }
    }
    EXPECT_GT(kept, 100U) << "the margins were never at work";
}

TEST_F(ChangeDetection, ASquashedCasterSeesItsLightMove) {
    // In the caster's own space the light is very far along the squashed axis; a move across it is
    // small beside that, and must be seen all the same.
    for (const double thin : {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-9, 1e-11, 1e-13, 1e-40}) {
        for (const glm::dmat4& squash :
             {scaling({1, 1, thin}), scaling({1, 1, thin}) * turn(30, {1, 1, 0}),
              turn(70, {0, 1, 1}) * scaling({1, thin, 1}) * turn(30, {1, 1, 0})}) {
            casters_[0] = {.key = 1, .mesh = ball_, .world_from_local = squash};
            for (const double x : {1.0, 1.001, 1.002}) {
                lights_[0].position_world = point({x, 1, 1});
                const DrawList list = frame();
                EXPECT_EQ(count(list, Reason::Unchanged), 0U) << thin;
                ASSERT_EQ(list.draws.size(), 1U) << thin;
                expect_shadows_fall_away_from(glm::dvec3(lights_[0].position_world), list.draws[0]);
            }
        }
    }
}

TEST_F(ChangeDetection, ALightThatEntersTheBoundsChangesTheKindOfCasting) {
    casters_[0].mesh = box_;
    lights_[0].position_world = point({1.5, 0.25, 0.5});
    DrawList list = frame();
    EXPECT_EQ(list.draws[0].volume->near_cap_flipped.faces, 0U);
    lights_[0].position_world = point({0.5, 0.25, 0.5});
    list = frame();
    EXPECT_EQ(list.stats.pairs_redetected, 1U);
    EXPECT_EQ(list.draws[0].volume->near_cap_flipped.faces, 12U);
    lights_[0].position_world = point({-1.5, 0.25, 0.5});
    list = frame();
    EXPECT_EQ(list.stats.pairs_redetected, 1U);
    EXPECT_EQ(list.draws[0].volume->near_cap_flipped.faces, 0U);
}

TEST_F(ChangeDetection, ALightTurnsFromPointToDirectionAndBack) {
    (void)frame();
    lights_[0].position_world.w = 0.0;
    DrawList list = frame();
    EXPECT_EQ(count(list, Reason::LightMoved), 1U);
    EXPECT_FALSE(list.draws[0].volume->has_far_cap());
    expect_as_from_nothing(list);
    lights_[0].position_world.w = 1.0;
    list = frame();
    EXPECT_EQ(count(list, Reason::LightMoved), 1U);
    EXPECT_TRUE(list.draws[0].volume->has_far_cap());
    expect_as_from_nothing(list);
}

TEST_F(ChangeDetection, AnotherProjectionRebuildsOnceAndForTheRightReason) {
    lights_[0].position_world = {0.3, 1, 0.2, 0};
    (void)frame();
    View parallel = some_view();
    parallel.projection = ProjectionKind::Orthographic;
    parallel.clip_from_view = orthographic(20, 20, 0.1, 100);
    DrawList list = frame(parallel);
    EXPECT_EQ(count(list, Reason::ProjectionChanged), 1U);
    EXPECT_TRUE(list.draws[0].volume->has_far_cap()) << "at finite places a far cap is needed";
    EXPECT_EQ(count(frame(parallel), Reason::Unchanged), 1U);
    View finite = some_view();
    finite.projection = ProjectionKind::FinitePerspective;
    finite.clip_from_view = finite_perspective(1, 1.5, 0.1, 100);
    EXPECT_EQ(count(frame(finite), Reason::Unchanged), 1U);
    EXPECT_EQ(count(frame(), Reason::ProjectionChanged), 1U);
}

TEST_F(ChangeDetection, AFanGivesWayToFacesBeforeTheLightIsWithinTheBounds) {
    // A box without a lid: no face is near the light on its way in and out, so nothing but the fan
    // needs to be detected anew.
    test::Triangles open = test::box();
    for (int i = 0; i < 2; ++i) {
        const auto on_top = [&](std::size_t f) {
            return std::all_of(&open.indices[3 * f], &open.indices[3 * f] + 3,
                               [&](auto v) { return open.positions[v].y > 0.0F; });
        };
        std::size_t f = 0;
        while (!on_top(f)) ++f;
        test::remove_face(open, f);
    }
    casters_[0].mesh = test::build(open);
    system_ =
        *ShadowSystem::create({.caps = {.far_cap = FarCap::Fan}, .fill = FillOptions::none()});
    std::size_t reused = 0;
    bool was_fan = true;
    std::size_t changes = 0;
    for (int i = -400; i <= 1'500; ++i) {
        const double y = 1.0 + 0.002 * std::abs(i) - 0.3;
        lights_[0].position_world = point({0.1, y, 0.2});
        const DrawList list = frame();
        ASSERT_EQ(list.draws.size(), 1U);
        const bool fan = list.draws[0].volume->made_with.caps.far_cap == FarCap::Fan;
        ASSERT_TRUE(!fan || y > 1.0) << "y = " << y;
        // On the way out faces are kept for as long as they are right.
        ASSERT_TRUE(fan || y <= 1.0 || i > 0) << "y = " << y;
        ASSERT_TRUE(is_closed(*list.draws[0].mesh, *list.draws[0].volume));
        reused += count(list, Reason::WithinMargin);
        changes += fan != was_fan ? 1 : 0;
        was_fan = fan;
    }
    EXPECT_EQ(changes, 2U);
    EXPECT_GT(reused, 100U);
}

TEST_F(ChangeDetection, AFanIsForPointLightsAndFarVerticesAtInfinity) {
    system_ =
        *ShadowSystem::create({.caps = {.far_cap = FarCap::Fan}, .fill = FillOptions::none()});
    const auto far_cap = [](const DrawList& list) {
        return list.draws[0].volume->made_with.caps.far_cap;
    };
    EXPECT_EQ(far_cap(frame()), FarCap::Fan);
    View parallel = some_view();
    parallel.projection = ProjectionKind::Orthographic;
    parallel.clip_from_view = orthographic(20, 20, 0.1, 100);
    EXPECT_EQ(far_cap(frame(parallel)), FarCap::Faces);
    casters_[0].world_from_local = scaling({1, 0, 1});
    EXPECT_EQ(far_cap(frame()), FarCap::Faces) << "there is no light in the caster's space";
    casters_[0].world_from_local = glm::dmat4(1.0);
    lights_[0].position_world = {0.3, 1, 0.2, 0};
    EXPECT_EQ(far_cap(frame()), FarCap::Faces);
    EXPECT_FALSE(frame().draws[0].volume->has_far_cap());
}

}  // namespace
}  // namespace gnomon::shadows
