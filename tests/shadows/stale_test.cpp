// SPDX-License-Identifier: MIT
//
// Silhouettes that may be out of date: when they are kept, when not, and that what is kept is the
// volume as it was, thrown from where the light is now.
#include <gnomon/shadows/shadow_system.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180.0;

class Stale : public ::testing::Test {
protected:
    static ShadowSystem system(const StaleOptions& stale) {
        return std::move(ShadowSystem::create({.fill = FillOptions::none(), .stale = stale}))
            .value();
    }
    static glm::dvec4 light_at(double degrees, double distance_m = 6.0) {
        return {distance_m * std::cos(degrees * degree), 1.0,
                distance_m * std::sin(degrees * degree), 1.0};
    }
    DrawList frame(ShadowSystem& system, const glm::dvec4& light) {
        auto frame = system.begin_frame();
        for (const std::uint64_t key : keys_) frame.caster({.key = key, .mesh = ball_});
        frame.light({.key = 1, .position_world = light});
        return std::move(frame).finish(
            {look_at({0, 5, 30}, {0, 0, 0}, {0, 1, 0}), infinite_perspective(1, 1.5, 0.1)});
    }
    static std::uint64_t left_stale(const DrawList& list) {
        return list.stats.reasons[static_cast<std::size_t>(Reason::LeftStale)];
    }
    std::shared_ptr<const ShadowMesh> ball_ = test::build(test::sphere(32, 33));
    std::vector<std::uint64_t> keys_{1};
};

TEST_F(Stale, ASilhouetteIsKeptWithinTheToleranceAndNoFurther) {
    ShadowSystem tolerant = system({.pose_tolerance_rad = 2.0 * degree});
    const DrawList first = frame(tolerant, light_at(0.0));
    const std::vector<std::uint32_t> indices = first.draws[0].volume->indices;
    for (const double degrees : {0.6, 1.2, 1.8}) {
        const DrawList list = frame(tolerant, light_at(degrees));
        EXPECT_EQ(list.stats.pairs_redetected, 0U) << degrees;
        EXPECT_EQ(left_stale(list), 1U) << degrees;
        EXPECT_EQ(list.draws[0].volume->indices, indices) << degrees;
    }
    const DrawList beyond = frame(tolerant, light_at(2.4));
    EXPECT_EQ(beyond.stats.pairs_redetected, 1U);
    EXPECT_EQ(left_stale(beyond), 0U);
    ShadowSystem fresh = system({});
    EXPECT_EQ(beyond.draws[0].volume->indices,
              frame(fresh, light_at(2.4)).draws[0].volume->indices);
}

TEST_F(Stale, WhatIsKeptIsThrownFromWhereTheLightIs) {
    ShadowSystem tolerant = system({.pose_tolerance_rad = 2.0 * degree});
    ShadowSystem exact = system({});
    frame(tolerant, light_at(0.0));
    const DrawList kept = frame(tolerant, light_at(1.5));
    const DrawList anew = frame(exact, light_at(1.5));
    EXPECT_EQ(left_stale(kept), 1U);
    EXPECT_EQ(kept.draws[0].extrusion.offset, anew.draws[0].extrusion.offset);
    EXPECT_EQ(kept.draws[0].extrusion.scale, anew.draws[0].extrusion.scale);
    EXPECT_NE(kept.draws[0].volume->indices, anew.draws[0].volume->indices);
}

TEST_F(Stale, EveryThirdFrameHasANewSilhouetteAndPairsTakeTurns) {
    keys_ = {10, 11, 12};
    ShadowSystem lazy = system({.detect_every = 3});
    frame(lazy, light_at(0.0));
    for (int i = 1; i <= 12; ++i) {
        const DrawList list = frame(lazy, light_at(5.0 * i));
        EXPECT_EQ(list.stats.pairs_redetected, 1U) << i;
        EXPECT_EQ(left_stale(list), 2U) << i;
    }
}

TEST_F(Stale, ALightWithinTheBoundsIsNeverBehind) {
    ShadowSystem lazy = system({.pose_tolerance_rad = std::numbers::pi, .detect_every = 1000});
    frame(lazy, light_at(0.0));
    const DrawList outside = frame(lazy, light_at(1.0));
    EXPECT_EQ(left_stale(outside), 1U);
    const glm::dvec4 inside{0.1, 0.0, 0.0, 1.0};
    for (const glm::dvec4& light : {inside, light_at(0.0)}) {  // in, and out again
        const DrawList list = frame(lazy, light);
        EXPECT_EQ(left_stale(list), 0U);
        ShadowSystem fresh = system({});
        EXPECT_EQ(list.draws[0].volume->indices, frame(fresh, light).draws[0].volume->indices);
    }
}

TEST_F(Stale, OffIsExact) {
    ShadowSystem exact = system({});
    frame(exact, light_at(0.0));
    const DrawList list = frame(exact, light_at(5.0));
    EXPECT_EQ(left_stale(list), 0U);
    EXPECT_EQ(list.stats.pairs_redetected, 1U);
}

TEST_F(Stale, LimitsAreNamed) {
    const auto refused = [](const StaleOptions& stale) -> std::string {
        auto made = ShadowSystem::create({.stale = stale});
        if (made) return "made";
        EXPECT_EQ(made.error().code, ErrorCode::InvalidInput);
        return made.error().message;
    };
    EXPECT_THAT(refused({.pose_tolerance_rad = -0.1}), HasSubstr("pose_tolerance_rad is -0.1"));
    EXPECT_THAT(refused({.pose_tolerance_rad = 4.0}), HasSubstr("pose_tolerance_rad is 4"));
    EXPECT_THAT(refused({.pose_tolerance_rad = std::numeric_limits<double>::quiet_NaN()}),
                HasSubstr("pose_tolerance_rad is nan"));
    EXPECT_THAT(refused({.detect_every = 0}), HasSubstr("detect_every is 0"));
    EXPECT_THAT(refused({.detect_every = 1025}), HasSubstr("detect_every is 1025"));
}

}  // namespace
}  // namespace gnomon::shadows
