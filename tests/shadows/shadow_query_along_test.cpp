// SPDX-License-Identifier: MIT
//
// Segments and volumes: against known shadows, and against many points.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/shadows/shadow_query.hpp>

#include "internal/light_fan.hpp"
#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;

ShadowQueries queries_of(const std::vector<Caster>& casters) {
    ShadowQueries queries;
    queries.update(casters);
    return queries;
}

ShadowQueries one(const test::Triangles& mesh, const glm::dmat4& pose = glm::dmat4(1.0)) {
    return queries_of({{.key = 1, .mesh = test::build(mesh), .world_from_local = pose}});
}

std::vector<SegmentPiece> along(const ShadowQueries& queries, const Light& light,
                                const glm::dvec3& from, const glm::dvec3& to) {
    std::vector<SegmentPiece> pieces;
    queries.along(light, from, to, pieces);
    return pieces;
}

void expect_pieces(const std::vector<SegmentPiece>& pieces,
                   const std::vector<SegmentPiece>& expected) {
    ASSERT_EQ(pieces.size(), expected.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        EXPECT_NEAR(pieces[i].begin, expected[i].begin, 1e-14) << "piece " << i;
        EXPECT_NEAR(pieces[i].end, expected[i].end, 1e-14) << "piece " << i;
        EXPECT_EQ(pieces[i].exposure, expected[i].exposure) << "piece " << i;
    }
}

constexpr auto lit = Exposure::Lit;
constexpr auto dark = Exposure::Shadowed;
constexpr auto out = Exposure::OutOfRange;

const Light noon{.position_world = {0.0, 1.0, 0.0, 0.0}};

TEST(ShadowQueryAlong, FindsTheEdgesOfABoxesShadow) {
    const ShadowQueries box = one(test::box());
    expect_pieces(along(box, noon, {-4.0, -3.0, 0.3}, {4.0, -3.0, 0.3}),
                  {{0.0, 0.375, lit}, {0.375, 0.625, dark}, {0.625, 1.0, lit}});
    // From a lamp twice as high above the floor as the lid, the shadow is twice as wide.
    const Light lamp{.position_world = {0.0, 3.0, 0.0, 1.0}};
    expect_pieces(along(box, lamp, {-4.0, -1.0, 0.3}, {4.0, -1.0, 0.3}),
                  {{0.0, 0.25, lit}, {0.25, 0.75, dark}, {0.75, 1.0, lit}});
    // Through the box, downwards: dark from the lid on.
    expect_pieces(along(box, lamp, {0.9, 2.0, 0.1}, {0.9, -2.0, 0.1}),
                  {{0.0, 0.25, lit}, {0.25, 1.0, dark}});
    expect_pieces(along(box, noon, {-4.0, 3.0, 0.3}, {4.0, 3.0, 0.3}), {{0.0, 1.0, lit}});
    expect_pieces(along(box, noon, {0.2, -3.0, 0.3}, {0.2, -3.0, 0.3}), {{0.0, 1.0, dark}});
}

TEST(ShadowQueryAlong, TheLightsOwnLineIsDarkFromTheFirstSurfaceOn) {
    const ShadowQueries box = one(test::box());
    const Light lamp{.position_world = {0.25, 3.0, 0.5, 1.0}};
    expect_pieces(along(box, lamp, {0.25, 2.0, 0.5}, {0.25, -2.0, 0.5}),
                  {{0.0, 0.25, lit}, {0.25, 1.0, dark}});
    expect_pieces(along(box, noon, {0.25, -2.0, 0.5}, {0.25, 2.0, 0.5}),
                  {{0.0, 0.75, dark}, {0.75, 1.0, lit}});
    // A lamp inside the box, on the segment.
    const Light inside{.position_world = {0.25, 0.0, 0.5, 1.0}};
    expect_pieces(along(box, inside, {0.25, -2.0, 0.5}, {0.25, 2.0, 0.5}),
                  {{0.0, 0.25, dark}, {0.25, 0.75, lit}, {0.75, 1.0, dark}});
}

TEST(ShadowQueryAlong, LeavesTheLightsRange) {
    const Light lamp{.position_world = {0.0, 3.0, 0.0, 1.0}, .range_m = 5.0};
    expect_pieces(along(ShadowQueries(), lamp, {-8.0, 0.0, 0.0}, {8.0, 0.0, 0.0}),
                  {{0.0, 0.25, out}, {0.25, 0.75, lit}, {0.75, 1.0, out}});
    // A board half way down casts a shadow twice its width.
    expect_pieces(
        along(one(test::box({-1, 1, -1}, {1, 1.5F, 1})), lamp, {-8.0, 0.0, 0.0}, {8.0, 0.0, 0.0}),
        {{0.0, 0.25, out},
         {0.25, 0.375, lit},
         {0.375, 0.625, dark},
         {0.625, 0.75, lit},
         {0.75, 1.0, out}});
}

TEST(ShadowQueryAlong, AShadowOfManyFacesIsOnePiece) {
    GNOMON_RANDOM(random);
    const ShadowQueries sphere = one(test::sphere(40, 60), glm::dmat4(random.rotation()));
    const ShadowQueries sheet = one(test::moved(test::sheet(30), {-15.0F, 0.0F, -15.0F}));
    for (int i = 0; i < 50; ++i) {
        const Light lamp{.position_world = glm::dvec4(5.0 * random.unit_vector(), 1.0)};
        const glm::dvec3 behind = -glm::dvec3(lamp.position_world);
        const glm::dvec3 across = 4.0 * glm::normalize(glm::cross(behind, random.unit_vector()));
        EXPECT_EQ(along(sphere, lamp, behind - across, behind + across).size(), 3U);
        const glm::dvec3 x = random.in_cube(3.0) - glm::dvec3(0.0, 6.0, 0.0);
        EXPECT_EQ(along(sheet, noon, x, x + random.in_cube(1.0)).size(), 1U);
    }
}

TEST(LightFan, ShadowsOfNeighboursMeetInEqualBits) {
    GNOMON_RANDOM(random);
    const auto mesh = test::build(test::torus(24, 18));
    std::size_t shadows_seen = 0;
    for (int i = 0; i < 60; ++i) {
        const bool directional = random.chance(0.5);
        const glm::dvec3 l = 6.0 * random.unit_vector();
        const glm::dvec3 across = 9.0 * glm::cross(l / 6.0, random.unit_vector());
        const internal::LightFan fan(-l - across, -l + across,
                                     glm::dvec4(l, directional ? 0.0 : 1.0));
        std::vector<internal::SegmentPart> shadows;
        for (const auto& [a, b, c] : mesh->faces()) {
            const auto p = mesh->positions();
            const auto shadow =
                fan.shadow_of({glm::dvec3(p[a]), glm::dvec3(p[b]), glm::dvec3(p[c])});
            if (shadow && shadow->begin < shadow->end) shadows.push_back(*shadow);
        }
        // Every end is an end of another shadow: that of the neighbour behind the edge.
        for (const internal::SegmentPart& one : shadows) {
            for (const double t : {one.begin, one.end}) {
                if (t < 1e-12 || t > 1.0 - 1e-12) continue;  // where the segment ends
                const auto others = std::count_if(
                    shadows.begin(), shadows.end(),
                    [&](const auto& other) { return other.begin == t || other.end == t; });
                ASSERT_GE(others, 2) << "fan " << i << " at " << t;
            }
        }
        shadows_seen += shadows.size();
    }
    EXPECT_GT(shadows_seen, 1'000U);
}

TEST(ShadowQueryAlong, AgreesWithManyPoints) {
    GNOMON_RANDOM(random);
    int pieces_seen = 0;
    int rays = 0;
    for (int i = 0; i < 120; ++i) {
        const glm::dvec3 place = random.in_cube(random.chance(0.3) ? 1e6 : 1.0);
        std::vector<Caster> casters;
        for (std::uint64_t key = 0; key < 5; ++key) {
            glm::dmat4 pose(random.rotation());
            const glm::dvec3 scale(random.chance(0.2) ? 0.0 : random.uniform(-2.0, 2.0),
                                   random.uniform(0.3, 2.0), random.uniform(0.3, 2.0));
            pose *= glm::scale(glm::dmat4(1.0), scale);
            pose[3] = glm::dvec4(place + random.in_cube(3.0), 1.0);
            casters.push_back({.key = key,
                               .mesh = test::build(test::random_mesh(random)),
                               .world_from_local = pose});
        }
        const ShadowQueries queries = queries_of(casters);
        Light light{.position_world = random.chance(0.5)
                                          ? glm::dvec4(place + random.in_cube(6.0), 1.0)
                                          : glm::dvec4(random.unit_vector(), 0.0)};
        if (random.chance(0.3)) light.range_m = random.uniform(3.0, 9.0);
        for (int j = 0; j < 6; ++j) {
            const glm::dvec3 from = place + random.in_cube(7.0);
            glm::dvec3 to = place + random.in_cube(7.0);
            if (random.chance(0.15)) {  // along a way of the light, or all but
                to = light.position_world.w != 0.0 ? glm::dvec3(light.position_world)
                                                   : from + 8.0 * glm::dvec3(light.position_world);
                ++rays;
            }
            const auto pieces = along(queries, light, from, to);
            ASSERT_EQ(pieces.front().begin, 0.0);
            ASSERT_EQ(pieces.back().end, 1.0);
            for (std::size_t k = 1; k < pieces.size(); ++k) {
                ASSERT_EQ(pieces[k].begin, pieces[k - 1].end);
                ASSERT_NE(pieces[k].exposure, pieces[k - 1].exposure);
            }
            pieces_seen += static_cast<int>(pieces.size());
            std::size_t piece = 0;
            for (int s = 0; s <= 200; ++s) {
                const double t = s / 200.0;
                while (t > pieces[piece].end) ++piece;
                if (t - pieces[piece].begin < 1e-8 || pieces[piece].end - t < 1e-8) continue;
                ASSERT_EQ(queries.at(light, glm::mix(from, to, t)), pieces[piece].exposure)
                    << "scene " << i << ", segment " << j << " at " << t;
            }
        }
    }
    EXPECT_GT(pieces_seen, 1'200);
    EXPECT_GT(rays, 50);
}

// ---------------------------------------------------------------------------------------------
// Volumes

// The shadow of a half-plane that ends at x = 0 and reaches to -x, under a sun that comes along y.
ShadowQueries half_plane() {
    return one({{{0, 5, -1e4F}, {0, 5, 1e4F}, {-1e4F, 5, 0}}, {0, 1, 2}});
}

TEST(VolumeShare, IsRightWhereThereIsNoEdge) {
    const ShadowQueries queries = half_plane();
    for (const double x : {-3.0, 3.0}) {
        const VolumeShare share = queries.share_of(noon, Sphere{{x, 0.0, 0.0}, 2.0}, 4);
        EXPECT_EQ(share.shadowed, x < 0.0 ? 1.0 : 0.0);
        EXPECT_EQ(share.uncertain, 0.0);
        EXPECT_EQ(share.samples, 64U);
        const OrientedBounds box{glm::dmat4(1.0), {x - 2.0, -1.0, -1.0}, {x + 2.0, 1.0, 1.0}};
        EXPECT_EQ(queries.share_of(noon, box, 5).shadowed, x < 0.0 ? 1.0 : 0.0);
    }
    const Light lamp{.position_world = {3.0, 0.0, 0.0, 1.0}, .range_m = 1.0};
    const VolumeShare far = queries.share_of(lamp, Sphere{{0.0, 0.0, 0.0}, 1.5}, 4);
    EXPECT_EQ(far.out_of_range, 1.0);
    EXPECT_EQ(far.shadowed, 0.0);
}

TEST(VolumeShare, ErrsLessThanTheCellsThatAPlaneEdgePasses) {
    // Two planes that meet: any plane through a turned box, any cap of a sphere.
    GNOMON_RANDOM(random);
    const ShadowQueries queries = half_plane();
    for (const std::uint32_t n : {4U, 8U, 16U}) {
        double worst = 0.0;
        double squares = 0.0;
        double worst_over_uncertain = -1.0;
        const double cell = 1.0 / (n * n * n);
        constexpr int cases = 150;
        for (int i = 0; i < cases; ++i) {
            const double d = random.uniform(-0.9, 0.9);
            // A sphere of radius 1 at x = -d: the cap with x < 0 has height 1 + d.
            const double height = 1.0 + d;
            const double cap = height * height * (3.0 - height) / 4.0;
            const VolumeShare sphere =
                queries.share_of(noon, Sphere{{-d, random.uniform(-9.0, 4.0), 0.0}, 1.0}, n);
            // A cube of side 2, turned about y: by Monte Carlo's better, a fine grid in x and z.
            const double turn = random.uniform(0.0, std::numbers::pi);
            OrientedBounds box{glm::rotate(glm::dmat4(1.0), turn, glm::dvec3(0.0, 1.0, 0.0)),
                               glm::dvec3(-1.0), glm::dvec3(1.0)};
            box.world_from_local[3].x = -d;
            double area = 0.0;  // where x cos + z sin < d in the square
            constexpr int lines = 2'000;
            for (int line = 0; line < lines; ++line) {
                const double z = -1.0 + 2.0 * (line + 0.5) / lines;
                const double c = std::cos(turn);
                const double border = (d - z * std::sin(turn)) / c;
                const double part = std::clamp((border + 1.0) / 2.0, 0.0, 1.0);
                area += (c > 0.0 ? part : 1.0 - part) / lines;
            }
            const VolumeShare cube = queries.share_of(noon, box, n);
            for (const double error :
                 {std::abs(sphere.shadowed - cap), std::abs(cube.shadowed - area)}) {
                worst = std::max(worst, error);
                squares += error * error / (2 * cases);
            }
            ASSERT_LE(std::abs(cube.shadowed - area), 3.0 / n);
            worst_over_uncertain =
                std::max({worst_over_uncertain, std::abs(cube.shadowed - area) - cube.uncertain,
                          std::abs(sphere.shadowed - cap) - sphere.uncertain});
            ASSERT_EQ(cube.samples, n * n * n);
        }
        std::printf("%2u^3 points: worst error %.4f, root mean square %.4f\n", n, worst,
                    std::sqrt(squares));
        EXPECT_LT(worst, 0.6 / n);
        EXPECT_LT(std::sqrt(squares), 0.9 / (n * n) + 0.003);
        EXPECT_LE(worst_over_uncertain, 2.0 * cell) << "an edge that cuts off a corner";
    }
}

TEST(VolumeShare, IsTheSameEveryTime) {
    const ShadowQueries queries = one(test::torus(20, 12));
    const Sphere sphere{{0.3, -2.0, 0.2}, 1.5};
    const VolumeShare a = queries.share_of(noon, sphere);
    const VolumeShare b = queries.share_of(noon, sphere);
    EXPECT_EQ(a.shadowed, b.shadowed);
    EXPECT_GT(a.shadowed, 0.1);
    EXPECT_LT(a.shadowed, 0.9);
    EXPECT_EQ(a.samples, 512U);
    const std::array<std::uint64_t, 1> self{1};
    EXPECT_EQ(queries.share_of(noon, sphere, 8, {self}).shadowed, 0.0);
}

}  // namespace
}  // namespace gnomon::shadows
