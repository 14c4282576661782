// SPDX-License-Identifier: MIT
//
// Shadow maps are fitted: everything that is seen is in the map, and little else.
#include "internal/light_projector.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace gnomon::report::internal {
namespace {

shadows::View view_from(const glm::dvec3& eye, const glm::dvec3& target) {
    return {shadows::look_at(eye, target, {0.0, 1.0, 0.0}),
            shadows::infinite_perspective(0.8, 1.5, 0.1)};
}

scene::Bounds box(const glm::dvec3& min, const glm::dvec3& max) {
    scene::Bounds bounds;
    bounds.include(min);
    bounds.include(max);
    return bounds;
}

TEST(SeenPart, IsWithinBoxAndView) {
    const scene::Bounds ground = box({-100, -1, -100}, {100, 0, 100});
    const shadows::View view = view_from({0, 5, 10}, {0, 0, 0});
    const auto seen = seen_part(ground, view);
    ASSERT_GE(seen.size(), 4U);
    double nearest = 1e300;
    for (const glm::dvec3& p : seen) {
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(p, ground.min - 1e-6)));
        EXPECT_TRUE(glm::all(glm::lessThanEqual(p, ground.max + 1e-6)));
        const glm::dvec4 clip = view.clip_from_world() * glm::dvec4(p, 1.0);
        EXPECT_LE(std::abs(clip.x), clip.w + 1e-6);
        EXPECT_LE(std::abs(clip.y), clip.w + 1e-6);
        nearest = std::min(nearest, 10.0 - p.z);
    }
    EXPECT_GT(nearest, 1.0);  // what lies below and behind the eye is not seen
    EXPECT_TRUE(seen_part(box({-1, 0, 20}, {1, 1, 30}), view).empty());  // behind it
    EXPECT_TRUE(seen_part({}, view).empty());
    // From within, the near plane's corners are of it.
    EXPECT_GE(seen_part(box({-50, -50, -50}, {50, 50, 50}), view).size(), 8U);
}

class Fit : public ::testing::Test {
protected:
    Projector fit(const glm::dvec4& light) {
        shadows::Light l;
        l.position_world = light;
        return fit_projector(l, {seen_, casters_, {0, 0, -1}, 20.0, 1024});
    }
    void expect_all_seen_within(const Projector& p, const glm::dvec4& light) {
        for (const glm::dvec3& seen : seen_) {
            bool found = false;
            for (std::size_t face = 0; face < p.clip_from_world.size(); ++face) {
                const glm::dvec4 clip = p.clip_from_world[face] * glm::dvec4(seen, 1.0);
                const bool within = clip.w > 0.0 && std::abs(clip.x) <= clip.w * 1.001 &&
                                    std::abs(clip.y) <= clip.w * 1.001;
                if (!within || p.is_needed[face] == 0) continue;
                found = true;
                EXPECT_GE(clip.z, 0.0);
                EXPECT_LE(clip.z, clip.w);
            }
            EXPECT_TRUE(found) << light.x << ' ' << light.y << ' ' << light.z;
        }
    }
    std::vector<glm::dvec3> seen_ =
        seen_part(box({-4, 0, -4}, {4, 2, 4}), view_from({0, 5, 10}, {0, 0, 0}));
    scene::Bounds casters_ = box({-50, -1, -50}, {50, 3, 50});
};

TEST_F(Fit, ASunHasOneMapOfWhatIsSeen) {
    const glm::dvec4 sun{1.0, 2.0, 0.5, 0.0};
    const Projector p = fit(sun);
    ASSERT_EQ(p.clip_from_world.size(), 1U);
    EXPECT_FALSE(p.cube);
    expect_all_seen_within(p, sun);
    // A texel is a share of some eight metres, not of the hundred that casters extend.
    const double width_m = 2.0 / glm::length(glm::dvec3(glm::transpose(p.clip_from_world[0])[0]));
    EXPECT_LT(width_m, 16.0);
}

TEST_F(Fit, ALampOutsideHasOneMapAndOneInsideACube) {
    const glm::dvec4 outside{2.0, 30.0, 3.0, 1.0};
    const Projector single = fit(outside);
    ASSERT_EQ(single.clip_from_world.size(), 1U);
    EXPECT_FALSE(single.cube);
    EXPECT_GT(single.near_m, 15.0);
    expect_all_seen_within(single, outside);

    const glm::dvec4 inside{0.5, 1.0, 0.5, 1.0};
    const Projector cube = fit(inside);
    ASSERT_EQ(cube.clip_from_world.size(), 6U);
    EXPECT_TRUE(cube.cube);
    expect_all_seen_within(cube, inside);
}

TEST_F(Fit, FacesOfACubeThatSeeNothingAreLeftOut) {
    seen_ = seen_part(box({-4, 0, -4}, {4, 0.1, 4}), view_from({0, 5, 10}, {0, 0, 0}));
    const glm::dvec4 low{0.0, 0.5, 0.0, 1.0};
    const Projector p = fit(low);
    ASSERT_TRUE(p.cube);
    EXPECT_EQ(p.is_needed[2], 0);  // upwards
    EXPECT_EQ(p.is_needed[3], 1);
    expect_all_seen_within(p, low);
}

TEST_F(Fit, WhereNothingCastsOrIsSeenThereIsNoMap) {
    casters_ = {};
    EXPECT_TRUE(fit({1.0, 2.0, 0.5, 0.0}).clip_from_world.empty());
    casters_ = box({-1, 0, -1}, {1, 1, 1});
    seen_.clear();
    EXPECT_TRUE(fit({1.0, 2.0, 0.5, 0.0}).clip_from_world.empty());
    // Casters behind what is seen, as the sun sees it, shadow nothing of it.
    seen_ = {{0, 10, 0}, {1, 10, 0}, {0, 10, 1}, {1, 11, 1}};
    casters_ = box({20, 0, 0}, {21, 1, 1});
    EXPECT_TRUE(fit({0.0, 1.0, 0.0, 0.0}).clip_from_world.empty());
}

TEST(IsOutside, KeepsWhatMayBeWithin) {
    const glm::dmat4 clip = view_from({0, 0, 10}, {0, 0, 0}).clip_from_world();
    EXPECT_FALSE(is_outside(corners_of(box({-1, -1, -1}, {1, 1, 1}), glm::dmat4(1.0)), clip));
    EXPECT_FALSE(is_outside(corners_of(box({-99, -99, -99}, {99, 99, 99}), glm::dmat4(1.0)), clip));
    EXPECT_TRUE(is_outside(corners_of(box({30, -1, -1}, {32, 1, 1}), glm::dmat4(1.0)), clip));
    EXPECT_TRUE(is_outside(corners_of(box({-1, -1, 11}, {1, 1, 12}), glm::dmat4(1.0)), clip));
}

}  // namespace
}  // namespace gnomon::report::internal
