// SPDX-License-Identifier: MIT
//
// Every side that classify_faces decides is the exact one: SIMD = scalar = an oracle that shares
// nothing with either. On meshes and lights that are hard on purpose, and on random pairs: ten
// thousand, or as many as GNOMON_PAIRS says (a million in the soak test). The pairs' volumes are
// closed as well.
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/silhouette.hpp>
#include <gnomon/shadows/volume.hpp>

#include "tests/shadows/exact_oracle.hpp"
#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;
using test::Triangles;

LightLocal point(const glm::vec3& p) { return {glm::vec4(p, 1.0F)}; }
LightLocal direction(const glm::vec3& d) { return {glm::vec4(d, 0.0F)}; }

bool is_finite(const glm::vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

struct Stages {
    std::uint64_t faces = 0;
    std::uint64_t in_double = 0;
    std::uint64_t exact = 0;
    std::uint64_t edge_on = 0;  // faces with area whose plane contains the light
    Facing facing;              // of the last check
};

// Which sides of a component cast is a rule of its own (facing_test.cpp). Here: whoever casts,
// casts with the exact side; faces of one component that show the same side are treated alike; and
// a component that shows a side of some kind casts with one of them.
void expect_exact(const ShadowMesh& mesh, LightLocal light, Stages& stages) {
    if (!is_finite(glm::vec3(light.position))) light = point(mesh.positions()[0]);
    Facing& facing = stages.facing;
    classify_faces(mesh, light, facing);
    Facing scalar;
    classify_faces(mesh, light, scalar, NearCaps::Facing, FacingFilter::Scalar);
    ASSERT_EQ(facing.weights, scalar.weights);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(facing.margin),
              std::bit_cast<std::uint64_t>(scalar.margin));
    ASSERT_EQ(facing.stats.double_tests, scalar.stats.double_tests);
    ASSERT_EQ(facing.stats.exact_tests, scalar.stats.exact_tests);

    const auto p = mesh.positions();
    // Per component and side (averted, facing): whether one was seen that casts, that does not.
    std::vector<std::array<std::array<bool, 2>, 2>> seen(mesh.components().size());
    for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
        const auto& [a, b, c] = mesh.faces()[f];
        const int side = test::oracle_facing(p[a], p[b], p[c], light);
        const int weight = facing.weights[f];
        ASSERT_TRUE(weight == 0 || weight == side)
            << "face " << f << " weighs " << weight << ", its side is " << side;
        if (side == 0) {
            if (mesh.planes().error[f] != 0.0F) ++stages.edge_on;
        } else {
            seen[mesh.face_components()[f]][side > 0 ? 1 : 0][weight != 0 ? 1 : 0] = true;
        }
    }
    for (const auto& [averted, towards] : seen) {
        ASSERT_FALSE(averted[0] && averted[1]) << "averted faces of one component differ";
        ASSERT_FALSE(towards[0] && towards[1]) << "facing faces of one component differ";
        // One-sided casting leaves out one side, never both.
        ASSERT_FALSE(averted[0] && towards[0]) << "a component casts nothing";
    }
    stages.faces += facing.stats.faces;
    stages.in_double += facing.stats.double_tests;
    stages.exact += facing.stats.exact_tests;
}

// On every corner, on every edge's middle, on every face, one step of the last place beside them.
std::vector<glm::vec3> places_on(const ShadowMesh& mesh, Random& random, int count) {
    std::vector<glm::vec3> places;
    const auto p = mesh.positions();
    for (int i = 0; i < count; ++i) {
        const auto& [a, b, c] = mesh.faces()[random.below(mesh.faces().size())];
        for (const glm::vec3& place :
             {p[a], (p[a] + p[b]) * 0.5F, p[a] * 0.25F + p[b] * 0.25F + p[c] * 0.5F,
              p[a] + (p[b] - p[a]) + (p[c] - p[a])}) {
            places.push_back(place);
            glm::vec3 beside = place;
            const int axis = random.integer(0, 2);
            beside[axis] = std::nextafter(beside[axis], random.chance(0.5) ? 1e38F : -1e38F);
            places.push_back(beside);
        }
    }
    return places;
}

void expect_exact_everywhere(const ShadowMesh& mesh, Random& random, Stages& stages) {
    for (const glm::vec3& place : places_on(mesh, random, 4)) {
        ASSERT_NO_FATAL_FAILURE(expect_exact(mesh, point(place), stages));
        ASSERT_NO_FATAL_FAILURE(expect_exact(mesh, direction(place), stages));
    }
    for (int i = 0; i < 4; ++i) {
        ASSERT_NO_FATAL_FAILURE(expect_exact(mesh, test::random_light(random, mesh), stages));
    }
}

// Points of a plane through the origin whose coordinates are small integers times a power of two:
// triangles of it, and lights in it, are coplanar exactly.
Triangles coplanar_grid(Random& random, float scale) {
    const glm::vec3 u(random.integer(-4, 4), random.integer(-4, 4), random.integer(1, 4));
    const glm::vec3 v(random.integer(1, 4), random.integer(-4, 4), random.integer(-4, 4));
    Triangles mesh;
    for (int i = 0; i < 25; ++i) {
        mesh.positions.push_back((u * static_cast<float>(i % 5) + v * static_cast<float>(i / 5)) *
                                 scale);
    }
    for (int i = 0; i < 3 * 40; ++i) mesh.indices.push_back(random.below(25));
    return mesh;
}

Triangles slivers(Random& random, double length) {
    Triangles mesh;
    for (int i = 0; i < 20; ++i) {
        const glm::dvec3 a = random.in_cube(1.0);
        const glm::dvec3 b = a + random.unit_vector() * length * random.uniform(0.5, 1.0);
        const glm::dvec3 c = glm::mix(a, b, random.uniform(-1.0, 2.0)) +
                             random.unit_vector() * std::pow(10.0, random.uniform(-9.0, -2.0));
        for (const glm::dvec3& p : {a, b, c}) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
            mesh.positions.emplace_back(p);
        }
    }
    return mesh;
}

Triangles scaled(Triangles mesh, float scale) {
    for (glm::vec3& p : mesh.positions) p *= scale;
    return mesh;
}

TEST(Exactness, OfSlivers) {
    GNOMON_RANDOM(random);
    Stages stages;
    for (int i = 0; i < 60; ++i) {
        const auto mesh = test::build(slivers(random, std::pow(10.0, i % 6)));
        ASSERT_NO_FATAL_FAILURE(expect_exact_everywhere(*mesh, random, stages));
    }
    EXPECT_GT(stages.exact, 100U);
    EXPECT_LT(stages.in_double, stages.faces / 2) << "the filter says something about slivers too";
}

TEST(Exactness, OfNeedlesThatTheFilterLeavesAlone) {
    Stages stages;
    // 2^60 times as long as high.
    const auto mesh =
        test::build({{{0, 0, 0}, {0x1p30F, 0, 0}, {0x1p29F, 0x1p-30F, 0}}, {0, 1, 2}});
    EXPECT_EQ(mesh->report().degenerate_faces, 0U);
    for (const float z : {1.0F, -1.0F, 0.0F, 0x1p-149F, -0x1p-149F}) {
        ASSERT_NO_FATAL_FAILURE(expect_exact(*mesh, point({1.0F, 2.0F, z}), stages));
        ASSERT_NO_FATAL_FAILURE(expect_exact(*mesh, direction({1.0F, 2.0F, z}), stages));
    }
    // A needle along no axis: its normal has no correct digit in double precision.
    const auto skew = test::build(
        {{{0, 0, 0}, {0x1p60F, 0x1.8p60F, 0x1.4p60F}, {0x1p59F, 0x1.8p59F, 0x1.400002p59F}},
         {0, 1, 2}});
    EXPECT_EQ(skew->report().degenerate_faces, 0U);
    for (int i = -3; i <= 3; ++i) {
        const auto x = static_cast<float>(i);
        ASSERT_NO_FATAL_FAILURE(expect_exact(*skew, point({x, 1.0F, -x}), stages));
        ASSERT_NO_FATAL_FAILURE(expect_exact(*skew, direction({x, 1.0F, 0.5F}), stages));
    }
}

TEST(Exactness, OfNeedlesWhoseNormalsHaveFewCorrectDigits) {
    GNOMON_RANDOM(random);
    Stages stages;
    for (int i = 0; i < 4000; ++i) {
        // Neighbours among the Fibonacci numbers span an area of one: as long as 2^27 to 2^38 times
        // the height. The low bits of `a` do not fit the differences, so that the normal is wrong
        // by what the bound's term for slivers says, and by nothing like it for plumper triangles.
        float previous = 1.0F;
        float number = 1.0F;
        for (int n = random.integer(18, 26); n > 0; --n) {
            previous = std::exchange(number, number + previous);
        }
        const glm::vec3 a(random.in_cube(0x1p-34));
        const glm::vec3 b(number + previous, number, number + previous);
        const glm::vec3 c(number, previous, number);
        const auto mesh = test::build({{a, b, c}, {0, 1, 2}});
        // Beside the needle, and all but in its plane.
        const glm::dvec3 e1 = glm::dvec3(b) - glm::dvec3(a);
        const glm::dvec3 n = glm::normalize(glm::cross(e1, glm::dvec3(c) - glm::dvec3(a)));
        const glm::dvec3 aside = glm::normalize(glm::cross(n, e1));
        const double height = std::pow(2.0, random.uniform(-23.0, -12.0));
        const glm::dvec3 towards = aside + n * (random.chance(0.5) ? height : -height);
        ASSERT_NO_FATAL_FAILURE(
            expect_exact(*mesh, point(glm::vec3(glm::dvec3(a) + towards * 1e6)), stages));
        ASSERT_NO_FATAL_FAILURE(expect_exact(*mesh, direction(glm::vec3(towards)), stages));
    }
    EXPECT_GT(stages.in_double, 100U);
    EXPECT_LT(stages.in_double, stages.faces);
}

TEST(Exactness, OfCoplanarGridsWithTheLightInTheirPlane) {
    GNOMON_RANDOM(random);
    Stages stages;
    for (int i = 0; i < 60; ++i) {
        const auto mesh =
            test::build(coplanar_grid(random, std::ldexp(1.0F, random.integer(-140, 100))));
        ASSERT_NO_FATAL_FAILURE(expect_exact_everywhere(*mesh, random, stages));
    }
    EXPECT_GT(stages.edge_on, stages.faces / 4);
    EXPECT_GT(stages.exact, stages.faces / 20);
}

TEST(Exactness, OfLightsOnFacesEdgesAndVertices) {
    GNOMON_RANDOM(random);
    Stages stages;
    for (int i = 0; i < 120; ++i) {
        const auto mesh = test::build(test::random_mesh(random));
        ASSERT_NO_FATAL_FAILURE(expect_exact_everywhere(*mesh, random, stages));
    }
    EXPECT_GT(stages.edge_on, stages.faces / 20);
}

TEST(Exactness, AtEveryScaleUpToTheEndsOfTheRange) {
    GNOMON_RANDOM(random);
    for (const float scale :
         {1e-45F, 1e-44F, 1e-41F, 1e-38F, 1e-30F, 1e-20F, 1e10F, 1e19F, 1e30F, 1e37F}) {
        SCOPED_TRACE(::testing::Message() << "scale " << scale);
        Stages stages;
        for (int i = 0; i < 12; ++i) {
            const auto mesh = test::build(scaled(test::random_mesh(random), scale));
            ASSERT_NO_FATAL_FAILURE(expect_exact_everywhere(*mesh, random, stages));
        }
        // Unit normals: the filter works at any scale, but for what the smallest floats leave.
        if (scale > 1e-36F) {
            EXPECT_LT(stages.in_double, stages.faces / 2);
        }
    }
    Stages stages;
    for (int i = 0; i < 40; ++i) {
        const auto mesh = test::build(test::wild_soup(random, 20));
        ASSERT_NO_FATAL_FAILURE(expect_exact_everywhere(*mesh, random, stages));
    }
    // Bounds that no float difference can span.
    constexpr float most = std::numeric_limits<float>::max();
    const auto widest = test::build(test::box(glm::vec3(-most), glm::vec3(most)));
    ASSERT_NO_FATAL_FAILURE(expect_exact_everywhere(*widest, random, stages));
    ASSERT_NO_FATAL_FAILURE(expect_exact(*widest, point({most, -most, 0.0F}), stages));
}

TEST(Exactness, FarFromTheOriginOfTheMeshsSpace) {
    GNOMON_RANDOM(random);
    for (const float offset : {1e1F, 1e3F, 1e5F, 1e7F, 1e30F}) {  // in radii
        SCOPED_TRACE(::testing::Message() << "offset " << offset);
        Stages stages;
        for (int i = 0; i < 20; ++i) {
            const auto mesh = test::build(
                test::moved(test::sphere(6, 9), glm::vec3(random.unit_vector()) * offset));
            ASSERT_NO_FATAL_FAILURE(expect_exact_everywhere(*mesh, random, stages));
            for (int j = 0; j < 10; ++j) {
                const glm::dvec3 middle =
                    0.5 * (glm::dvec3(mesh->bounds_min()) + glm::dvec3(mesh->bounds_max()));
                const glm::vec3 beside(middle + random.unit_vector() * 4.0);
                ASSERT_NO_FATAL_FAILURE(expect_exact(*mesh, point(beside), stages));
            }
        }
    }
}

TEST(Exactness, AMeshFarFromItsOriginIsStillForTheFilter) {
    GNOMON_RANDOM(random);
    Stages stages;
    for (int i = 0; i < 50; ++i) {
        const glm::vec3 far = glm::vec3(random.unit_vector()) * 1e5F;
        const auto mesh = test::build(test::moved(test::sphere(12, 18), far));
        const glm::vec3 beside = far + glm::vec3(random.unit_vector()) * 4.0F;
        ASSERT_NO_FATAL_FAILURE(expect_exact(*mesh, point(beside), stages));
    }
    EXPECT_LT(stages.in_double, stages.faces / 200);
}

// ---------------------------------------------------------------------------------------------
// Random pairs

// Half of the pairs: degenerate on purpose.
std::pair<Triangles, bool> mesh_of_pair(Random& random) {
    const bool degenerate = random.chance(0.5);
    if (!degenerate) return {test::random_mesh(random), false};
    const float scale = std::ldexp(1.0F, random.integer(-20, 20));
    switch (random.integer(0, 4)) {
        case 0: return {slivers(random, std::pow(10.0, random.integer(0, 6))), true};
        case 1: return {coplanar_grid(random, scale), true};
        case 2: return {test::wild_soup(random, random.integer(4, 24)), true};
        case 3:
            return {
                test::moved(test::random_mesh(random),
                            glm::vec3(random.unit_vector() * std::pow(10.0, random.integer(3, 7)))),
                true};
        default: return {scaled(test::random_mesh(random), scale), true};
    }
}

LightLocal light_of_pair(Random& random, const ShadowMesh& mesh, bool degenerate) {
    if (!degenerate) return test::random_light(random, mesh);
    const auto places = places_on(mesh, random, 1);
    const glm::vec3 place = places[random.below(places.size())];
    return random.chance(0.25) ? direction(place) : point(place);
}

TEST(Pairs, OfMeshesAndLightsGiveClosedVolumesFromExactSides) {
    GNOMON_RANDOM(random);
    const char* wanted = std::getenv("GNOMON_PAIRS");
    const int pairs = wanted != nullptr ? std::atoi(wanted) : 10'000;
    constexpr int lights_per_mesh = 4;
    Stages stages;
    std::vector<SilhouetteEdge> silhouette;
    Volume volume;
    int degenerate_pairs = 0;
    for (int i = 0; i < pairs; i += lights_per_mesh) {
        const auto [triangles, degenerate] = mesh_of_pair(random);
        const auto mesh = test::build(triangles);
        for (int j = 0; j < lights_per_mesh; ++j) {
            const LightLocal light = light_of_pair(random, *mesh, degenerate);
            ASSERT_NO_FATAL_FAILURE(expect_exact(*mesh, light, stages))
                << "pair " << i + j << ", degenerate " << degenerate;
            find_silhouette(*mesh, stages.facing.weights, silhouette);
            for (const FarVertices far : {FarVertices::AtInfinity, FarVertices::Finite}) {
                build_volume(*mesh, stages.facing.weights, silhouette, light.is_directional(), far,
                             volume);
                ASSERT_TRUE(is_closed(*mesh, volume))
                    << "pair " << i + j << ", degenerate " << degenerate;
            }
            if (degenerate) ++degenerate_pairs;
        }
    }
    EXPECT_GT(degenerate_pairs, 2 * pairs / 5);
    EXPECT_GT(stages.edge_on, stages.faces / 50);
    EXPECT_GT(stages.exact, stages.faces / 100);
    std::printf("GNOMON_SEED=%llu, %d pairs, %d degenerate, oracle: %s\n",
                static_cast<unsigned long long>(test::run_seed()), pairs, degenerate_pairs,
                test::oracle_name());
    std::printf("%llu faces, %llu edge-on; decided in double %llu, exactly %llu\n",
                static_cast<unsigned long long>(stages.faces),
                static_cast<unsigned long long>(stages.edge_on),
                static_cast<unsigned long long>(stages.in_double),
                static_cast<unsigned long long>(stages.exact));
}

}  // namespace
}  // namespace gnomon::shadows
