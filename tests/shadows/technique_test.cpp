// SPDX-License-Identifier: MIT
//
// depth_pass_is_valid never says true where some point of the caster shadows some point of the near
// rectangle, and says true in most of the clear cases.
#include <gnomon/shadows/technique.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "internal/near_clip.hpp"
#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;

struct Situation {
    OrientedBounds bounds;
    glm::dvec4 light{0.0};
    View view;
};

View random_view(Random& random, const glm::dvec3& eye, const glm::dvec3& target) {
    View view;
    view.view_from_world = look_at(eye, target, random.unit_vector());
    const double near_m = std::pow(10.0, random.uniform(-3.0, 0.5));
    switch (random.integer(0, 3)) {
        case 0:
            view.clip_from_view =
                infinite_perspective(random.uniform(0.1, 2.9), random.uniform(0.5, 2.0), near_m);
            break;
        case 1: {  // off-axis, the axis perhaps outside the picture
            const double left = near_m * random.uniform(-2.0, 1.0);
            const double bottom = near_m * random.uniform(-2.0, 1.0);
            view.clip_from_view =
                infinite_frustum(left, left + near_m * random.uniform(0.05, 2.0), bottom,
                                 bottom + near_m * random.uniform(0.05, 2.0), near_m);
            break;
        }
        case 2:
            view.projection = ProjectionKind::FinitePerspective;
            view.clip_from_view = finite_perspective(random.uniform(0.1, 2.9), 1.3, near_m,
                                                     near_m + random.uniform(1.0, 100.0));
            break;
        default:
            view.projection = ProjectionKind::Orthographic;
            view.clip_from_view = orthographic(random.uniform(0.05, 5.0), random.uniform(0.05, 5.0),
                                               random.uniform(-5.0, 5.0), 50.0);
    }
    return view;
}

glm::dvec3 on_near_rectangle(const std::array<glm::dvec3, 4>& c, double u, double v) {
    return glm::mix(glm::mix(c[0], c[1], u), glm::mix(c[3], c[2], u), v);
}

Situation random_situation(Random& random) {
    Situation s;
    const glm::dvec3 origin =
        random.chance(0.3) ? random.unit_vector() * 1e5 : glm::dvec3(random.in_cube(1.0));
    glm::dmat3 linear = random.rotation();
    for (int i = 0; i < 3; ++i) linear[i] *= std::pow(10.0, random.uniform(-1.5, 0.7));
    if (random.chance(0.2)) linear[0] *= -1.0;
    if (random.chance(0.2)) linear[1] += 0.7 * linear[0];  // sheared
    if (random.chance(0.1)) linear[2] *= 0.0;              // flat
    s.bounds.world_from_local = glm::dmat4(linear);
    s.bounds.world_from_local[3] = glm::dvec4(origin + random.in_cube(1.0), 1.0);
    s.bounds.min = random.in_cube(1.0);
    s.bounds.max = s.bounds.min + glm::abs(random.in_cube(2.0));
    s.light = random.chance(0.4) ? glm::dvec4(random.unit_vector() * random.uniform(0.1, 50.0), 0.0)
                                 : glm::dvec4(origin + random.in_cube(10.0), 1.0);
    s.view = random_view(random, origin + random.in_cube(6.0), origin + random.in_cube(1.0));
    if (random.chance(0.6)) {
        // A light behind some point of the caster, as seen from a point on or just beside the near
        // rectangle.
        const glm::dvec3 t(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
        const glm::dvec3 p(s.bounds.world_from_local *
                           glm::dvec4(glm::mix(s.bounds.min, s.bounds.max, t), 1.0));
        const glm::dvec3 r = on_near_rectangle(near_corners(s.view), random.uniform(-0.5, 1.5),
                                               random.uniform(-0.5, 1.5));
        s.light = s.light.w == 0.0 ? glm::dvec4(p - r, 0.0)
                                   : glm::dvec4(r + (p - r) * random.uniform(1.0, 5.0), 1.0);
    }
    return s;
}

// Whether the way from r to the light meets the box: exact but for the rounding of doubles. Flat
// poses are looked at through points of the box instead, by the caller.
bool meets(const Situation& s, const glm::dvec3& r) {
    const glm::dmat3 inverse = glm::inverse(glm::dmat3(s.bounds.world_from_local));
    const glm::dvec3 from = inverse * (r - glm::dvec3(s.bounds.world_from_local[3]));
    const glm::dvec3 towards =
        inverse * (s.light.w == 0.0 ? glm::dvec3(s.light) : glm::dvec3(s.light) - r);
    double enter = 0.0;
    double leave = s.light.w == 0.0 ? std::numeric_limits<double>::infinity() : 1.0;
    for (int i = 0; i < 3; ++i) {
        if (towards[i] == 0.0) {
            if (from[i] < s.bounds.min[i] || from[i] > s.bounds.max[i]) return false;
            continue;
        }
        const double a = (s.bounds.min[i] - from[i]) / towards[i];
        const double b = (s.bounds.max[i] - from[i]) / towards[i];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

// Some point of a box of no thickness on the way from the rectangle to the light?
bool meets_flat(Random& random, const Situation& s, const std::array<glm::dvec3, 4>& corners) {
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 t(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
        const glm::dvec3 local = glm::mix(s.bounds.min, s.bounds.max, t);
        const glm::dvec3 p(s.bounds.world_from_local * glm::dvec4(local, 1.0));
        const glm::dvec3 away = s.light.w == 0.0 ? -glm::dvec3(s.light) : p - glm::dvec3(s.light);
        const glm::dvec3 n = glm::cross(corners[1] - corners[0], corners[3] - corners[0]);
        const double along = glm::dot(n, away);
        if (along == 0.0) continue;
        const double k = glm::dot(n, corners[0] - p) / along;
        if (k < 0.0) continue;
        const glm::dvec3 hit = p + k * away - corners[0];
        const glm::dvec3 u = corners[1] - corners[0];
        const glm::dvec3 v = corners[3] - corners[0];
        const double a = glm::dot(hit, u) / glm::dot(u, u);
        const double b = glm::dot(hit, v) / glm::dot(v, v);
        if (a >= 0.0 && a <= 1.0 && b >= 0.0 && b <= 1.0) return true;
    }
    return false;
}

bool some_shadow_reaches(Random& random, const Situation& s, int samples) {
    const auto corners = near_corners(s.view);
    if (glm::determinant(glm::dmat3(s.bounds.world_from_local)) == 0.0) {
        return meets_flat(random, s, corners);
    }
    for (int i = 0; i < samples; ++i) {
        // Corners and borders first, where a separating axis would be just wrong.
        const double u = i < 4 ? i & 1 : random.uniform(0.0, 1.0);
        const double v = i < 4 ? i >> 1 : (i % 4 == 0 ? 1.0 : random.uniform(0.0, 1.0));
        if (meets(s, on_near_rectangle(corners, u, v))) return true;
    }
    return false;
}

TEST(Technique, DepthPassIsNeverValidWhereAShadowReachesTheNearRectangle) {
    GNOMON_RANDOM(random);
    int reached = 0;
    int clear = 0;
    int clear_and_valid = 0;
    for (int i = 0; i < 30'000; ++i) {
        const Situation s = random_situation(random);
        const bool valid = depth_pass_is_valid(s.bounds, s.light, s.view);
        if (some_shadow_reaches(random, s, 60)) {
            ++reached;
            ASSERT_FALSE(valid) << "situation " << i;
        } else {
            ++clear;
            clear_and_valid += valid ? 1 : 0;
        }
    }
    EXPECT_GT(reached, 5'000);
    EXPECT_GT(clear, 5'000);
    // Not trivially false: what is lost is what lies within the widened rectangle.
    EXPECT_GT(clear_and_valid, clear * 8 / 10);
}

TEST(Technique, ASphereIsClearOnlyWhereAllThatItHoldsIs) {
    GNOMON_RANDOM(random);
    int clear = 0;
    int told_by_sphere = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Situation s = random_situation(random);
        const auto corners = corners_of(s.bounds);
        glm::dvec3 center(0.0);
        for (const auto& corner : corners) center += corner * 0.125;
        double radius = 0.0;
        for (const auto& corner : corners) radius = std::max(radius, glm::length(corner - center));
        const internal::NearClip clip(s.light, s.view);
        const bool valid = depth_pass_is_valid(s.bounds, s.light, s.view);
        clear += valid ? 1 : 0;
        if (!clip.is_clear_of_sphere(center, radius)) continue;
        ++told_by_sphere;
        ASSERT_TRUE(valid) << "situation " << i;
    }
    EXPECT_GT(told_by_sphere, clear / 2);
}

// Whether the way from r to the light passes a face; not where it all but runs along an edge.
bool passes(const ShadowMesh& mesh, const glm::dmat4& pose, const glm::dvec4& light,
            const glm::dvec3& r) {
    const glm::dvec3 way = light.w == 0.0 ? glm::dvec3(light) : glm::dvec3(light) - r;
    return std::ranges::any_of(mesh.faces(), [&](const auto& face) {
        std::array<glm::dvec3, 3> d;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 p(mesh.positions()[face[i]]);
            d[i] = glm::dvec3(pose * glm::dvec4(p, 1.0)) - r;
        }
        const double side = glm::dot(way, glm::cross(d[0], d[1]));
        if (side * glm::dot(way, glm::cross(d[1], d[2])) <= 0.0) return false;
        if (side * glm::dot(way, glm::cross(d[2], d[0])) <= 0.0) return false;
        const glm::dvec3 n = glm::cross(d[1] - d[0], d[2] - d[0]);
        const double along = glm::dot(n, d[0]) / glm::dot(n, way);
        return along > 0.0 && (light.w == 0.0 || along < 1.0);
    });
}

TEST(Technique, AMeshIsClearOnlyWhereNoFaceShadowsTheNearRectangle) {
    GNOMON_RANDOM(random);
    int clear = 0;
    int clear_within_bounds = 0;
    int shadowed = 0;
    for (int i = 0; i < 12'000; ++i) {
        Situation s = random_situation(random);
        const auto mesh = test::build(test::random_mesh(random));
        s.bounds.min = glm::dvec3(mesh->bounds_min());
        s.bounds.max = glm::dvec3(mesh->bounds_max());
        const internal::NearClip clip(s.light, s.view);
        const bool is_clear = clip.is_clear_of(*mesh, s.bounds.world_from_local);
        clear += is_clear ? 1 : 0;
        clear_within_bounds += is_clear && !clip.is_clear_of(s.bounds) ? 1 : 0;
        const auto corners = near_corners(s.view);
        for (int point = 0; point < 30; ++point) {
            const glm::dvec3 r =
                on_near_rectangle(corners, random.uniform(0, 1), random.uniform(0, 1));
            if (!passes(*mesh, s.bounds.world_from_local, s.light, r)) continue;
            ++shadowed;
            ASSERT_FALSE(is_clear) << "situation " << i;
        }
    }
    EXPECT_GT(clear, 1'000);
    EXPECT_GT(clear_within_bounds, 200);
    EXPECT_GT(shadowed, 1'000);
}

TEST(Technique, SweepsThroughAShadowsSideInSmallSteps) {
    // A unit box under a sun straight above; the eye below it walks out of the shadow.
    OrientedBounds box{glm::dmat4(1.0), glm::dvec3(-0.5), glm::dvec3(0.5)};
    const glm::dvec4 sun(0, 1, 0, 0);
    const double near_m = 0.01;
    const double half = near_m * std::tan(0.5);
    bool was_valid = false;
    for (int i = 0; i <= 10'000; ++i) {
        const double x = 1e-4 * i;
        View view{look_at({x, -2, 0}, {x, -2, -1}, {0, 1, 0}),
                  infinite_perspective(1.0, 1.0, near_m)};
        const bool valid = depth_pass_is_valid(box, sun, view);
        if (x - half <= 0.5) {
            ASSERT_FALSE(valid) << x;
        } else if (x > 0.5 + 2.0 * half) {
            ASSERT_TRUE(valid) << x;
        }
        ASSERT_TRUE(valid || !was_valid) << "it changes once";
        was_valid = valid;
    }
}

TEST(Technique, KnowsClearCases) {
    const OrientedBounds box{glm::dmat4(1.0), glm::dvec3(-0.5), glm::dvec3(0.5)};
    const View beside{look_at({5, 0, 0}, {0, 0, 0}, {0, 1, 0}),
                      infinite_perspective(1.0, 1.5, 0.1)};
    EXPECT_TRUE(depth_pass_is_valid(box, {0, 1, 0, 0}, beside));
    EXPECT_TRUE(depth_pass_is_valid(box, {0, 9, 0, 1}, beside));
    EXPECT_TRUE(depth_pass_is_valid(box, {9, 0.1, 0, 1}, beside)) << "light behind the eye";
    EXPECT_FALSE(depth_pass_is_valid(box, {-9, 0, 0, 1}, beside)) << "eye in the shadow";
    EXPECT_FALSE(depth_pass_is_valid(box, {-1, 0, 0, 0}, beside));
    EXPECT_TRUE(depth_pass_is_valid(box, {3, 0, 0, 1}, beside)) << "light between caster and eye";
    const View inside{look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}),
                      infinite_perspective(1.0, 1.5, 0.1)};
    EXPECT_FALSE(depth_pass_is_valid(box, {0, 1, 0, 0}, inside))
        << "the caster is at the near plane";
}

TEST(Technique, DoubtIsDepthFail) {
    const OrientedBounds box{glm::dmat4(1.0), glm::dvec3(-0.5), glm::dvec3(0.5)};
    const View view{look_at({5, 0, 0}, {0, 0, 0}, {0, 1, 0}), infinite_perspective(1.0, 1.5, 0.1)};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(depth_pass_is_valid(box, {nan, 1, 0, 0}, view));
    OrientedBounds broken = box;
    broken.world_from_local[3].x = nan;
    EXPECT_FALSE(depth_pass_is_valid(broken, {0, 1, 0, 0}, view));
    View shapeless = view;
    shapeless.clip_from_view = glm::dmat4(0.0);
    EXPECT_FALSE(depth_pass_is_valid(box, {0, 1, 0, 0}, shapeless));
}

}  // namespace
}  // namespace gnomon::shadows
