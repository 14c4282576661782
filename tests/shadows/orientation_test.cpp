// SPDX-License-Identifier: MIT
//
// exact_facing and exactly_collinear against two oracles that use integers alone: 128 bits for the
// many cases on grids, and integers without limit for every exponent that a float can have.
#include <gnomon/shadows/orientation.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/shadows/big_integer.hpp"
#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;

__extension__ typedef __int128 Wide;

struct GridPoint {
    std::int64_t x = 0, y = 0, z = 0;
};

GridPoint operator+(GridPoint a, GridPoint b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
GridPoint operator-(GridPoint a, GridPoint b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
GridPoint operator*(std::int64_t k, GridPoint a) { return {k * a.x, k * a.y, k * a.z}; }

template <class Number>
int sign_of(const Number& n) {
    return (n > 0) - (n < 0);
}

std::array<Wide, 3> cross(GridPoint u, GridPoint v) {
    return {Wide{u.y} * v.z - Wide{u.z} * v.y, Wide{u.z} * v.x - Wide{u.x} * v.z,
            Wide{u.x} * v.y - Wide{u.y} * v.x};
}

int grid_facing(GridPoint a, GridPoint b, GridPoint c, GridPoint light, bool directional) {
    const auto n = cross(b - a, c - a);
    const GridPoint t = directional ? light : light - a;
    return sign_of(n[0] * t.x + n[1] * t.y + n[2] * t.z);
}

// Exact for coordinates of at most 24 bits; the common power of two must keep them in range.
glm::vec3 to_float(GridPoint p, int exponent) {
    const auto scaled = [&](std::int64_t v) {
        return static_cast<float>(std::ldexp(static_cast<double>(v), exponent));
    };
    return {scaled(p.x), scaled(p.y), scaled(p.z)};
}

GridPoint random_point(Random& random, int half) {
    return {random.integer(-half, half), random.integer(-half, half), random.integer(-half, half)};
}

struct GridCase {
    GridPoint a, b, c, light;
    bool directional = false;
};

// Half of them with the light in the plane, or one step beside it.
GridCase random_case(Random& random) {
    // Small enough that combinations of three edges still have 24 bits.
    const int half = random.chance(0.5) ? 4 : 1 << random.integer(3, 20);
    GridCase g{random_point(random, half),
               random_point(random, half),
               random_point(random, half),
               {},
               random.chance(0.4)};
    if (random.chance(0.1)) g.c = g.a + random.integer(-1, 2) * (g.b - g.a);  // collinear
    g.light = random_point(random, half);
    if (random.chance(0.6)) {
        g.light = random.integer(-2, 2) * (g.b - g.a) + random.integer(-2, 2) * (g.c - g.a);
        if (!g.directional) g.light = g.light + g.a;
        if (random.chance(0.4)) {
            const int step = random.chance(0.5) ? 1 : -1;
            switch (random.integer(0, 2)) {
                case 0: g.light.x += step; break;
                case 1: g.light.y += step; break;
                default: g.light.z += step;
            }
        }
    }
    return g;
}

LightLocal light_at(const glm::vec3& p, bool directional) {
    return {glm::vec4(p, directional ? 0.0F : 1.0F)};
}

TEST(Orientation, AgreesWithIntegersOnGridsOfEveryScale) {
    GNOMON_RANDOM(random);
    int zeros = 0;
    constexpr int cases = 120'000;
    for (int i = 0; i < cases; ++i) {
        const GridCase g = random_case(random);
        const int expected = grid_facing(g.a, g.b, g.c, g.light, g.directional);
        zeros += expected == 0 ? 1 : 0;
        // 2^24 * 2^103 is the top of the float range, 2^-149 its smallest step.
        const int exponent = random.integer(-149, 103);
        const glm::vec3 a = to_float(g.a, exponent);
        const glm::vec3 b = to_float(g.b, exponent);
        const glm::vec3 c = to_float(g.c, exponent);
        // A direction may have a scale of its own.
        const glm::vec3 l = to_float(g.light, g.directional ? random.integer(-149, 103) : exponent);
        ASSERT_EQ(exact_facing(a, b, c, light_at(l, g.directional)), expected)
            << "case " << i << ", exponent " << exponent << ", directional " << g.directional;
    }
    EXPECT_GT(zeros, cases / 4) << "too few degenerate cases to mean anything";
    EXPECT_LT(zeros, 3 * cases / 4);
}

TEST(Orientation, TurnsItsSignWithTheOrderOfTheCorners) {
    GNOMON_RANDOM(random);
    for (int i = 0; i < 10'000; ++i) {
        const GridCase g = random_case(random);
        const std::array<glm::vec3, 3> p{to_float(g.a, 0), to_float(g.b, 0), to_float(g.c, 0)};
        const LightLocal light = light_at(to_float(g.light, 0), g.directional);
        const int s = exact_facing(p[0], p[1], p[2], light);
        ASSERT_EQ(exact_facing(p[1], p[2], p[0], light), s);
        ASSERT_EQ(exact_facing(p[2], p[0], p[1], light), s);
        ASSERT_EQ(exact_facing(p[0], p[2], p[1], light), -s);
        ASSERT_EQ(exact_facing(p[2], p[1], p[0], light), -s);
        ASSERT_EQ(exact_facing(p[1], p[0], p[2], light), -s);
        if (g.directional) {
            ASSERT_EQ(exact_facing(p[0], p[1], p[2], light_at(-glm::vec3(light.position), true)),
                      -s);
        }
    }
}

TEST(Orientation, FindsCollinearPointsExactly) {
    GNOMON_RANDOM(random);
    int collinear = 0;
    for (int i = 0; i < 30'000; ++i) {
        const int half = random.chance(0.5) ? 3 : 1 << random.integer(3, 20);
        const GridPoint a = random_point(random, half);
        const GridPoint b = random_point(random, half);
        GridPoint c = random_point(random, half);
        if (random.chance(0.6)) c = a + random.integer(-3, 3) * (b - a);
        if (random.chance(0.2)) c.y += 1;
        const auto n = cross(b - a, c - a);
        const bool expected = n[0] == 0 && n[1] == 0 && n[2] == 0;
        collinear += expected ? 1 : 0;
        const int exponent = random.integer(-149, 103);
        ASSERT_EQ(
            exactly_collinear(to_float(a, exponent), to_float(b, exponent), to_float(c, exponent)),
            expected)
            << "case " << i;
    }
    EXPECT_GT(collinear, 8'000);
    EXPECT_LT(collinear, 24'000);
}

// Any finite float at all: normal, subnormal, zero, the largest.
float any_float(Random& random) {
    for (;;) {
        if (random.chance(0.05)) return 0.0F;
        if (random.chance(0.05)) return std::numeric_limits<float>::max();
        if (random.chance(0.05)) return std::numeric_limits<float>::denorm_min();
        const auto value = std::bit_cast<float>(random.bits());
        if (std::isfinite(value)) return value;
    }
}

TEST(Orientation, IsExactForEveryExponentAFloatCanHave) {
    // Differences of floats are multiples of 2^-149 below 2^129, products of three of them
    // multiples of 2^-447 below 2^390: neither end of the double range is reached, so there is no
    // limit to state but that coordinates are finite.
    GNOMON_RANDOM(random);
    int signs[3] = {0, 0, 0};
    for (int i = 0; i < 20'000; ++i) {
        const auto point = [&] {
            return glm::vec3(any_float(random), any_float(random), any_float(random));
        };
        const glm::vec3 a = point();
        const glm::vec3 b = point();
        glm::vec3 c = point();
        glm::vec3 l = point();
        if (random.chance(0.2)) c = b;
        // One coordinate in common puts all four in a plane; then one of them leaves it by one
        // step.
        if (random.chance(0.3)) {
            const float z = any_float(random);
            const float beside = random.chance(0.5) ? z : std::nextafter(z, 0.0F);
            const LightLocal light = light_at({l.x, l.y, beside}, false);
            const glm::vec3 a_flat(a.x, a.y, z);
            const glm::vec3 b_flat(b.x, b.y, z);
            const glm::vec3 c_flat(c.x, c.y, z);
            const int expected = test::integer_facing(a_flat, b_flat, c_flat, light);
            ++signs[expected + 1];
            ASSERT_EQ(exact_facing(a_flat, b_flat, c_flat, light), expected) << "case " << i;
        }
        const LightLocal light = light_at(l, random.chance(0.3));
        const int expected = test::integer_facing(a, b, c, light);
        ++signs[expected + 1];
        ASSERT_EQ(exact_facing(a, b, c, light), expected) << "case " << i;
        const test::BigVector n =
            test::cross(test::big(b) - test::big(a), test::big(c) - test::big(a));
        ASSERT_EQ(exactly_collinear(a, b, c),
                  n[0].sign() == 0 && n[1].sign() == 0 && n[2].sign() == 0)
            << "case " << i;
    }
    for (const int count : signs) EXPECT_GT(count, 1'000);
}

TEST(Orientation, HoldsAtBothEndsOfTheFloatRange) {
    constexpr float huge = std::numeric_limits<float>::max();
    constexpr float tiny = std::numeric_limits<float>::denorm_min();
    const glm::vec3 o(0.0F);
    // The largest triangle there is, lit from one step above and below it.
    const glm::vec3 a(-huge, 0.0F, -huge);
    const glm::vec3 b(-huge, 0.0F, huge);
    const glm::vec3 c(huge, 0.0F, huge);
    EXPECT_EQ(exact_facing(a, b, c, light_at({huge, tiny, huge}, false)), 1);
    EXPECT_EQ(exact_facing(a, b, c, light_at({huge, -tiny, huge}, false)), -1);
    EXPECT_EQ(exact_facing(a, b, c, light_at({huge, 0.0F, huge}, false)), 0);
    // The smallest one.
    const glm::vec3 x(tiny, 0.0F, 0.0F);
    const glm::vec3 y(0.0F, tiny, 0.0F);
    EXPECT_EQ(exact_facing(o, x, y, light_at({0.0F, 0.0F, tiny}, false)), 1);
    EXPECT_EQ(exact_facing(o, x, y, light_at({0.0F, 0.0F, -tiny}, true)), -1);
    EXPECT_EQ(exact_facing(o, x, y, light_at({tiny, tiny, 0.0F}, false)), 0);
    EXPECT_FALSE(exactly_collinear(o, x, y));
    EXPECT_TRUE(exactly_collinear(o, x, {huge, 0.0F, 0.0F}));
    EXPECT_FALSE(exactly_collinear(o, {huge, 0.0F, 0.0F}, {huge, tiny, 0.0F}));
}

TEST(Orientation, TakesTermsThatCancelToZero) {
    // Every difference of two terms (2^24 + 1 needs 25 bits, as a float pair), with cancelling
    // products: zero terms drop out at the front, in the middle and at the end of expansions.
    const float e = 0x1p-30F;
    const glm::vec3 a(1.0F, e, 0.0F);
    const glm::vec3 b(e, 1.0F, e);
    const glm::vec3 c(0.0F, e, 1.0F);
    for (const glm::vec3& on_plane : {a, b, c}) {
        EXPECT_EQ(exact_facing(a, b, c, light_at(on_plane, false)), 0);
        EXPECT_EQ(exact_facing(b, c, a, light_at(on_plane, false)), 0);
    }
    EXPECT_EQ(exact_facing(a, b, c, light_at({0.0F, 0.0F, 0.0F}, true)), 0);
    EXPECT_EQ(exact_facing(a, a, c, light_at({5.0F, 6.0F, 7.0F}, false)), 0);
    EXPECT_EQ(exact_facing(a, b, b, light_at({5.0F, 6.0F, 7.0F}, true)), 0);
}

}  // namespace
}  // namespace gnomon::shadows
