// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <gnomon/scene/primitives.hpp>
#include <gnomon/sun/position.hpp>
#include <gnomon/sun_study/surface_points.hpp>

#include "tests/sun_study/site.hpp"

namespace gnomon::sun_study {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

double area_of(const std::vector<SurfacePoint>& points) {
    double area = 0.0;
    for (const SurfacePoint& point : points) area += point.area_m2;
    return area;
}

TEST(SurfacePoints, CoverWallsAndRoofsAndNoFloors) {
    const std::vector<shadows::Caster> box{
        test::caster_of(1, scene::make_box({4.0F, 3.0F, 2.0F}), {100.0, 200.0, 1.5})};
    const auto points = sample_surfaces(box, 0.4, 100000);
    ASSERT_TRUE(points) << points.error().message;
    EXPECT_NEAR(area_of(*points), 2.0 * 4.0 * 3.0 + 2.0 * 2.0 * 3.0 + 4.0 * 2.0, 1e-6);
    for (const SurfacePoint& point : *points) {
        EXPECT_NEAR(glm::length(point.normal_plan), 1.0, 1e-12);
        EXPECT_GE(point.normal_plan.z, -1e-9);
        // Away from the middle of the box.
        EXPECT_GT(glm::dot(point.normal_plan, point.at_plan - glm::dvec3(100.0, 200.0, 1.5)), 0.9);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_LE(glm::distance(point.corners_plan[k], point.corners_plan[(k + 1) % 3]), 0.4);
        }
    }
    EXPECT_THAT(sample_surfaces(box, 0.01, 1000).error().message,
                testing::HasSubstr("more than 1000 points"));
}

TEST(SurfacePoints, OfAMirroredPoseLookOutwards) {
    std::vector<shadows::Caster> box{
        test::caster_of(1, scene::make_box({4.0F, 3.0F, 2.0F}), {100.0, 200.0, 1.5})};
    box[0].world_from_local = box[0].world_from_local *
                              glm::dmat4(glm::dmat3(-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0));
    const auto points = sample_surfaces(box, 0.4, 100000);
    ASSERT_TRUE(points) << points.error().message;
    EXPECT_NEAR(area_of(*points), 2.0 * 4.0 * 3.0 + 2.0 * 2.0 * 3.0 + 4.0 * 2.0, 1e-6);
    double roof = 0.0;
    for (const SurfacePoint& point : *points) {
        EXPECT_GT(glm::dot(point.normal_plan, point.at_plan - glm::dvec3(100.0, 200.0, 1.5)), 0.9);
        if (point.normal_plan.z > 0.9) roof += point.area_m2;
    }
    EXPECT_NEAR(roof, 8.0, 1e-6);
}

// Turned by 20 degrees about the plan's x, one wall of a box leans out and has a low sun.
TEST(SurfacePoints, HaveWallsThatLeanOut) {
    std::vector<shadows::Caster> box{
        test::caster_of(1, scene::make_box({4.0F, 3.0F, 2.0F}), {0.0, 0.0, 5.0})};
    const double c = std::cos(20.0 * degree);
    const double s = std::sin(20.0 * degree);
    box[0].world_from_local =
        box[0].world_from_local * glm::dmat4(glm::dmat3(1.0, 0.0, 0.0, 0.0, c, s, 0.0, -s, c));
    const auto points = sample_surfaces(box, 0.4, 100000);
    ASSERT_TRUE(points);
    shadows::ShadowQueries queries;
    queries.update(box);
    std::size_t leaning = 0;
    for (const double azimuth : {0.0, 180.0}) {
        const std::vector<std::uint8_t> lit =
            lit_points(queries, *points, sun::towards_sun(azimuth * degree, 10.0 * degree));
        for (std::size_t i = 0; i < lit.size(); ++i) {
            const glm::dvec3& normal = (*points)[i].normal_plan;
            if (std::abs(normal.z + s) > 1e-6) continue;  // not the one that leans out
            const bool turned_to_sun = (azimuth < 90.0) == (normal.y > 0.0);
            EXPECT_EQ(lit[i], turned_to_sun ? 1 : 0);
            leaning += lit[i];
        }
    }
    EXPECT_GT(leaning, 10U);
}

// A wall of 6 m stands 4 m south of another that looks south. With the sun in the south at an
// altitude whose tangent is 0.5, the shadow reaches 6 - 4 * 0.5 = 4 m up.
TEST(SurfacePoints, AreInShadowUpToWhereGeometryHasIt) {
    const std::vector<shadows::Caster> walls{
        test::caster_of(1, scene::make_box({20.0F, 8.0F, 0.2F}), {0.0, 0.1, 4.0}),
        test::caster_of(2, scene::make_box({200.0F, 6.0F, 0.2F}), {0.0, -4.1, 3.0})};
    shadows::ShadowQueries queries;
    queries.update(walls);
    const auto points = sample_surfaces({walls.data(), 1}, 0.25, 1000000);
    ASSERT_TRUE(points);
    const glm::dvec3 sun = sun::towards_sun(180.0 * degree, std::atan(0.5));
    const std::vector<std::uint8_t> lit = lit_points(queries, *points, sun);
    ASSERT_EQ(lit.size(), points->size());
    EXPECT_EQ(lit_points(queries, *points, sun, shadows::thread_jobs(3)), lit);
    std::size_t south = 0;
    for (std::size_t i = 0; i < lit.size(); ++i) {
        const SurfacePoint& point = (*points)[i];
        if (std::abs(point.normal_plan.x) > 0.5) continue;  // in the plane of the light
        if (point.normal_plan.y > -0.5) {
            // Roof in the sun; the back sees none of it.
            EXPECT_EQ(lit[i], point.normal_plan.z > 0.5 ? 1 : 0);
            continue;
        }
        ++south;
        if (std::abs(point.at_plan.z - 4.0) > 0.01) {
            EXPECT_EQ(lit[i], point.at_plan.z > 4.0 ? 1 : 0) << point.at_plan.z;
        }
    }
    EXPECT_GT(south, 1000U);
}

}  // namespace
}  // namespace gnomon::sun_study
