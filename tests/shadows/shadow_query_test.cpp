// SPDX-License-Identifier: MIT
//
// Points: held against exact arithmetic over all faces where it hurts (through corners and edges,
// on faces, any pose), against rays in the world where rounding cannot matter, and against
// themselves: refitted or rebuilt, alone or in a batch, from one thread or many.
#include <gnomon/shadows/shadow_query.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/shadows/orientation.hpp>

#include "internal/caster_space.hpp"
#include "internal/crossing.hpp"
#include "tests/shadows/allocation_count.hpp"
#include "tests/shadows/query_oracle.hpp"
#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using internal::CasterSpace;
using test::Random;

using MeshPointer = std::shared_ptr<const ShadowMesh>;

glm::dmat4 moved(const glm::dvec3& by) { return glm::translate(glm::dmat4(1.0), by); }

ShadowQueries queries_of(const std::vector<Caster>& casters) {
    ShadowQueries queries;
    queries.update(casters);
    return queries;
}

// A pose that can be inverted: rigid, scaled, mirrored or sheared; a third is far from the origin.
glm::dmat4 random_pose(Random& random) {
    glm::dmat4 pose(random.rotation());
    if (random.chance(0.5)) {
        pose *= glm::scale(glm::dmat4(1.0),
                           glm::dvec3(random.uniform(0.2, 3.0), random.uniform(0.2, 3.0),
                                      random.uniform(0.2, 3.0)));
    }
    if (random.chance(0.3)) pose *= glm::scale(glm::dmat4(1.0), glm::dvec3(-1.0, 1.0, 1.0));
    if (random.chance(0.3)) {
        glm::dmat4 shear(1.0);
        shear[1][0] = random.uniform(-1.0, 1.0);
        pose *= shear;
    }
    return moved(random.in_cube(random.chance(0.3) ? 1e6 : 5.0)) * pose;
}

// A point in the mesh's space, mostly on the way from the light through a corner, an edge or a
// face, or on one of them.
glm::dvec3 awkward_point(Random& random, const ShadowMesh& mesh, const LightLocal& light) {
    const auto& face = mesh.faces()[random.below(mesh.faces().size())];
    const glm::dvec3 a(mesh.positions()[face[0]]);
    const glm::dvec3 b(mesh.positions()[face[1]]);
    const glm::dvec3 c(mesh.positions()[face[2]]);
    glm::dvec3 target = a;
    if (random.chance(0.6)) target = 0.5 * (a + b);
    if (random.chance(0.3)) target = 0.25 * (a + b) + 0.5 * c;
    const glm::dvec3 away =
        light.is_directional() ? -glm::dvec3(light.position) : target - glm::dvec3(light.position);
    switch (random.integer(0, 5)) {
        case 0: return target;
        case 1: return target + random.in_cube(2.0);
        case 2: return target + random.uniform(0.0, 3.0) * away;
        default: return target + static_cast<double>(random.integer(1, 3)) * away;
    }
}

// Trees of deformed meshes have the shape of the first one that was asked about: whichever that is,
// and however far the others are from it.
TEST(ShadowQuery, CountsTheSameInWhateverPoseWasAskedAboutFirst) {
    GNOMON_RANDOM(random);
    int shadowed = 0;
    for (int i = 0; i < 60; ++i) {
        const test::Triangles at_rest = test::random_mesh(random);
        const MeshPointer mesh = test::build(at_rest);
        std::vector<MeshPointer> poses{mesh};
        for (const float most : {0.01F, 0.3F, 20.0F}) {
            std::vector<glm::vec3> positions = at_rest.positions;
            // By place, so that what is welded stays together.
            const glm::vec3 wave(glm::vec3(random.in_cube(3.0)));
            for (glm::vec3& p : positions) {
                p += most * glm::vec3(std::sin(wave.x * p.y), std::sin(wave.y * p.z),
                                      std::sin(wave.z * p.x));
            }
            auto deformed = mesh->deformed(positions);
            ASSERT_TRUE(deformed) << deformed.error().message;
            poses.push_back(*deformed);
        }
        std::rotate(poses.begin(), poses.begin() + i % 4, poses.end());
        for (const MeshPointer& pose : poses) {
            const LightLocal light_local = test::random_light(random, *pose);
            const Light light{.position_world = light_local.position};
            const ShadowQueries queries = queries_of({{.key = 7, .mesh = pose}});
            for (int j = 0; j < 5; ++j) {
                const glm::dvec3 x = awkward_point(random, *pose, light_local);
                const std::uint32_t expected =
                    test::oracle_count(*pose, x, glm::dvec4(light_local.position));
                ASSERT_EQ(queries.surfaces_between(light, x), expected)
                    << "mesh " << i << ", " << j;
                shadowed += expected > 0 ? 1 : 0;
            }
        }
    }
    EXPECT_GT(shadowed, 100);
}

TEST(ShadowQuery, CountsWhatExactArithmeticCounts) {
    GNOMON_RANDOM(random);
    int through = 0;
    int shadowed = 0;
    int samples = 0;
    for (int i = 0; i < 250; ++i) {
        const MeshPointer mesh = test::build(test::random_mesh(random));
        const LightLocal light_local = test::random_light(random, *mesh);
        const glm::dmat4 pose = random.chance(0.5) ? glm::dmat4(1.0) : random_pose(random);
        const Light light{.position_world = pose * glm::dvec4(light_local.position)};
        const ShadowQueries queries =
            queries_of({{.key = 7, .mesh = mesh, .world_from_local = pose}});
        const CasterSpace space(*mesh, pose);
        for (int j = 0; j < 5; ++j) {
            const glm::dvec3 x(pose * glm::dvec4(awkward_point(random, *mesh, light_local), 1.0));
            const glm::dvec3 x_local = space.point(x).value();
            const glm::dvec4 l_local = space.light(light.position_world).value();
            const std::uint32_t expected = test::oracle_count(*mesh, x_local, l_local);
            ASSERT_EQ(queries.surfaces_between(light, x), expected) << "mesh " << i << ", " << j;
            ASSERT_EQ(queries.at(light, x), expected > 0 ? Exposure::Shadowed : Exposure::Lit);
            for (const auto& [a, b, c] : mesh->faces()) {
                const auto p = mesh->positions();
                if (exact_orientation(x_local, glm::dvec3(p[a]), glm::dvec3(p[b]), l_local) == 0) {
                    ++through;
                    break;
                }
            }
            shadowed += expected > 0 ? 1 : 0;
            ++samples;
        }
    }
    EXPECT_GT(through, samples / 4) << "too few ways in the plane of light and edge";
    EXPECT_GT(shadowed, samples / 5);
    EXPECT_LT(shadowed, samples * 4 / 5);
}

TEST(ShadowQuery, AWayThroughACornerCountsAsOneBesideIt) {
    // On grids the infinitely small step of exact_side has a finite double: (t, t^2, t^3) with t =
    // 2^-12 changes no sign of a determinant that is not zero.
    GNOMON_RANDOM(random);
    int ties = 0;
    for (int i = 0; i < 2'000; ++i) {
        const int half = random.integer(1, 2);
        const auto grid = [&](int n) {
            return glm::dvec3(random.integer(-n, n), random.integer(-n, n), random.integer(-n, n));
        };
        const MeshPointer mesh = test::build(
            random.chance(0.5) ? test::box(glm::vec3(-1.0F), glm::vec3(static_cast<float>(half)))
                               : test::tetrahedron(glm::vec3(grid(2)), glm::vec3(grid(2)),
                                                   glm::vec3(grid(2)), glm::vec3(grid(2))));
        const bool directional = random.chance(0.4);
        const glm::dvec3 l = grid(3);
        const glm::dvec3 corner(mesh->positions()[random.below(mesh->positions().size())]);
        const glm::dvec3 x = directional ? corner - l : 2.0 * corner - l;
        const Light light{.position_world = glm::dvec4(l, directional ? 0.0 : 1.0)};
        bool on_a_plane = false;
        for (const auto& [a, b, c] : mesh->faces()) {
            const auto p = mesh->positions();
            on_a_plane = on_a_plane || exact_orientation(glm::dvec3(p[a]), glm::dvec3(p[b]),
                                                         glm::dvec3(p[c]), {x, 1.0}) == 0;
        }
        if (on_a_plane) continue;
        ++ties;
        const ShadowQueries queries = queries_of({{.key = 1, .mesh = mesh}});
        const glm::dvec3 beside = x + glm::dvec3(0x1p-12, 0x1p-24, 0x1p-36);
        const std::uint32_t count = queries.surfaces_between(light, x);
        ASSERT_EQ(count, queries.surfaces_between(light, beside)) << "case " << i;
    }
    EXPECT_GT(ties, 500);
}

TEST(ShadowQuery, BehindACornerOfAClosedMeshTheNumberOfSurfacesIsEven) {
    const MeshPointer sphere = test::build(test::sphere(12, 16));
    const ShadowQueries queries = queries_of({{.key = 1, .mesh = sphere}});
    const Light light{.position_world = {3.0, 4.0, 2.0, 1.0}};
    int twice = 0;
    for (const glm::vec3& corner : sphere->positions()) {
        const glm::dvec3 l(light.position_world);
        const std::uint32_t count =
            queries.surfaces_between(light, l + 4.0 * (glm::dvec3(corner) - l));
        ASSERT_TRUE(count == 0 || count == 2) << count;
        twice += count == 2 ? 1 : 0;
    }
    EXPECT_GT(twice, 100) << "a line through a corner inside the outline passes two surfaces";
}

// Where a line in the world meets a face's plane, and by how much it is inside its edges: plain
// double precision, no sign of it from the library.
std::optional<int> plain_count(const std::vector<Caster>& casters, const Light& light,
                               const glm::dvec3& x) {
    int count = 0;
    const glm::dvec3 towards = glm::dvec3(light.position_world) - light.position_world.w * x;
    for (const Caster& caster : casters) {
        for (const auto& face : caster.mesh->faces()) {
            std::array<glm::dvec3, 3> p;
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec3 corner(caster.mesh->positions()[face[k]]);
                // Relative to x, so that places far from the origin lose nothing more.
                p[k] = glm::dvec3(glm::dmat3(caster.world_from_local) * corner) +
                       (glm::dvec3(caster.world_from_local[3]) - x);
            }
            const glm::dvec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
            const double area = glm::length(n);
            const double along = glm::dot(n, towards);
            if (area < 1e-9) continue;
            if (std::abs(along) < 1e-5 * area * glm::length(towards)) return std::nullopt;
            const double t = glm::dot(n, p[0]) / along;
            const glm::dvec3 q = t * towards;
            double least = 1.0;
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec3 e = p[(k + 1) % 3] - p[k];
                least = std::min(least, glm::dot(glm::cross(e, q - p[k]), n) / (area * area));
            }
            if (least < -1e-5) continue;
            const double end = light.position_world.w != 0.0 ? 1.0 : 1e300;
            if (least < 1e-5 || std::abs(t) < 1e-5 || std::abs(t - end) < 1e-5) {
                return std::nullopt;
            }
            count += t > 0.0 && t < end ? 1 : 0;
        }
    }
    return count;
}

TEST(ShadowQuery, CountsWhatLiesBetweenInTheWorld) {
    GNOMON_RANDOM(random);
    int samples = 0;
    int shadowed = 0;
    int flattened = 0;
    for (int i = 0; i < 150; ++i) {
        // Mirrored, sheared, flattened, and all together a million metres away.
        const glm::dvec3 place = random.in_cube(random.chance(0.3) ? 1e6 : 1.0);
        std::vector<Caster> casters;
        bool flat = false;
        for (std::uint64_t key = 0; key < 6; ++key) {
            glm::dmat4 pose = random_pose(random);
            if (random.chance(0.2)) {
                pose *= glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 0.0, 1.0));
                flat = true;
            }
            pose[3] = glm::dvec4(place + random.in_cube(4.0), 1.0);
            casters.push_back({.key = key,
                               .mesh = test::build(test::random_mesh(random)),
                               .world_from_local = pose});
        }
        const Light light{.position_world =
                              random.chance(0.5)
                                  ? glm::dvec4(place + 8.0 * random.unit_vector(), 1.0)
                                  : glm::dvec4(random.unit_vector(), 0.0)};
        const ShadowQueries queries = queries_of(casters);
        for (int j = 0; j < 30; ++j) {
            const glm::dvec3 x = place + random.in_cube(8.0);
            const auto expected = plain_count(casters, light, x);
            if (!expected) continue;
            ASSERT_EQ(queries.surfaces_between(light, x), static_cast<std::uint32_t>(*expected))
                << "scene " << i << ", " << j;
            ++samples;
            shadowed += *expected > 0 ? 1 : 0;
            flattened += flat ? 1 : 0;
        }
    }
    EXPECT_GT(samples, 2'000);
    EXPECT_GT(shadowed, 300);
    EXPECT_GT(flattened, 500);
}

TEST(ShadowQuery, WhatRoundingDoesToALightHidesNoCaster) {
    // A light 500 km away is rounded by centimetres in the caster's space, and the way to it passes
    // a box in the world by as much where it meets the box's faces.
    GNOMON_RANDOM(random);
    const MeshPointer box = test::build(test::box());
    int beside = 0;
    for (int i = 0; i < 3'000; ++i) {
        const glm::dmat4 pose = moved(random.in_cube(10.0));
        const ShadowQueries queries =
            queries_of({{.key = 1, .mesh = box, .world_from_local = pose}});
        const CasterSpace space(*box, pose);
        const bool directional = random.chance(0.5);
        const glm::dvec3 towards = 5e5 * random.unit_vector();
        const Light light{.position_world = glm::dvec4(towards, directional ? 0.0 : 1.0)};
        const glm::dvec3 corner(box->positions()[random.below(8)]);
        const glm::dvec3 other(box->positions()[random.below(8)]);
        const glm::dvec3 rim(pose * glm::dvec4(0.5 * (corner + other), 1.0));
        const glm::dvec3 x = rim - towards + random.in_cube(0.05);
        // Where the way in the world enters, the caster is looked at anyway.
        if (internal::Sight(x, light.position_world).enters(space.world_bounds())) continue;
        const std::uint32_t expected = test::oracle_count(
            *box, space.point(x).value(), space.light(light.position_world).value());
        ASSERT_EQ(queries.surfaces_between(light, x), expected) << "case " << i;
        beside += expected > 0 ? 1 : 0;
    }
    EXPECT_GT(beside, 0) << "no case in which it matters";
}

TEST(ShadowQuery, ASurfaceDoesNotShadowItself) {
    const MeshPointer box = test::build(test::box());
    const ShadowQueries queries = queries_of({{.key = 1, .mesh = box}});
    const Light above{.position_world = {0.25, 5.0, 0.5, 1.0}};
    EXPECT_EQ(queries.at(above, {0.3, 1.0, 0.4}), Exposure::Lit) << "on the lid";
    EXPECT_EQ(queries.at(above, {1.0, 1.0, 1.0}), Exposure::Lit) << "on a corner of the lid";
    EXPECT_EQ(queries.at(above, {0.3, 1.0 - 1e-15, 0.4}), Exposure::Shadowed) << "just below it";
    EXPECT_EQ(queries.at(above, {0.3, -1.0, 0.4}), Exposure::Shadowed) << "on the bottom";
    EXPECT_EQ(queries.surfaces_between(above, {0.3, -1.0, 0.4}), 1U);
    EXPECT_EQ(queries.surfaces_between(above, {0.3, -1.5, 0.4}), 2U);

    const Light in_the_lid{.position_world = {5.0, 1.0, 0.0, 1.0}};
    EXPECT_EQ(queries.at(in_the_lid, {-5.0, 1.0, 0.0}), Exposure::Lit)
        << "along a face that contains the light, and past the edges of faces that do not";
    const Light sun{.position_world = {1.0, 0.0, 0.0, 0.0}};
    EXPECT_EQ(queries.at(sun, {-3.0, 0.999, 0.1}), Exposure::Shadowed);
    EXPECT_EQ(queries.at(sun, {-3.0, 1.001, 0.1}), Exposure::Lit);
}

TEST(ShadowQuery, LiftTakesAPointToTheSideOfTheLight) {
    const Light above{.position_world = {0.0, 1.0, 0.0, 0.0}};
    const Light below{.position_world = {0.0, -3.0, 0.0, 1.0}};
    const glm::dvec3 x(1.0, 0.0, 2.0);
    const glm::dvec3 normal(0.0, -2.0, 0.0);
    EXPECT_EQ(lifted(x, normal, above, 0.5), glm::dvec3(1.0, 0.5, 2.0));
    EXPECT_EQ(lifted(x, normal, below, 0.5), glm::dvec3(1.0, -0.5, 2.0));
    EXPECT_EQ(lifted(x, glm::dvec3(0.0), above), x);

    // Feet on a slope that casts: their coordinates are rounded to either side of it.
    const MeshPointer slope = test::build(test::sheet(8));
    const glm::dmat4 pose = moved({1234.5, 17.3, -980.1}) *
                            glm::rotate(glm::dmat4(1.0), 0.4, glm::normalize(glm::dvec3(1, 0, 2)));
    const ShadowQueries queries = queries_of({{.key = 1, .mesh = slope, .world_from_local = pose}});
    const glm::dvec3 up(pose[1]);
    int below_ground = 0;
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 feet(pose * glm::dvec4(0.3 + 0.014 * i, 0.0, 0.7 + 0.011 * i, 1.0));
        below_ground += queries.at(above, feet) == Exposure::Shadowed ? 1 : 0;
        ASSERT_EQ(queries.at(above, lifted(feet, up, above)), Exposure::Lit);
        ASSERT_EQ(queries.at(above, lifted(feet, -up, above)), Exposure::Lit);
        ASSERT_EQ(queries.at(above, feet, {.ignored_casters = std::array{std::uint64_t{1}}}),
                  Exposure::Lit);
    }
    EXPECT_GT(below_ground, 0) << "the lift has nothing to do";
}

TEST(ShadowQuery, BeyondItsRangeALightNeitherLightsNorShadows) {
    const ShadowQueries queries = queries_of({{.key = 1, .mesh = test::build(test::box())}});
    const Light lamp{.position_world = {0.0, 5.0, 0.0, 1.0}, .range_m = 8.0};
    EXPECT_EQ(queries.at(lamp, {0.0, -2.0, 0.0}), Exposure::Shadowed);
    EXPECT_EQ(queries.at(lamp, {0.0, -4.0, 0.0}), Exposure::OutOfRange);
    EXPECT_EQ(queries.at(lamp, {8.0, 5.0, 0.0}), Exposure::Lit) << "at its very range";
    EXPECT_EQ(queries.surfaces_between(lamp, {0.0, -4.0, 0.0}), 2U);
    const Light sun{.position_world = {0.0, 5.0, 0.0, 0.0}, .range_m = 1.0};
    EXPECT_EQ(queries.at(sun, {0.0, -40.0, 0.0}), Exposure::Shadowed) << "a sun has no range";
}

TEST(ShadowQuery, WhatIsNotFiniteCastsNothing) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const MeshPointer box = test::build(test::box());
    const Light sun{.position_world = {0.0, 1.0, 0.0, 0.0}};
    const glm::dvec3 below(0.1, -3.0, 0.2);
    const ShadowQueries good = queries_of({{.key = 1, .mesh = box}});
    EXPECT_EQ(good.at(sun, below), Exposure::Shadowed);
    EXPECT_EQ(good.at({.position_world = {0.0, nan, 0.0, 0.0}}, below), Exposure::Lit);
    EXPECT_EQ(good.at({.position_world = {0.0, 0.0, 0.0, 0.0}}, below), Exposure::Lit);
    EXPECT_EQ(good.at(sun, {1e200, -1e200, 3.0}), Exposure::Lit);
    for (const double bad : {nan, std::numeric_limits<double>::infinity(), 1e305}) {
        const glm::dmat4 pose = moved({bad, 0.0, 0.0});
        const ShadowQueries queries =
            queries_of({{.key = 1, .mesh = box, .world_from_local = pose}});
        EXPECT_EQ(queries.at(sun, below), Exposure::Lit);
    }
    const ShadowQueries empty = queries_of({{.key = 1, .mesh = test::build({})}});
    EXPECT_EQ(empty.at(sun, below), Exposure::Lit);
    EXPECT_EQ(ShadowQueries().at(sun, below), Exposure::Lit);
}

// ---------------------------------------------------------------------------------------------
// Many casters

std::vector<Caster> crowd(Random& random, std::uint64_t count) {
    std::vector<Caster> casters;
    const MeshPointer shared = test::build(test::torus(12, 8));
    for (std::uint64_t key = 0; key < count; ++key) {
        glm::dmat4 pose = random_pose(random);
        pose[3] = glm::dvec4(random.in_cube(20.0), 1.0);
        casters.push_back({.key = 1000 + 7 * key,
                           .mesh = key % 2 == 0 ? shared : test::build(test::random_mesh(random)),
                           .world_from_local = pose});
    }
    return casters;
}

std::vector<glm::dvec3> points_in(Random& random, int count) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < count; ++i) points.push_back(random.in_cube(25.0));
    return points;
}

std::vector<Exposure> batch(const ShadowQueries& queries, const Light& light,
                            const std::vector<glm::dvec3>& points,
                            const QueryOptions& options = {}) {
    std::vector<Exposure> exposures(points.size());
    queries.at(light, points, exposures, options);
    return exposures;
}

std::vector<Exposure> one_by_one(const ShadowQueries& queries, const Light& light,
                                 const std::vector<glm::dvec3>& points) {
    std::vector<Exposure> exposures;
    for (const glm::dvec3& x : points) exposures.push_back(queries.at(light, x));
    return exposures;
}

std::ptrdiff_t shadowed(const std::vector<Exposure>& exposures) {
    return std::count(exposures.begin(), exposures.end(), Exposure::Shadowed);
}

const Light lamp{.position_world = {3.0, 30.0, -4.0, 1.0}};

TEST(ShadowQuery, ARefittedTreeAnswersLikeANewOne) {
    GNOMON_RANDOM(random);
    std::vector<Caster> casters = crowd(random, 60);
    ShadowQueries kept;
    EXPECT_EQ(kept.update(casters), TreeUpdate::Rebuilt);
    EXPECT_EQ(kept.update(casters), TreeUpdate::Unchanged);
    const std::vector<glm::dvec3> points = points_in(random, 400);
    int refits = 0;
    int rebuilds = 0;
    for (int frame = 0; frame < 60; ++frame) {
        for (int i = 0; i < 20; ++i) {
            Caster& caster = casters[random.below(casters.size())];
            caster.world_from_local = moved(random.in_cube(6.0)) * caster.world_from_local *
                                      glm::dmat4(random.rotation());
        }
        const TreeUpdate done = kept.update(casters);
        refits += done == TreeUpdate::Refitted ? 1 : 0;
        rebuilds += done == TreeUpdate::Rebuilt ? 1 : 0;
        const std::vector<Exposure> now = one_by_one(kept, lamp, points);
        ASSERT_EQ(now, one_by_one(queries_of(casters), lamp, points)) << "frame " << frame;
        ASSERT_GT(shadowed(now), 5);
    }
    EXPECT_GT(refits, 30);
    EXPECT_GT(rebuilds, 0) << "they drift apart: a refitted tree grows ever slower";
}

TEST(ShadowQuery, CastersComeAndGo) {
    GNOMON_RANDOM(random);
    std::vector<Caster> casters = crowd(random, 30);
    const std::vector<glm::dvec3> points = points_in(random, 400);
    ShadowQueries full;
    ShadowQueries delta;
    full.update(casters);
    delta.update(casters);

    const std::uint64_t gone = casters[4].key;
    casters.erase(casters.begin() + 4);
    casters[0].world_from_local = moved({1.0, 2.0, 3.0});
    EXPECT_EQ(full.update(casters), TreeUpdate::Rebuilt);
    EXPECT_EQ(delta.update({&casters[0], 1}, Submission::Delta, {&gone, 1}), TreeUpdate::Rebuilt);
    EXPECT_EQ(delta.update({}, Submission::Delta, {&gone, 1}), TreeUpdate::Unchanged);
    EXPECT_EQ(one_by_one(full, lamp, points), one_by_one(delta, lamp, points));

    casters[1].mesh = test::build(test::box(glm::vec3(-9.0F), glm::vec3(9.0F)));
    EXPECT_EQ(full.update(casters), TreeUpdate::Rebuilt) << "another mesh";
    delta.update({&casters[1], 1}, Submission::Delta);
    EXPECT_EQ(one_by_one(full, lamp, points), one_by_one(delta, lamp, points));
    EXPECT_EQ(one_by_one(full, lamp, points), one_by_one(queries_of(casters), lamp, points));
    const ShadowQueries moved_on = std::move(full);
    EXPECT_EQ(one_by_one(moved_on, lamp, points), one_by_one(delta, lamp, points));

    EXPECT_EQ(delta.update({}), TreeUpdate::Rebuilt);
    EXPECT_EQ(shadowed(one_by_one(delta, lamp, points)), 0);
}

TEST(ShadowQuery, ABatchAnswersLikeItsPoints) {
    GNOMON_RANDOM(random);
    const std::vector<Caster> casters = crowd(random, 60);
    const ShadowQueries queries = queries_of(casters);
    const std::vector<glm::dvec3> points = points_in(random, 3'000);
    const std::vector<Exposure> exposures = batch(queries, lamp, points);
    EXPECT_EQ(exposures, one_by_one(queries, lamp, points));
    EXPECT_GT(shadowed(exposures), 100);
    // With some ignored: like a world without them.
    std::vector<Caster> others;
    std::vector<std::uint64_t> ignored;
    for (const Caster& caster : casters) {
        if (caster.key % 3 == 0) {
            ignored.push_back(caster.key);
        } else {
            others.push_back(caster);
        }
    }
    const std::vector<Exposure> without = batch(queries, lamp, points, {ignored});
    EXPECT_EQ(without, one_by_one(queries_of(others), lamp, points));
    EXPECT_LT(shadowed(without), shadowed(exposures));
}

TEST(ShadowQuery, AskingAboutPointsAllocatesNothing) {
    GNOMON_RANDOM(random);
    const ShadowQueries queries = queries_of(crowd(random, 40));
    const std::vector<glm::dvec3> points = points_in(random, 500);
    std::vector<Exposure> exposures(points.size());
    const std::uint64_t before = test::allocation_count();
    std::uint32_t surfaces = 0;
    for (const glm::dvec3& x : points) surfaces += queries.surfaces_between(lamp, x);
    for (const glm::dvec3& x : points) exposures[0] = queries.at(lamp, x);
    queries.at(lamp, points, exposures);
    EXPECT_EQ(test::allocation_count(), before);
    EXPECT_GT(before, 0U) << "they are not counted";
    EXPECT_GT(surfaces, 0U);
}

TEST(ShadowQuery, ManyThreadsGetTheAnswersOfOne) {
    GNOMON_RANDOM(random);
    const std::vector<Caster> casters = crowd(random, 40);
    const std::vector<glm::dvec3> points = points_in(random, 1'000);
    // Each thread has a scene of its own as well, over meshes that no one has sorted yet.
    std::vector<std::vector<Exposure>> of_shared(4);
    std::vector<std::vector<Exposure>> of_own(4);
    std::vector<std::thread> threads;
    std::optional<ShadowQueries> queries;
    for (std::size_t i = 0; i < 4; ++i) {
        threads.emplace_back([&, i] { of_own[i] = batch(queries_of(casters), lamp, points); });
    }
    for (std::thread& thread : threads) thread.join();
    threads.clear();
    queries = queries_of(casters);
    for (std::size_t i = 0; i < 4; ++i) {
        threads.emplace_back([&, i] {
            of_shared[i] =
                i % 2 == 0 ? batch(*queries, lamp, points) : one_by_one(*queries, lamp, points);
            std::vector<SegmentPiece> pieces;
            queries->along(lamp, points[i], points[i + 1], pieces);
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(of_shared[i], of_shared[0]);
        EXPECT_EQ(of_own[i], of_shared[0]);
    }
    EXPECT_GT(shadowed(of_shared[0]), 30);
}

}  // namespace
}  // namespace gnomon::shadows
