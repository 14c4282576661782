// SPDX-License-Identifier: MIT
//
// classify_faces: every weight is the exact one, the kind of casting is chosen per component, and
// the margin is a promise: a light that moves by less changes no weight.
#include <gnomon/shadows/facing.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/shadows/orientation.hpp>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;
using test::Triangles;

LightLocal point(float x, float y, float z) { return {{x, y, z, 1.0F}}; }
LightLocal direction(float x, float y, float z) { return {{x, y, z, 0.0F}}; }

// The rule, said again in other words and with the exact predicate alone.
std::vector<std::int8_t> exact_weights(const ShadowMesh& mesh, LightLocal light,
                                       NearCaps near_caps = NearCaps::Facing) {
    std::vector<std::int8_t> weights;
    for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
        const Component& c = mesh.components()[mesh.face_components()[f]];
        const glm::vec3 l(light.position);
        bool solid = c.closed;
        if (!light.is_directional()) {
            bool within = true;
            for (int i = 0; i < 3; ++i) {
                within = within && l[i] >= c.bounds_min[i] && l[i] <= c.bounds_max[i];
            }
            solid = solid && !within;
        }
        const auto& [a, b, d] = mesh.faces()[f];
        const auto p = mesh.positions();
        const int side = exact_facing(p[a], p[b], p[d], light);
        const bool towards = near_caps == NearCaps::Facing && !c.inside_out;
        const bool casts = !solid || side == (towards ? 1 : -1);
        weights.push_back(static_cast<std::int8_t>(casts ? side : 0));
    }
    return weights;
}

Facing classified(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps = NearCaps::Facing) {
    Facing facing;
    classify_faces(mesh, light, facing, near_caps);
    return facing;
}

// ---------------------------------------------------------------------------------------------
// The filters

TEST(Facing, WeightsAreExactForAnyMeshAnyLightAnywhere) {
    GNOMON_RANDOM(random);
    std::uint64_t exact = 0;
    std::uint64_t in_double = 0;
    std::uint64_t faces = 0;
    for (int i = 0; i < 2'500; ++i) {
        Triangles triangles = test::random_mesh(random);
        const double far = i % 4 == 0 ? 0.0 : std::pow(10.0, 3.0 * (i % 4 - 1));  // 1, 1e3, 1e6
        triangles = test::moved(std::move(triangles), glm::vec3(far * random.unit_vector()));
        const auto mesh = test::build(triangles);
        for (int j = 0; j < 6; ++j) {
            const LightLocal light = test::random_light(random, *mesh);
            const Facing facing = classified(*mesh, light);
            ASSERT_EQ(facing.weights, exact_weights(*mesh, light))
                << "mesh " << i << " light " << j;
            ASSERT_GE(facing.margin, 0.0);
            exact += facing.stats.exact_tests;
            in_double += facing.stats.double_tests;
            faces += facing.stats.faces;
        }
    }
    // All three stages were at work.
    EXPECT_GT(exact, faces / 1000);
    EXPECT_GT(in_double, exact);
    EXPECT_LT(in_double, faces);
}

TEST(Facing, WeightsAreExactForSlivers) {
    GNOMON_RANDOM(random);
    for (int i = 0; i < 400; ++i) {
        Triangles triangles;
        for (int t = 0; t < 20; ++t) {
            // Long thin triangles whose third corner lies within rounding of the others' line.
            const glm::dvec3 a = random.in_cube(1.0);
            const glm::dvec3 b = a + random.unit_vector() * random.uniform(1.0, 1e3);
            const glm::dvec3 c = glm::mix(a, b, random.uniform(-1.0, 2.0)) +
                                 random.unit_vector() * std::pow(10.0, random.uniform(-9.0, -3.0));
            for (const glm::dvec3& p : {a, b, c}) {
                triangles.indices.push_back(static_cast<std::uint32_t>(triangles.positions.size()));
                triangles.positions.emplace_back(p);
            }
        }
        const auto mesh = test::build(triangles);
        for (int j = 0; j < 5; ++j) {
            const LightLocal light = test::random_light(random, *mesh);
            ASSERT_EQ(classified(*mesh, light).weights, exact_weights(*mesh, light))
                << "mesh " << i << " light " << j;
        }
    }
}

TEST(Facing, WeightsAreExactWhenCoordinatesSpanSixtyPowersOfTwo) {
    GNOMON_RANDOM(random);
    for (int i = 0; i < 300; ++i) {
        const auto mesh = test::build(test::wild_soup(random, 20));
        for (int j = 0; j < 5; ++j) {
            LightLocal light = test::random_light(random, *mesh);
            if (j == 0) light.position *= 0x1p-60F;
            if (light.position.w != 0.0F) light.position.w = 1.0F;
            ASSERT_EQ(classified(*mesh, light).weights, exact_weights(*mesh, light))
                << "mesh " << i << " light " << j;
        }
    }
}

TEST(Facing, SurvivesPlanesThatOverflowOrVanishInSinglePrecision) {
    for (const float scale : {1e-30F, 1e-22F, 1e-15F, 1e15F, 1e19F, 1e30F}) {
        Triangles triangles = test::box();
        for (glm::vec3& p : triangles.positions) p *= scale;
        const auto mesh = test::build(triangles);
        EXPECT_EQ(mesh->report().degenerate_faces, 0U);
        for (const glm::vec3 at :
             {glm::vec3(3, 5, 7), glm::vec3(3, 0.5, -0.5), glm::vec3(-2, 1, 0)}) {
            const LightLocal light{{at * scale, 1.0F}};
            EXPECT_EQ(classified(*mesh, light).weights, exact_weights(*mesh, light)) << scale;
            const LightLocal sun{{at, 0.0F}};
            EXPECT_EQ(classified(*mesh, sun).weights, exact_weights(*mesh, sun)) << scale;
        }
    }
}

TEST(Facing, TakesALightBeyondTheFloatRangeWithoutCasting) {
    const auto mesh = test::build(test::box());
    const float inf = std::numeric_limits<float>::infinity();
    for (const LightLocal light : {point(inf, 0, 0), point(-inf, inf, 1), direction(0, inf, 0),
                                   point(std::nanf(""), 0, 0), direction(0, 0, 0)}) {
        const Facing facing = classified(*mesh, light);
        for (const int weight : facing.weights) EXPECT_EQ(weight, 0);
        EXPECT_EQ(facing.margin, 0.0);
    }
}

TEST(Facing, CountsItsTests) {
    const auto mesh = test::build(test::box());
    const Facing away = classified(*mesh, point(5.0F, 6.0F, 7.0F));
    EXPECT_EQ(away.stats.faces, 12U);
    EXPECT_EQ(away.stats.double_tests, 0U);
    EXPECT_EQ(away.stats.exact_tests, 0U);
    // In the plane of the top, which is a plane of the grid: all products are zero.
    const Facing grazing = classified(*mesh, point(5.0F, 1.0F, 7.0F));
    EXPECT_EQ(grazing.stats.double_tests, 2U);
    EXPECT_EQ(grazing.stats.exact_tests, 0U);
    // In a slanting plane: they only cancel.
    const auto slant = test::build(test::tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}));
    const Facing cancelling = classified(*slant, point(3.0F, -3.0F, 1.0F));
    EXPECT_EQ(cancelling.stats.double_tests, 1U);
    EXPECT_EQ(cancelling.stats.exact_tests, 1U);
}

// ---------------------------------------------------------------------------------------------
// One-sided and two-sided

int count_of(const Facing& facing, int weight) {
    return static_cast<int>(std::count(facing.weights.begin(), facing.weights.end(), weight));
}

TEST(Facing, ClosedCastsTowardsALightOutsideAndBothWaysInside) {
    const auto mesh = test::build(test::box());
    const Facing outside = classified(*mesh, point(3.0F, 0.5F, 0.25F));
    EXPECT_EQ(count_of(outside, 1), 2);
    EXPECT_EQ(count_of(outside, -1), 0);
    const Facing corner = classified(*mesh, point(3.0F, 4.0F, 5.0F));
    EXPECT_EQ(count_of(corner, 1), 6);
    EXPECT_EQ(count_of(corner, -1), 0);
    const Facing inside = classified(*mesh, point(0.5F, 0.25F, 0.125F));
    EXPECT_EQ(count_of(inside, 1), 0);
    EXPECT_EQ(count_of(inside, -1), 12);
    const Facing sun = classified(*mesh, direction(0.25F, 1.0F, 0.5F));
    EXPECT_EQ(count_of(sun, 1), 6);
    EXPECT_EQ(count_of(sun, -1), 0);
}

TEST(Facing, ALightOnTheBoundsCountsAsInside) {
    const auto mesh = test::build(test::sphere(6, 8));
    const Component& component = mesh->components()[0];
    // Beside the sphere, on the box about it: two-sided.
    const Facing on = classified(*mesh, point(0.75F, component.bounds_max.y, 0.75F));
    EXPECT_GT(count_of(on, -1), 0);
    const Facing above =
        classified(*mesh, point(0.75F, std::nextafter(component.bounds_max.y, 9.0F), 0.75F));
    EXPECT_EQ(count_of(above, -1), 0);
    EXPECT_GT(count_of(above, 1), 0);
}

TEST(Facing, OpenAndInconsistentComponentsCastBothWays) {
    Triangles open = test::box();
    test::remove_face(open, 0);
    EXPECT_EQ(count_of(classified(*test::build(open), point(3, 4, 5)), 0), 0);
    Triangles flipped = test::box();
    test::flip_face(flipped, 3);
    EXPECT_EQ(count_of(classified(*test::build(flipped), point(3, 4, 5)), 0), 0);
    Triangles repeated = test::box();
    test::repeat_face(repeated, 0);
    EXPECT_EQ(count_of(classified(*test::build(repeated), point(3, 4, 5)), 0), 0);
}

TEST(Facing, InsideOutCastsTheAvertedFaces) {
    const auto mesh = test::build(test::inside_out(test::box()));
    ASSERT_TRUE(mesh->components()[0].inside_out);
    const Facing facing = classified(*mesh, point(3.0F, 0.5F, 0.25F));
    EXPECT_EQ(count_of(facing, -1), 2);
    EXPECT_EQ(count_of(facing, 1), 0);
}

TEST(Facing, ChoosesTheKindForEachComponent) {
    // A closed box, an inside-out box and an open sheet in one mesh; the light is inside the first.
    const Triangles all =
        test::merged(test::merged(test::box(), test::inside_out(test::box({4, -1, -1}, {6, 1, 1}))),
                     test::moved(test::sheet(1), {0, -5, 0}));
    const auto mesh = test::build(all);
    ASSERT_EQ(mesh->components().size(), 3U);
    const Facing facing = classified(*mesh, point(0.5F, 0.25F, 0.125F));
    const auto part = [&](std::size_t first, std::size_t count, int weight) {
        std::size_t found = 0;
        for (std::size_t f = 0; f < facing.weights.size(); ++f) {
            const std::size_t input = mesh->input_faces()[f];
            if (input >= first && input < first + count && facing.weights[f] == weight) ++found;
        }
        return found;
    };
    EXPECT_EQ(part(0, 12, -1), 12U);
    EXPECT_EQ(part(12, 12, -1), 2U);
    EXPECT_EQ(part(12, 12, 0), 10U);
    EXPECT_EQ(part(24, 2, 1), 2U);
}

// ---------------------------------------------------------------------------------------------
// Near caps on averted faces

TEST(Facing, ASolidCastsWithItsAvertedFacesWhereAsked) {
    const auto mesh = test::build(test::box());
    for (const LightLocal light : {point(3.0F, 4.0F, 5.0F), direction(0.25F, 1.0F, 0.5F)}) {
        const Facing averted = classified(*mesh, light, NearCaps::Averted);
        EXPECT_EQ(count_of(averted, -1), 6);
        EXPECT_EQ(count_of(averted, 1), 0);
        EXPECT_EQ(averted.solid_averted, std::vector<std::uint8_t>{1});
        const Facing facing = classified(*mesh, light, NearCaps::Facing);
        EXPECT_EQ(averted.margin, facing.margin) << "the same faces change at the same places";
        EXPECT_EQ(facing.solid_averted, std::vector<std::uint8_t>{0});
    }
}

TEST(Facing, WhatIsNotASolidCastsAlikeForEitherKindOfNearCaps) {
    Triangles open = test::box();
    test::remove_face(open, 0);
    const std::vector<std::pair<Triangles, LightLocal>> others{
        {test::box(), point(0.5F, 0.25F, 0.125F)},  // the light inside
        {open, point(3.0F, 4.0F, 5.0F)},
        {test::book(5), direction(0.3F, 0.2F, 0.1F)},
        {test::inside_out(test::box()), point(3.0F, 4.0F, 5.0F)},
    };
    for (const auto& [triangles, light] : others) {
        const auto mesh = test::build(triangles);
        const Facing averted = classified(*mesh, light, NearCaps::Averted);
        EXPECT_EQ(averted.weights, classified(*mesh, light, NearCaps::Facing).weights);
        EXPECT_EQ(averted.solid_averted, std::vector<std::uint8_t>{0});
    }
}

TEST(Facing, AHollowInASolidIsHiddenByEitherKindOfNearCaps) {
    // A shell. Its far inner wall looks at the light, and what hides it, with averted caps, is the
    // near inner wall alone.
    const auto mesh = test::build(
        test::merged(test::sphere(6, 8, 2.0F), test::inside_out(test::sphere(6, 8, 1.0F))));
    ASSERT_EQ(mesh->components().size(), 2U);
    const Facing averted = classified(*mesh, direction(0.1F, 1.0F, 0.2F), NearCaps::Averted);
    EXPECT_EQ(averted.solid_averted, (std::vector<std::uint8_t>{1, 0}));
    double lowest_inner_cap = 9.0;
    for (std::size_t f = 0; f < averted.weights.size(); ++f) {
        if (averted.weights[f] == 0 || mesh->face_components()[f] == 0) continue;
        EXPECT_EQ(averted.weights[f], -1);
        for (const std::uint32_t v : mesh->faces()[f]) {
            lowest_inner_cap =
                std::min(lowest_inner_cap, static_cast<double>(mesh->positions()[v].y));
        }
    }
    EXPECT_GT(lowest_inner_cap, -0.8) << "the near wall, on top, not the far one below";
}

TEST(Facing, AvertedWeightsAreExactForAnyMeshAnyLightAnywhere) {
    GNOMON_RANDOM(random);
    int solids = 0;
    for (int i = 0; i < 2'000; ++i) {
        const auto mesh = test::build(test::random_mesh(random));
        const LightLocal light = test::random_light(random, *mesh);
        const Facing averted = classified(*mesh, light, NearCaps::Averted);
        ASSERT_EQ(averted.weights, exact_weights(*mesh, light, NearCaps::Averted)) << "mesh " << i;
        ASSERT_EQ(averted.margin, classified(*mesh, light).margin) << "mesh " << i;
        solids += static_cast<int>(
            std::count(averted.solid_averted.begin(), averted.solid_averted.end(), 1));
    }
    EXPECT_GT(solids, 100);
}

TEST(Facing, AFaceInWhosePlaneTheLightLiesWeighsNothing) {
    const auto mesh = test::build(test::book(4));
    // On the spine: in every page's plane.
    EXPECT_EQ(count_of(classified(*mesh, point(0.0F, 5.0F, 0.0F)), 0), 8);
    EXPECT_EQ(count_of(classified(*mesh, direction(0.0F, 1.0F, 0.0F)), 0), 8);
}

TEST(Facing, DegenerateFacesWeighNothing) {
    Triangles triangles = test::sheet(1);
    triangles.positions.emplace_back(0.5F, 0.0F, 0.0F);
    triangles.indices.insert(triangles.indices.end(), {0, 0, 1, 1, 1, 1, 0, 4, 1});
    const auto mesh = test::build(triangles);
    EXPECT_EQ(mesh->report().degenerate_faces, 3U);
    const Facing facing = classified(*mesh, point(0.3F, 2.0F, 0.7F));
    EXPECT_EQ(count_of(facing, 1), 2);
    for (std::size_t f = 2; f < 5; ++f) EXPECT_EQ(facing.weights[f], 0);
    EXPECT_GT(facing.margin, 0.0) << "faces that never cast must not pin the light";
}

TEST(Facing, AnEmptyMeshHasNoWeightsAndAnyMargin) {
    const auto mesh = test::build({});
    const Facing facing = classified(*mesh, point(1, 2, 3));
    EXPECT_TRUE(facing.weights.empty());
    EXPECT_EQ(facing.margin, std::numeric_limits<double>::infinity());
}

// ---------------------------------------------------------------------------------------------
// The margin

double distance(LightLocal a, LightLocal b) {
    const glm::dvec3 p(a.position);
    const glm::dvec3 q(b.position);
    return a.is_directional() ? glm::length(glm::normalize(p) - glm::normalize(q))
                              : glm::length(p - q);
}

// Ways for a light to move that are likely to cross something: at random, straight at a face's
// plane, straight at the bounds.
glm::dvec3 dangerous_direction(Random& random, const ShadowMesh& mesh, const glm::dvec3& l) {
    const auto p = mesh.positions();
    const auto& [a, b, c] = mesh.faces()[random.below(mesh.faces().size())];
    const glm::dvec3 n =
        glm::cross(glm::dvec3(p[b]) - glm::dvec3(p[a]), glm::dvec3(p[c]) - glm::dvec3(p[a]));
    const Component& component = mesh.components()[random.below(mesh.components().size())];
    const glm::dvec3 nearest =
        glm::clamp(l, glm::dvec3(component.bounds_min), glm::dvec3(component.bounds_max));
    glm::dvec3 d = random.unit_vector();
    switch (random.integer(0, 3)) {
        case 0: d = n; break;
        case 1: d = -n; break;
        case 2: d = nearest - l; break;
        default: break;
    }
    return glm::length(d) > 0.0 ? glm::normalize(d) : random.unit_vector();
}

TEST(Facing, NoWeightChangesWithinTheMargin) {
    GNOMON_RANDOM(random);
    int moves = 0;
    for (int i = 0; i < 2'000; ++i) {
        const auto mesh = test::build(test::random_mesh(random));
        const LightLocal light = test::random_light(random, *mesh);
        const Facing facing = classified(*mesh, light);
        if (!(facing.margin > 0.0) || !std::isfinite(facing.margin)) continue;
        for (int j = 0; j < 12; ++j) {
            const glm::dvec3 l(light.position);
            const double length = light.is_directional() ? glm::length(l) : 1.0;
            const double step = facing.margin * (j % 3 == 0 ? random.uniform(0.0, 1.0) : 1.0);
            const glm::dvec3 to = l + dangerous_direction(random, *mesh, l) * step * length;
            const LightLocal moved{glm::vec4(glm::vec3(to), light.position.w)};
            // Rounding may have carried it over the margin, where nothing is promised.
            if (!(distance(light, moved) <= facing.margin)) continue;
            ++moves;
            ASSERT_EQ(exact_weights(*mesh, moved), facing.weights)
                << "mesh " << i << " margin " << facing.margin << " moved "
                << distance(light, moved);
        }
    }
    EXPECT_GT(moves, 5'000);
}

TEST(Facing, MarginHoldsForSlivers) {
    GNOMON_RANDOM(random);
    int moves = 0;
    for (int i = 0; i < 20'000; ++i) {
        // Corners whose differences do not fit a double either, at very unequal scales: the
        // computed normal is then mostly error.
        const auto wild = [&](int spread) {
            const auto c = [&] {
                return static_cast<float>(
                    std::ldexp(random.uniform(-1.0, 1.0), random.integer(-spread, spread)));
            };
            return glm::vec3(c(), c(), c());
        };
        const int spread = random.integer(0, 40);
        const glm::vec3 a = wild(spread);
        const glm::vec3 b = wild(spread);
        const glm::vec3 c = random.chance(0.5) ? wild(spread) : a + (b - a) * 0.375F;
        const auto mesh = test::build({{a, b, c}, {0, 1, 2}});
        if (mesh->report().degenerate_faces != 0) continue;
        glm::vec3 l = wild(spread);
        if (random.chance(0.3)) l = a + glm::vec3(random.unit_vector()) * 0x1p-20F;
        if (random.chance(0.1)) l = glm::vec3(0.0F);
        const LightLocal light{glm::vec4(l, 1.0F)};
        const Facing facing = classified(*mesh, light);
        if (!(facing.margin > 0.0)) continue;
        for (int j = 0; j < 4; ++j) {
            const glm::dvec3 to =
                glm::dvec3(l) + dangerous_direction(random, *mesh, glm::dvec3(l)) * facing.margin;
            const LightLocal moved{glm::vec4(glm::vec3(to), 1.0F)};
            if (!(distance(light, moved) <= facing.margin)) continue;
            ++moves;
            ASSERT_EQ(exact_weights(*mesh, moved), facing.weights) << "case " << i;
        }
    }
    EXPECT_GT(moves, 2'000);
}

TEST(Facing, AMoveOntoTheBoundsIsBeyondTheMargin) {
    // The corner of these bounds is nearer than any face's plane.
    const auto mesh = test::build(test::tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}));
    const Facing before = classified(*mesh, point(2, 2, 2));
    const Facing after = classified(*mesh, point(1, 1, 1));
    ASSERT_NE(before.weights, after.weights);
    EXPECT_LT(before.margin, std::sqrt(3.0));
    EXPECT_GT(before.margin, std::sqrt(3.0) * 0.999);
}

TEST(Facing, TheMarginIsNearlyAsLargeAsItCanBe) {
    const auto mesh = test::build(test::sphere(8, 12));
    GNOMON_RANDOM(random);
    for (int i = 0; i < 200; ++i) {
        const bool directional = i % 2 == 0;
        const glm::vec3 l(random.unit_vector() * (directional ? 2.0 : 5.0));
        const LightLocal light{glm::vec4(l, directional ? 0.0F : 1.0F)};
        double nearest = directional
                             ? 9.0
                             : glm::length(glm::dvec3(l) -
                                           glm::clamp(glm::dvec3(l), glm::dvec3(mesh->bounds_min()),
                                                      glm::dvec3(mesh->bounds_max())));
        for (const auto& [a, b, c] : mesh->faces()) {
            const glm::dvec3 p(mesh->positions()[a]);
            const glm::dvec3 n = glm::normalize(glm::cross(glm::dvec3(mesh->positions()[b]) - p,
                                                           glm::dvec3(mesh->positions()[c]) - p));
            const double away = directional ? glm::dot(n, glm::normalize(glm::dvec3(l)))
                                            : glm::dot(n, glm::dvec3(l) - p);
            nearest = std::min(nearest, std::abs(away));
        }
        const double margin = classified(*mesh, light).margin;
        EXPECT_LE(margin, nearest);
        EXPECT_GE(margin, 0.99 * nearest - 1e-5);
    }
}

// ---------------------------------------------------------------------------------------------
// Flattened poses

TEST(Facing, FlattenedCastsBothWaysWhereThePoseLeads) {
    const auto mesh = test::build(test::box());
    glm::dmat4 flat(1.0);
    flat[1][1] = 0.0;
    Facing facing;
    classify_faces_flattened(*mesh, flat, {0.3, 4.0, 0.2, 1.0}, facing);
    EXPECT_EQ(count_of(facing, 1), 2);   // the top
    EXPECT_EQ(count_of(facing, -1), 2);  // the bottom; the sides have no area left
    EXPECT_EQ(count_of(facing, 0), 8);
    EXPECT_EQ(facing.margin, 0.0);
    classify_faces_flattened(*mesh, flat, {0.1, 1.0, 0.2, 0.0}, facing);
    EXPECT_EQ(count_of(facing, 1), 2);
    classify_faces_flattened(*mesh, flat, {4.0, 0.0, 0.2, 1.0}, facing);
    EXPECT_EQ(count_of(facing, 0), 12) << "edge-on";
    classify_faces_flattened(*mesh, glm::dmat4(0.0), {4.0, 0.0, 0.2, 1.0}, facing);
    EXPECT_EQ(count_of(facing, 0), 12) << "all scales zero";
}

}  // namespace
}  // namespace gnomon::shadows
