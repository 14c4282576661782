// SPDX-License-Identifier: MIT
//
// ShadowSystem as its host sees it: submission, order, removal, ranges, bad poses, techniques and
// where far vertices go. What costs a detection is in change_detection_test.cpp.
#include <gnomon/shadows/shadow_system.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

glm::dmat4 translation(const glm::dvec3& t) { return glm::translate(glm::dmat4(1.0), t); }
glm::dmat4 scaling(const glm::dvec3& s) { return glm::scale(glm::dmat4(1.0), s); }
glm::dvec4 point(const glm::dvec3& p) { return {p, 1.0}; }

View perspective() {
    return {look_at({0, 5, 30}, {0, 0, 0}, {0, 1, 0}), infinite_perspective(1, 1.5, 0.1)};
}
View parallel() {
    return {look_at({0, 5, 30}, {0, 0, 0}, {0, 1, 0}), orthographic(20, 15, 0.1, 100),
            ProjectionKind::Orthographic};
}

std::uint64_t count(const DrawList& list, Reason reason) {
    return list.stats.reasons[static_cast<std::size_t>(reason)];
}

class System : public ::testing::Test {
protected:
    ShadowSystem::Frame begin(Submission submission = Submission::Full) {
        return system_.begin_frame(submission);
    }
    DrawList one(const Caster& caster, const Light& light, const View& view = perspective()) {
        auto frame = begin();
        frame.caster(caster);
        frame.light(light);
        return std::move(frame).finish(view);
    }
    std::shared_ptr<const ShadowMesh> box_ = test::build(test::box());
    std::shared_ptr<const ShadowMesh> ball_ = test::build(test::sphere(8, 9));
    Light lamp_{.key = 1, .position_world = point({3, 7, 2})};
    ShadowSystem system_ = std::move(ShadowSystem::create()).value();
};

// ---------------------------------------------------------------------------------------------
// Submission

TEST_F(System, ListsByLightThenCasterWhateverTheOrderOfSubmission) {
    GNOMON_RANDOM(random);
    std::vector<std::uint64_t> keys{9, 2, 77, 31, 1ULL << 63U};
    for (int round = 0; round < 20; ++round) {
        auto frame = begin();
        std::shuffle(keys.begin(), keys.end(), std::mt19937(random.bits()));
        for (const std::uint64_t key : keys) {
            frame.caster({.key = key,
                          .mesh = box_,
                          .world_from_local = translation({0, static_cast<double>(key % 100), 0})});
            frame.light({.key = key, .position_world = {0.1, 1, 0.2, 0}});
        }
        const DrawList list = std::move(frame).finish(perspective());
        ASSERT_EQ(list.draws.size(), 25U);
        ASSERT_EQ(list.lights.size(), 5U);
        for (std::size_t i = 0; i < 25; ++i) {
            const LightDraws& light = list.lights[i / 5];
            ASSERT_EQ(light.first, i / 5 * 5);
            ASSERT_EQ(light.count, 5U);
            ASSERT_EQ(list.draws[i].light, light.light);
            if (i % 5 > 0) {
                ASSERT_LT(list.draws[i - 1].caster, list.draws[i].caster);
            }
        }
        ASSERT_EQ(list.stats.casters, 5U);
        ASSERT_EQ(list.stats.lights, 5U);
        ASSERT_EQ(list.stats.pairs, 25U);
        ASSERT_EQ(list.stats.pairs_redetected, round == 0 ? 25U : 0U);
    }
}

TEST_F(System, SameInputGivesTheSameList) {
    const auto run = [&] {
        GNOMON_RANDOM(random);
        ShadowSystem system = std::move(ShadowSystem::create()).value();
        std::vector<std::vector<std::uint32_t>> indices;
        std::vector<int> rest;
        for (int f = 0; f < 10; ++f) {
            auto frame = system.begin_frame();
            for (std::uint64_t k = 0; k < 6; ++k) {
                frame.caster({.key = k,
                              .mesh = k % 2 == 0 ? box_ : ball_,
                              .world_from_local = translation(random.in_cube(10.0))});
                frame.light({.key = k, .position_world = point(random.in_cube(10.0))});
            }
            const DrawList list = std::move(frame).finish(perspective());
            for (const VolumeDraw& draw : list.draws) {
                indices.push_back(draw.volume->indices);
                rest.push_back(static_cast<int>(draw.technique));
                rest.push_back(static_cast<int>(draw.reason));
            }
        }
        return std::pair(indices, rest);
    };
    EXPECT_EQ(run(), run());
}

TEST_F(System, FullForgetsWhatIsNotSubmitted) {
    auto frame = begin();
    frame.caster({.key = 1, .mesh = box_});
    frame.caster({.key = 2, .mesh = ball_, .world_from_local = translation({5, 0, 0})});
    frame.light(lamp_);
    EXPECT_EQ(std::move(frame).finish(perspective()).draws.size(), 2U);
    DrawList list =
        one({.key = 2, .mesh = ball_, .world_from_local = translation({5, 0, 0})}, lamp_);
    ASSERT_EQ(list.draws.size(), 1U);
    EXPECT_EQ(list.draws[0].caster, 2U);
    EXPECT_EQ(list.draws[0].reason, Reason::Unchanged);
    // Back again, it is new.
    list = one({.key = 1, .mesh = box_}, lamp_);
    EXPECT_EQ(list.draws[0].reason, Reason::New);
    // A light that goes leaves no entry; one without casters has an empty one.
    auto empty = begin();
    empty.light({.key = 5, .position_world = point({1, 2, 3})});
    list = std::move(empty).finish(perspective());
    ASSERT_EQ(list.lights.size(), 1U);
    EXPECT_EQ(list.lights[0].light, 5U);
    EXPECT_EQ(list.lights[0].count, 0U);
    EXPECT_EQ(one({.key = 1, .mesh = box_}, lamp_).draws[0].reason, Reason::New);
}

TEST_F(System, DeltaKeepsWhatIsNotSubmitted) {
    auto frame = begin(Submission::Delta);
    frame.caster({.key = 1, .mesh = box_});
    frame.caster({.key = 2, .mesh = ball_, .world_from_local = translation({5, 0, 0})});
    frame.light(lamp_);
    EXPECT_EQ(std::move(frame).finish(perspective()).stats.pairs_redetected, 2U);

    DrawList list = begin(Submission::Delta).finish(perspective());
    EXPECT_EQ(list.draws.size(), 2U);
    EXPECT_EQ(count(list, Reason::Unchanged), 2U);

    auto moved = begin(Submission::Delta);
    moved.caster({.key = 2, .mesh = ball_, .world_from_local = translation({5, 3, 0})});
    list = std::move(moved).finish(perspective());
    EXPECT_EQ(list.draws.size(), 2U);
    EXPECT_EQ(count(list, Reason::CasterMoved) + count(list, Reason::WithinMargin), 1U);
    EXPECT_EQ(count(list, Reason::Unchanged), 1U);

    auto removed = begin(Submission::Delta);
    removed.remove_caster(1);
    removed.remove_caster(4711);  // never there: nothing happens
    list = std::move(removed).finish(perspective());
    ASSERT_EQ(list.draws.size(), 1U);
    EXPECT_EQ(list.draws[0].caster, 2U);

    auto dark = begin(Submission::Delta);
    dark.remove_light(1);
    list = std::move(dark).finish(perspective());
    EXPECT_TRUE(list.draws.empty());
    EXPECT_TRUE(list.lights.empty());
    EXPECT_EQ(list.stats.casters, 1U);

    auto lit = begin(Submission::Delta);
    lit.light(lamp_);
    EXPECT_EQ(count(std::move(lit).finish(perspective()), Reason::New), 1U);
}

TEST_F(System, RemovedAndSubmittedAgainInOneFrameIsNew) {
    (void)one({.key = 1, .mesh = box_}, lamp_);
    auto frame = begin(Submission::Delta);
    frame.remove_caster(1);
    frame.caster({.key = 1, .mesh = box_});
    EXPECT_EQ(count(std::move(frame).finish(perspective()), Reason::New), 1U);
}

TEST_F(System, OfAKeySubmittedTwiceTheLastCounts) {
    auto frame = begin();
    frame.caster({.key = 1, .mesh = ball_});
    frame.caster({.key = 1, .mesh = box_, .world_from_local = translation({1, 0, 0})});
    frame.light({.key = 1, .position_world = {0, 1, 0, 0}});
    frame.light(lamp_);
    const DrawList list = std::move(frame).finish(perspective());
    ASSERT_EQ(list.draws.size(), 1U);
    EXPECT_EQ(list.draws[0].mesh, box_);
    EXPECT_EQ(list.draws[0].world_from_local, translation({1, 0, 0}));
    EXPECT_EQ(list.draws[0].extrusion.offset, glm::vec4(-2, -7, -2, 0));
}

TEST_F(System, AFrameThatIsDroppedHasStillBeenSubmitted) {
    (void)one({.key = 1, .mesh = box_}, lamp_);
    {
        auto dropped = begin(Submission::Delta);
        dropped.caster({.key = 2, .mesh = ball_, .world_from_local = translation({5, 0, 0})});
    }
    EXPECT_EQ(begin(Submission::Delta).finish(perspective()).draws.size(), 2U);
}

TEST_F(System, RevisionsAreUniqueAndFollowTheIndices) {
    ShadowSystem other = std::move(ShadowSystem::create()).value();
    std::set<std::uint64_t> seen;
    for (int i = 0; i < 5; ++i) {
        const Light moving{.key = 1, .position_world = point({3.0 - 2 * i, 7, 2})};
        seen.insert(one({.key = 1, .mesh = ball_}, moving).draws[0].revision);
        auto frame = other.begin_frame();
        frame.caster({.key = 1, .mesh = ball_});
        frame.light(moving);
        seen.insert(std::move(frame).finish(perspective()).draws[0].revision);
    }
    EXPECT_EQ(seen.size(), 10U);
}

TEST_F(System, AMeshMayHaveNoTrianglesAtAll) {
    const auto empty = test::build({});
    for (const View& view : {perspective(), parallel()}) {
        const DrawList list = one({.key = 1, .mesh = empty}, lamp_, view);
        EXPECT_TRUE(list.draws.empty());
        EXPECT_EQ(list.stats.pairs, 1U);
    }
}

TEST_F(System, UnknownSilhouetteNamesAreRefusedWithTheKnownOnes) {
    EXPECT_TRUE(ShadowSystem::create({.silhouette = "brute_force"}).has_value());
    const auto failed = ShadowSystem::create({.silhouette = "guesswork"});
    ASSERT_FALSE(failed.has_value());
    EXPECT_EQ(failed.error().code, ErrorCode::InvalidInput);
    EXPECT_NE(failed.error().message.find("\"guesswork\""), std::string::npos);
    EXPECT_NE(failed.error().message.find("auto, brute_force"), std::string::npos);
}

TEST_F(System, ReasonsHaveNames) {
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < reason_count; ++i) names.insert(to_string(static_cast<Reason>(i)));
    EXPECT_EQ(names.size(), reason_count);
    EXPECT_FALSE(names.contains(""));
}

// ---------------------------------------------------------------------------------------------
// Range and bad poses

TEST_F(System, CastersBeyondALightsRangeAreLeftOut) {
    Light lamp{.key = 1, .position_world = point({0, 0, 0}), .range_m = 10.0};
    const auto list_at = [&](double x) {
        return one({.key = 1, .mesh = box_, .world_from_local = translation({x, 0, 0})}, lamp);
    };
    EXPECT_EQ(list_at(5).draws.size(), 1U);
    EXPECT_EQ(list_at(10.9).draws.size(), 1U) << "its near side is within";
    const DrawList out = list_at(12);
    EXPECT_TRUE(out.draws.empty());
    EXPECT_EQ(out.stats.pairs_culled, 1U);
    EXPECT_EQ(count(out, Reason::OutOfRange), 1U);
    EXPECT_EQ(out.lights.size(), 1U);
    EXPECT_EQ(count(list_at(5), Reason::New), 1U) << "back in range";
    lamp.range_m = 1e-3;
    EXPECT_TRUE(list_at(5).draws.empty());
    lamp.range_m.reset();
    EXPECT_EQ(list_at(1e6).draws.size(), 1U);
    lamp.range_m = 1.0;
    lamp.position_world = {0, 1, 0, 0};
    EXPECT_EQ(list_at(1e6).draws.size(), 1U) << "a sun has no range";
}

TEST_F(System, WhatIsNotFiniteIsLeftOut) {
    (void)one({.key = 1, .mesh = box_}, lamp_);
    for (const double bad : {nan, std::numeric_limits<double>::infinity()}) {
        for (int c = 0; c < 4; ++c) {
            glm::dmat4 pose(1.0);
            pose[c][c % 3] = bad;
            const DrawList list = one({.key = 1, .mesh = box_, .world_from_local = pose}, lamp_);
            EXPECT_TRUE(list.draws.empty());
            EXPECT_EQ(list.stats.pairs_culled, 1U);
            EXPECT_EQ(list.stats.pairs_redetected, 0U);
            Light light = lamp_;
            light.position_world[c] = bad;
            EXPECT_TRUE(one({.key = 1, .mesh = box_}, light).draws.empty());
        }
    }
    const DrawList back = one({.key = 1, .mesh = box_}, lamp_);
    ASSERT_EQ(back.draws.size(), 1U);
    EXPECT_EQ(back.draws[0].reason, Reason::New);
}

TEST_F(System, ALightTooFarForSinglePrecisionCastsNothing) {
    const DrawList list =
        one({.key = 1, .mesh = box_}, {.key = 1, .position_world = point({1e300, 0, 0})});
    EXPECT_TRUE(list.draws.empty());
}

TEST_F(System, MirroredPosesAreMarked) {
    EXPECT_FALSE(one({.key = 1, .mesh = box_}, lamp_).draws[0].mirrored);
    EXPECT_TRUE(one({.key = 1, .mesh = box_, .world_from_local = scaling({-1, 1, 1})}, lamp_)
                    .draws[0]
                    .mirrored);
    EXPECT_FALSE(one({.key = 1, .mesh = box_, .world_from_local = scaling({-1, -1, 1})}, lamp_)
                     .draws[0]
                     .mirrored);
    EXPECT_TRUE(
        one({.key = 1, .mesh = box_, .world_from_local = scaling({-1e-4, -1e-4, -1e-4})}, lamp_)
            .draws[0]
            .mirrored);
}

TEST_F(System, ATinyUniformScaleIsNotAFlatOne) {
    const DrawList list =
        one({.key = 1, .mesh = box_, .world_from_local = scaling(glm::dvec3(1e-9))}, lamp_);
    ASSERT_EQ(list.draws.size(), 1U);
    EXPECT_EQ(list.draws[0].volume->near_cap_flipped.faces, 0U) << "one-sided, as a closed box is";
}

// The volume in the world, as the shader would place it: far vertices homogeneous.
// The triangles that have no near vertex.
std::vector<std::array<std::uint32_t, 3>> far_cap_of(const VolumeDraw& draw) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for_each_triangle(*draw.mesh, *draw.volume,
                      [&](const std::array<std::uint32_t, 3>& triangle, bool) {
                          if ((triangle[0] & triangle[1] & triangle[2] & 1U) != 0) {
                              triangles.push_back(triangle);
                          }
                      });
    return triangles;
}

glm::dvec4 far_vertex(const VolumeDraw& draw, const glm::vec3& p) {
    std::vector<glm::vec4> far;
    extrude(std::vector{p}, draw.extrusion, far);
    return draw.world_from_far * glm::dvec4(far[0]);
}

TEST_F(System, SingularPosesCastBothWaysAndAreClosed) {
    const std::vector<glm::dmat4> poses{translation({1, 2, 3}) * scaling({1, 0, 1}),
                                        scaling({0, 1, 1}), scaling({2, 3, 1e-13}),
                                        glm::dmat4(glm::dmat3(1, 0, 0, 2, 0, 0, 0, 0, 1))};
    for (const glm::dmat4& pose : poses) {
        for (const glm::dvec4 light : {point({3, 7, 2}), glm::dvec4(0.3, 1, 0.6, 0)}) {
            for (const View& view : {perspective(), parallel()}) {
                ShadowSystem system = std::move(ShadowSystem::create()).value();
                auto frame = system.begin_frame();
                frame.caster({.key = 1, .mesh = ball_, .world_from_local = pose});
                frame.light({.key = 1, .position_world = light});
                const DrawList list = std::move(frame).finish(view);
                if (list.draws.empty()) continue;  // edge-on
                const VolumeDraw& draw = list.draws[0];
                const bool infinite = view.projection == ProjectionKind::InfinitePerspective;
                EXPECT_TRUE(is_closed(*draw.mesh, *draw.volume));
                EXPECT_GT(draw.volume->near_cap.faces, 0U);
                EXPECT_GT(draw.volume->near_cap_flipped.faces, 0U);
                EXPECT_FALSE(draw.mirrored);
                for (const glm::vec3& p : ball_->positions()) {
                    const glm::dvec3 near(pose * glm::dvec4(glm::dvec3(p), 1.0));
                    const glm::dvec4 far = far_vertex(draw, p);
                    const glm::dvec3 away =
                        light.w == 0.0 ? -glm::dvec3(light) : near - glm::dvec3(light);
                    const glm::dvec3 went =
                        infinite ? glm::dvec3(far) : glm::dvec3(far) / far.w - near;
                    EXPECT_EQ(far.w == 0.0, infinite);
                    EXPECT_LT(glm::length(glm::normalize(went) - glm::normalize(away)), 1e-6);
                }
            }
        }
    }
    // Both kinds were drawn: a flat sheet facing the light casts.
    const DrawList flat =
        one({.key = 1, .mesh = ball_, .world_from_local = scaling({1, 0, 1})}, lamp_);
    EXPECT_EQ(flat.draws.size(), 1U);
    EXPECT_TRUE(one({.key = 1, .mesh = ball_, .world_from_local = scaling({0, 0, 0})}, lamp_)
                    .draws.empty());
}

TEST_F(System, FlatPosesThatMoveAreDetectedAndComeBack) {
    (void)one({.key = 1, .mesh = ball_}, lamp_);
    EXPECT_EQ(count(one({.key = 1, .mesh = ball_, .world_from_local = scaling({1, 0, 1})}, lamp_),
                    Reason::CasterMoved),
              1U);
    EXPECT_EQ(count(one({.key = 1, .mesh = ball_, .world_from_local = scaling({1, 0, 1})}, lamp_),
                    Reason::Unchanged),
              1U);
    EXPECT_EQ(count(one({.key = 1, .mesh = ball_}, lamp_), Reason::CasterMoved), 1U);
}

// ---------------------------------------------------------------------------------------------
// Far vertices

TEST_F(System, FiniteFarVerticesLieBeyondEverythingInView) {
    GNOMON_RANDOM(random);
    int checked = 0;
    for (int i = 0; i < 600; ++i) {
        const auto mesh = test::build(test::random_mesh(random));
        const bool flat = random.chance(0.2);
        glm::dmat4 pose =
            translation(random.in_cube(5.0)) * glm::dmat4(random.rotation()) *
            scaling({random.uniform(0.2, 3), random.uniform(0.2, 3), flat ? 0.0 : -1.5});
        const bool directional = random.chance(0.4);
        const Light light{
            .key = 1,
            .position_world = directional
                                  ? glm::dvec4(random.unit_vector() * random.uniform(0.01, 100), 0)
                                  : point(random.in_cube(12.0))};
        View view{look_at(random.in_cube(15.0), random.in_cube(2.0), random.unit_vector()),
                  finite_perspective(random.uniform(0.3, 2.0), 1.4, 0.1, random.uniform(5, 200)),
                  ProjectionKind::FinitePerspective};
        if (random.chance(0.5)) {
            view.projection = ProjectionKind::Orthographic;
            view.clip_from_view =
                orthographic(random.uniform(1, 30), 10, -3, random.uniform(5, 200));
        }
        const DrawList list = one({.key = 1, .mesh = mesh, .world_from_local = pose}, light, view);
        if (list.draws.empty()) continue;
        const VolumeDraw& draw = list.draws[0];
        std::vector<glm::dvec3> seen;
        for (const auto& p : near_corners(view)) seen.push_back(p);
        for (const auto& p : far_corners(view)) seen.push_back(p);
        const auto far_at = [&](std::uint32_t index) {
            const glm::dvec4 v = far_vertex(draw, mesh->positions()[index / 2]);
            return glm::dvec3(v) / v.w;
        };
        const auto far_cap = far_cap_of(draw);
        ASSERT_EQ(far_cap.size(), draw.volume->cap_faces());
        ASSERT_GT(far_cap.size(), 0U);
        const glm::dvec3 l(light.position_world);
        for (const auto& triangle : far_cap) {
            const glm::dvec3 a = far_at(triangle[0]);
            const glm::dvec3 b = far_at(triangle[1]);
            const glm::dvec3 c = far_at(triangle[2]);
            for (const glm::dvec3& p : seen) {
                if (directional) {
                    for (const glm::dvec3& v : {a, b, c}) ASSERT_LT(glm::dot(v - p, l), 0.0);
                } else {
                    // Not only corners: the whole triangle is farther from the light.
                    for (int s = 0; s < 6; ++s) {
                        const double u = s < 3 ? (s == 0) : random.uniform(0, 1);
                        const double v = s < 3 ? (s == 1) : random.uniform(0, 1 - u);
                        const glm::dvec3 q = u * a + v * b + (1 - u - v) * c;
                        ASSERT_GT(glm::length(q - l), glm::length(p - l)) << "mesh " << i;
                    }
                }
            }
            ++checked;
        }
    }
    EXPECT_GT(checked, 2'000);
}

TEST_F(System, ReachFollowsACasterThatIsScaledAboutTheLight) {
    // In the caster's space the light stays where it was; in metres the caster comes nearer.
    const glm::dvec3 l(0, 10, 0);
    const View view = parallel();
    for (const double k : {1.0, 0.05, 4.0, 0.001}) {
        const glm::dmat4 pose = translation(l) * scaling(glm::dvec3(k)) * translation(-l);
        const DrawList list = one({.key = 1, .mesh = ball_, .world_from_local = pose},
                                  {.key = 1, .position_world = point(l)}, view);
        ASSERT_EQ(list.draws.size(), 1U);
        const VolumeDraw& draw = list.draws[0];
        double farthest = 0.0;
        for (const auto& p : far_corners(view)) farthest = std::max(farthest, glm::length(p - l));
        ASSERT_FALSE(far_cap_of(draw).empty());
        for (const auto& triangle : far_cap_of(draw)) {
            for (const std::uint32_t index : triangle) {
                const glm::dvec4 v = far_vertex(draw, ball_->positions()[index / 2]);
                ASSERT_GT(glm::length(glm::dvec3(v) / v.w - l), farthest) << "scale " << k;
            }
        }
    }
}

// ---------------------------------------------------------------------------------------------
// Techniques

TEST_F(System, ChoosesTheTechniqueForEachPair) {
    auto frame = begin();
    frame.caster({.key = 1, .mesh = box_});
    // Between the light and the eye.
    frame.caster({.key = 2,
                  .mesh = box_,
                  .world_from_local = translation({0, 6, 28}),
                  .in_depth_buffer = false});
    frame.light({.key = 1, .position_world = {0.01, 1, 2, 0}});
    frame.light({.key = 2, .position_world = {0.0, 0.1, -1, 0}});
    const DrawList list = std::move(frame).finish(perspective());
    ASSERT_EQ(list.draws.size(), 4U);
    EXPECT_EQ(list.draws[0].technique, Technique::DepthPass);
    EXPECT_EQ(list.draws[3].technique, Technique::DepthFail);
    EXPECT_EQ(list.stats.zpass_pairs + list.stats.zfail_pairs, 4U);
    EXPECT_FALSE(list.draws[0].near_caps) << "its faces are in the depth buffer";
    EXPECT_TRUE(list.draws[1].near_caps);
    std::uint64_t edges = 0;
    for (const VolumeDraw& draw : list.draws) edges += draw.volume->silhouette_edges;
    EXPECT_EQ(list.stats.silhouette_edges, edges);
}

TEST_F(System, DepthPassDrawsNearCapsOfEitherKindWhereFacesAreNotInTheDepthBuffer) {
    for (const NearCaps near_caps : {NearCaps::Facing, NearCaps::Averted}) {
        for (const bool in_depth_buffer : {true, false}) {
            const Light sun{.key = 1, .position_world = {0.01, 1, 2, 0}};
            const DrawList list = one({.key = 1,
                                       .mesh = box_,
                                       .in_depth_buffer = in_depth_buffer,
                                       .near_caps = near_caps},
                                      sun);
            ASSERT_EQ(list.draws.size(), 1U);
            EXPECT_EQ(list.draws[0].technique, Technique::DepthPass);
            EXPECT_EQ(list.draws[0].near_caps, !in_depth_buffer);
            const bool averted = near_caps == NearCaps::Averted;
            EXPECT_EQ(list.draws[0].volume->near_cap_averted.faces > 0, averted);
            EXPECT_EQ(list.draws[0].volume->near_cap.faces > 0, !averted);
        }
    }
}

TEST_F(System, AForcedTechniqueIsForEveryPair) {
    for (const Technique forced : {Technique::DepthPass, Technique::DepthFail}) {
        ShadowSystem system = std::move(ShadowSystem::create({.force_technique = forced})).value();
        auto frame = system.begin_frame();
        frame.caster({.key = 1, .mesh = box_});
        frame.caster({.key = 2, .mesh = box_, .world_from_local = translation({0, 6, 28})});
        frame.light({.key = 1, .position_world = {0.0, 0.1, -1, 0}});
        for (const VolumeDraw& draw : std::move(frame).finish(perspective()).draws) {
            EXPECT_EQ(draw.technique, forced);
        }
    }
}

}  // namespace
}  // namespace gnomon::shadows
