// SPDX-License-Identifier: MIT
//
// The projections' promises: reversed depth, 1 at the near plane, exactly 0 at infinity; and the
// corners of near and far rectangles, also far from the origin.
#include <gnomon/shadows/view.hpp>

#include <cmath>

#include <gtest/gtest.h>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

double depth(const glm::dmat4& clip_from_view, double z) {
    const glm::dvec4 clip = clip_from_view * glm::dvec4(0.3, -0.2, z, 1.0);
    return clip.z / clip.w;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    EXPECT_LT(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(View, InfinitePerspectivePutsInfinityAtDepthZeroExactly) {
    const glm::dmat4 m = infinite_perspective(1.0, 1.6, 0.25);
    EXPECT_DOUBLE_EQ(depth(m, -0.25), 1.0);
    EXPECT_DOUBLE_EQ(depth(m, -0.5), 0.5);
    const glm::dvec4 far = m * glm::dvec4(1.0, 2.0, -3.0, 0.0);
    EXPECT_EQ(far.z, 0.0);
    EXPECT_EQ(far.w, 3.0);
    const glm::dvec4 top = m * glm::dvec4(0.0, std::tan(0.5), -1.0, 1.0);
    EXPECT_NEAR(top.y / top.w, 1.0, 1e-15);
    const glm::dvec4 right = m * glm::dvec4(1.6 * std::tan(0.5), 0.0, -1.0, 1.0);
    EXPECT_NEAR(right.x / right.w, 1.0, 1e-15);
}

TEST(View, FiniteProjectionsRunFromOneToZero) {
    const glm::dmat4 perspective = finite_perspective(1.0, 1.0, 0.5, 40.0);
    EXPECT_NEAR(depth(perspective, -0.5), 1.0, 1e-14);
    EXPECT_NEAR(depth(perspective, -40.0), 0.0, 1e-14);
    const glm::dmat4 parallel = orthographic(2.0, 3.0, -5.0, 15.0);
    EXPECT_NEAR(depth(parallel, 5.0), 1.0, 1e-14);
    EXPECT_NEAR(depth(parallel, -15.0), 0.0, 1e-14);
    const glm::dvec4 corner = parallel * glm::dvec4(2.0, -3.0, 0.0, 1.0);
    EXPECT_DOUBLE_EQ(corner.x, 1.0);
    EXPECT_DOUBLE_EQ(corner.y, -1.0);
}

TEST(View, LookAtIsRigidAndLooksDownNegativeZ) {
    GNOMON_RANDOM(random);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 eye = random.in_cube(100.0);
        const glm::dvec3 target = random.in_cube(100.0);
        const glm::dmat4 m = look_at(eye, target, {0, 1, 0});
        expect_near(glm::dvec3(m * glm::dvec4(eye, 1.0)), {0, 0, 0}, 1e-12);
        expect_near(glm::dvec3(m * glm::dvec4(target, 1.0)), {0, 0, -glm::length(target - eye)},
                    1e-12);
        EXPECT_NEAR(glm::determinant(glm::dmat3(m)), 1.0, 1e-12);
        EXPECT_GT((m * glm::dvec4(0, 1, 0, 0)).y, 0.0) << "up is up";
    }
}

TEST(View, NearCornersGoRoundTheRectangle) {
    View view;
    view.view_from_world = look_at({1, 2, 3}, {1, 2, -7}, {0, 1, 0});
    view.clip_from_view = infinite_frustum(-0.1, 0.3, -0.2, 0.4, 0.5);
    const auto c = near_corners(view);
    expect_near(c[0], {0.9, 1.8, 2.5}, 1e-12);
    expect_near(c[1], {1.3, 1.8, 2.5}, 1e-12);
    expect_near(c[2], {1.3, 2.4, 2.5}, 1e-12);
    expect_near(c[3], {0.9, 2.4, 2.5}, 1e-12);
}

TEST(View, FarCornersLieOnTheFarPlane) {
    View view;
    view.view_from_world = look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0});
    view.projection = ProjectionKind::FinitePerspective;
    view.clip_from_view = finite_perspective(2.0 * std::atan(0.5), 2.0, 1.0, 20.0);
    expect_near(far_corners(view)[2], {20, 10, -20}, 1e-10);
    view.projection = ProjectionKind::Orthographic;
    view.clip_from_view = orthographic(3.0, 2.0, 1.0, 20.0);
    expect_near(far_corners(view)[0], {-3, -2, -20}, 1e-10);
    expect_near(near_corners(view)[2], {3, 2, -1}, 1e-12);
}

TEST(View, NearCornersStaySharpFarFromTheOrigin) {
    GNOMON_RANDOM(random);
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 eye = 1e6 * random.unit_vector();
        const double near_m = 1e-3;
        View view;
        view.view_from_world = look_at(eye, eye + random.unit_vector(), random.unit_vector());
        view.clip_from_view = infinite_perspective(1.2, 1.5, near_m);
        const glm::dmat4 world_from_view = glm::inverse(view.view_from_world);
        const double h = near_m * std::tan(0.6);
        const glm::dvec3 in_view(-1.5 * h, -h, -near_m);
        const glm::dvec3 expected(world_from_view * glm::dvec4(in_view, 1.0));
        // A world coordinate of 1e6 has steps of 1e-10.
        expect_near(near_corners(view)[0], expected, 1e-3 * near_m);
    }
}

}  // namespace
}  // namespace gnomon::shadows
