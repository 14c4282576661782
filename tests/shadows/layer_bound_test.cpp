// SPDX-License-Identifier: MIT
//
// The bound on a volume's layers against the truth, which is counted face by face along rays from
// the light; and the parts that a volume is split into: closed, within the limit, together the
// whole.
#include <gnomon/shadows/layer_bound.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/shadows/facing.hpp>

#include "modules/shadows/internal/layers.hpp"
#include "modules/shadows/internal/upright_planes.hpp"
#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;
using test::Triangles;

struct Case {
    std::shared_ptr<const ShadowMesh> mesh;
    LayerSpace space;
    Facing facing;
    Volume volume;
};

// With ranges: most casting faces of even the smallest meshes are in one.
constexpr CapOptions in_ranges{.draw_worth_faces = 2, .max_ranges = 5};

void build_case_volume(Case& c, FarVertices far_vertices) {
    std::vector<SilhouetteEdge> silhouette;
    find_silhouette(*c.mesh, c.facing.weights, silhouette);
    std::vector<FaceRun> casting;
    runs_of(c.facing.weights, casting);
    build_volume(*c.mesh, casting, silhouette, {c.space.light.w == 0.0, far_vertices, in_ranges},
                 c.volume, c.facing.solid_averted);
}

Case make_case(std::shared_ptr<const ShadowMesh> mesh, LightLocal light,
               FarVertices far_vertices = FarVertices::AtInfinity,
               NearCaps near_caps = NearCaps::Facing) {
    Case c{std::move(mesh), {glm::dmat4(1.0), glm::dvec4(light.position)}, {}, {}};
    classify_faces(*c.mesh, light, c.facing, near_caps);
    build_case_volume(c, far_vertices);
    return c;
}

glm::dvec3 placed(const Case& c, std::uint32_t vertex) {
    return glm::dvec3(c.space.space_from_local *
                      glm::dvec4(glm::dvec3(c.mesh->positions()[vertex]), 1.0));
}

// Casting faces on the way from the light through x and on, without those that the ray passes so
// near to an edge that rounding could decide: never more than the truth.
std::uint32_t faces_along(const Case& c, const glm::dvec3& x) {
    const glm::dvec3 l(c.space.light);
    const bool directional = c.space.light.w == 0.0;
    const glm::dvec3 along = glm::normalize(directional ? -l : x - l);
    std::uint32_t count = 0;
    for (std::size_t f = 0; f < c.facing.weights.size(); ++f) {
        if (c.facing.weights[f] == 0) continue;
        std::array<glm::dvec3, 3> d;
        for (std::size_t i = 0; i < 3; ++i) d[i] = placed(c, c.mesh->faces()[f][i]) - x;
        // Coordinates across the ray.
        bool left = true;
        bool right = true;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3& a = d[i];
            const glm::dvec3& b = d[(i + 1) % 3];
            const double height = glm::dot(along, glm::cross(a, b));
            const double doubt = 1e-9 * (glm::length(a) + 1.0) * (glm::length(b) + 1.0);
            left = left && height > doubt;
            right = right && height < -doubt;
        }
        if (!left && !right) continue;
        const glm::dvec3 n = glm::cross(d[1] - d[0], d[2] - d[0]);
        const double slope = glm::dot(n, along);
        if (slope == 0.0) continue;
        const double t = glm::dot(n, d[0]) / slope;
        count += directional || t > -glm::length(x - l) * (1.0 - 1e-9) ? 1 : 0;
    }
    return count;
}

// Somewhere on a casting face, often near one of its corners or edges.
glm::dvec3 on_a_face(Random& random, const Case& c, std::uint32_t face) {
    std::array<double, 3> w{random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
    if (random.chance(0.5)) w[random.below(3)] *= 1e-4;
    if (random.chance(0.3)) w[random.below(3)] *= 1e-4;
    const double sum = w[0] + w[1] + w[2];
    glm::dvec3 x(0.0);
    for (std::size_t i = 0; i < 3; ++i) x += placed(c, c.mesh->faces()[face][i]) * (w[i] / sum);
    return x;
}

std::uint32_t most_faces(Random& random, const Case& c, int rays) {
    std::uint32_t most = 0;
    for (int i = 0; i < rays; ++i) {
        const std::uint32_t face = random.below(c.facing.weights.size());
        if (c.facing.weights[face] == 0) continue;
        most = std::max(most, faces_along(c, on_a_face(random, c, face)));
    }
    return most;
}

// Many overlapping things in one mesh: what the bound is for.
Triangles pile(Random& random) {
    Triangles mesh;
    const int count = random.integer(1, 12);
    for (int i = 0; i < count; ++i) {
        Triangles one = random.chance(0.5)
                            ? test::sphere(random.integer(3, 9), random.integer(3, 12))
                            : test::torus(random.integer(3, 16), random.integer(3, 9));
        if (random.chance(0.4)) test::remove_face(one, random.below(one.count()));
        if (random.chance(0.2)) test::flip_face(one, random.below(one.count()));
        const glm::mat3 turn(random.rotation());
        for (glm::vec3& p : one.positions) p = turn * p;
        mesh = test::merged(std::move(mesh),
                            test::moved(std::move(one), glm::vec3(random.in_cube(1.5))));
    }
    return mesh;
}

TEST(LayerBound, IsNeverBelowTheTruth) {
    GNOMON_RANDOM(random);
    int outside = 0;
    int inside = 0;
    int deep = 0;
    int single = 0;
    double slack = 0.0;
    for (int i = 0; i < 3'000; ++i) {
        const auto mesh =
            test::build(random.chance(0.5) ? test::random_mesh(random) : pile(random));
        const Case c = make_case(mesh, test::random_light(random, *mesh));
        const std::uint32_t truth = most_faces(random, c, 40);
        const bool from_outside = seen_from_outside(*mesh, c.space);
        const std::uint32_t bound = layer_bound(*mesh, c.volume, c.space);
        const std::uint32_t quick = quick_layer_bound(c.volume, from_outside);
        ASSERT_GE(bound, truth) << "mesh " << i;
        ASSERT_GE(quick, bound) << "mesh " << i;
        for (const auto grid : {internal::Grid::Half, internal::Grid::Full, internal::Grid::Fine}) {
            ASSERT_GE(internal::layer_bound_on(grid, *mesh, c.volume, c.space), truth)
                << "mesh " << i;
        }
        const std::uint32_t coarse = coarse_layer_bound(*mesh, c.volume, c.space);
        ASSERT_GE(coarse, truth) << "mesh " << i;
        ASSERT_GE(quick, coarse) << "mesh " << i;
        // Many edges at a time bound what one by one do.
        const internal::SideIndices sides{
            std::span(c.volume.indices).subspan(c.volume.sides.first, c.volume.sides.count),
            c.volume.made_with.one_far_point() ? std::size_t{3} : std::size_t{6}};
        const LightLocal light{glm::vec4(c.space.light)};
        const auto upright = internal::bound_by_upright_planes(*mesh, light, sides);
        ASSERT_EQ(upright, internal::bound_by_upright_planes_plain(*mesh, light, sides));
        if (upright) {
            ASSERT_GE(*upright, truth) << "mesh " << i;
        }
        single += upright ? 1 : 0;
        (from_outside ? outside : inside) += 1;
        deep += truth > 4 ? 1 : 0;
        slack += bound - truth;
    }
    EXPECT_GT(outside, 500);
    EXPECT_GT(inside, 200);
    EXPECT_GT(deep, 300);
    EXPECT_GT(single, 500) << "light outside, in single precision";
    EXPECT_LT(slack / 3'000, 4.0);
    RecordProperty("mean_slack_in_thousandths", static_cast<int>(slack / 3.0));
}

TEST(LayerBound, IsNeverBelowTheTruthUnderSingularPoses) {
    GNOMON_RANDOM(random);
    int deep = 0;
    for (int i = 0; i < 600; ++i) {
        Case c{test::build(pile(random)), {}, {}, {}};
        glm::dmat4 pose(random.rotation());
        pose[static_cast<glm::length_t>(random.below(3))] *= 0.0;
        c.space.space_from_local = glm::dmat4(glm::mat4(random.rotation())) * pose;
        c.space.light = glm::dvec4(random.in_cube(6.0), random.chance(0.3) ? 0.0 : 1.0);
        classify_faces_flattened(*c.mesh, c.space.space_from_local, c.space.light, c.facing);
        build_case_volume(c, FarVertices::AtInfinity);
        const std::uint32_t truth = most_faces(random, c, 40);
        ASSERT_GE(layer_bound(*c.mesh, c.volume, c.space), truth) << "mesh " << i;
        ASSERT_GE(coarse_layer_bound(*c.mesh, c.volume, c.space), truth) << "mesh " << i;
        deep += truth > 4 ? 1 : 0;
    }
    EXPECT_GT(deep, 100);
}

// Concentric spheres, or copies of one.
Triangles shells(int count, float growth) {
    Triangles mesh;
    for (int i = 0; i < count; ++i) {
        mesh = test::merged(std::move(mesh),
                            test::sphere(6, 12, 1.0F + growth * static_cast<float>(i)));
    }
    return mesh;
}

TEST(LayerBound, IsExactOnNestedShells) {
    for (const glm::vec4 light :
         {glm::vec4(3.0F, 9.0F, 2.0F, 1.0F), glm::vec4(0.3F, 1.0F, 0.2F, 0.0F)}) {
        for (const int count : {1, 2, 100, 127, 128, 255, 256, 300}) {
            const Case c = make_case(test::build(shells(count, 0.01F)), {light});
            EXPECT_GE(layer_bound(*c.mesh, c.volume, c.space), count);
            EXPECT_GE(coarse_layer_bound(*c.mesh, c.volume, c.space), count);
            EXPECT_LE(coarse_layer_bound(*c.mesh, c.volume, c.space), 2 * count + 1);
            EXPECT_LE(layer_bound(*c.mesh, c.volume, c.space), count + 1);
        }
    }
}

TEST(LayerBound, FromWithinShellsCountsEachOnce) {
    const Case c = make_case(test::build(shells(200, 0.01F)), {{0.1F, 0.2F, 0.05F, 1.0F}});
    EXPECT_GE(layer_bound(*c.mesh, c.volume, c.space), 200U);
    // At a corner of the cube of pictures an edge may be in doubt.
    EXPECT_LE(layer_bound(*c.mesh, c.volume, c.space), 220U);
}

TEST(LayerBound, OfAFineConvexMeshIsOne) {
    for (const glm::vec4 light :
         {glm::vec4(3.0F, 9.0F, 2.0F, 1.0F), glm::vec4(0.3F, 1.0F, 0.2F, 0.0F)}) {
        const Case c = make_case(test::build(test::sphere(60, 120)), {light});
        EXPECT_LE(layer_bound(*c.mesh, c.volume, c.space), 2U);
    }
}

TEST(LayerBound, SeenFromOutsideMeansAHalfSpace) {
    const auto mesh = test::build(test::box());
    EXPECT_TRUE(seen_from_outside(*mesh, {glm::dmat4(1.0), {0.0, 1.5, 0.0, 1.0}}));
    EXPECT_FALSE(seen_from_outside(*mesh, {glm::dmat4(1.0), {0.0, 0.5, 0.0, 1.0}}));
    EXPECT_FALSE(seen_from_outside(*mesh, {glm::dmat4(1.0), {0.0, 1.0, 0.0, 1.0}}));
    EXPECT_TRUE(seen_from_outside(*mesh, {glm::dmat4(1.0), {0.0, 0.5, 0.0, 0.0}}));
}

// ---------------------------------------------------------------------------------------------
// Splitting

using FaceCounts = std::map<std::array<std::uint32_t, 3>, int>;

void add_caps(const ShadowMesh& mesh, const Volume& volume, FaceCounts& counts) {
    int sign = 1;
    for (const CapList& list : volume.near_caps()) {
        for_each_cap_face(mesh, volume, list,
                          [&](const std::array<std::uint32_t, 3>& face) { counts[face] += sign; });
        sign = -1;
    }
}

void expect_parts_make_the_whole(const Case& c, std::uint32_t limit) {
    FaceCounts whole;
    add_caps(*c.mesh, c.volume, whole);
    FaceCounts together;
    std::uint32_t averted = 0;
    for (const LayerPart& part : split_volume(*c.mesh, c.volume, c.space, limit)) {
        EXPECT_FALSE(part.volume.empty());
        EXPECT_TRUE(is_closed(*c.mesh, part.volume));
        EXPECT_LE(part.layers, limit);
        EXPECT_EQ(part.layers, layer_bound(*c.mesh, part.volume, c.space));
        add_caps(*c.mesh, part.volume, together);
        averted += part.volume.near_cap_averted.faces;
    }
    EXPECT_EQ(together, whole);
    EXPECT_EQ(averted, c.volume.near_cap_averted.faces);
}

TEST(SplitVolume, PartsAreClosedAndMakeTheWhole) {
    GNOMON_RANDOM(random);
    int averted = 0;
    for (int i = 0; i < 400; ++i) {
        const auto mesh =
            test::build(random.chance(0.5) ? test::random_mesh(random) : pile(random));
        const FarVertices far_vertices =
            random.chance(0.5) ? FarVertices::AtInfinity : FarVertices::Finite;
        const Case c = make_case(mesh, test::random_light(random, *mesh), far_vertices,
                                 random.chance(0.5) ? NearCaps::Facing : NearCaps::Averted);
        averted += c.volume.near_cap_averted.faces > 0 ? 1 : 0;
        for (const std::uint32_t limit : {1U, 3U, 127U}) {
            SCOPED_TRACE(testing::Message() << "mesh " << i << " limit " << limit);
            expect_parts_make_the_whole(c, limit);
            if (HasFailure()) return;
        }
    }
    EXPECT_GT(averted, 20);
}

TEST(SplitVolume, AVolumeWithinTheLimitIsOnePartAndTheSame) {
    const Case c = make_case(test::build(test::torus(24, 12)), {{3.0F, 5.0F, 1.0F, 1.0F}});
    const auto parts = split_volume(*c.mesh, c.volume, c.space, 127);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].volume.indices, c.volume.indices);
    EXPECT_EQ(parts[0].volume.ranges, c.volume.ranges);
    EXPECT_FALSE(c.volume.ranges.empty());
}

TEST(SplitVolume, ShellsAreCutBetweenEachOther) {
    const Case c = make_case(test::build(shells(300, 0.01F)), {{3.0F, 9.0F, 2.0F, 1.0F}});
    const auto parts = split_volume(*c.mesh, c.volume, c.space, 127);
    EXPECT_EQ(parts.size(), 3U);
    std::uint32_t sides = 0;
    for (const LayerPart& part : parts) sides += part.volume.sides.count;
    EXPECT_EQ(sides, c.volume.sides.count) << "no side was added";
}

// A winding stair: one patch that faces the light everywhere and lies over itself `turns` times.
Triangles stair(int turns, int steps_a_turn) {
    Triangles mesh;
    for (int i = 0; i <= turns * steps_a_turn; ++i) {
        const double angle = 6.283185307179586 * i / steps_a_turn;
        const auto y = static_cast<float>(0.01 * i / steps_a_turn);
        for (const double r : {0.2, 1.0}) {
            mesh.positions.emplace_back(r * std::cos(angle), y, r * std::sin(angle));
        }
        const auto v = static_cast<std::uint32_t>(2 * i);
        if (i > 0) mesh.indices.insert(mesh.indices.end(), {v - 2, v, v - 1, v - 1, v, v + 1});
    }
    return mesh;
}

TEST(SplitVolume, APatchThatOverlapsItselfIsCutByDistance) {
    const Case c = make_case(test::build(stair(300, 16)), {{0.3F, 9.0F, 0.2F, 1.0F}});
    ASSERT_EQ(c.mesh->report().components, 1U);
    const std::uint32_t bound = layer_bound(*c.mesh, c.volume, c.space);
    EXPECT_GE(bound, 300U);
    EXPECT_LE(bound, 310U);
    const auto parts = split_volume(*c.mesh, c.volume, c.space, 127);
    EXPECT_LE(parts.size(), 4U);
    expect_parts_make_the_whole(c, 127);
}

}  // namespace
}  // namespace gnomon::shadows
