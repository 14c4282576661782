// SPDX-License-Identifier: MIT
//
// Edge quads make the very triangles that build_volume() makes, and are closed whatever the faces
// are said to do.
#include <gnomon/shadows/edge_quads.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <gnomon/shadows/orientation.hpp>
#include <gnomon/shadows/silhouette.hpp>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;

// Closed, with lights mostly in planes of faces: grids, merged shapes that touch, and the closed
// ones among the meshes that attack everything else.
std::shared_ptr<const ShadowMesh> closed_mesh(Random& random) {
    for (;;) {
        test::Triangles triangles;
        const auto place = [&] {
            return glm::vec3(random.integer(-3, 3), random.integer(-3, 3), random.integer(-3, 3));
        };
        switch (random.integer(0, 5)) {
            case 0: triangles = test::box(); break;
            case 1: triangles = test::sphere(random.integer(3, 9), random.integer(3, 12)); break;
            case 2: triangles = test::torus(random.integer(3, 9), random.integer(3, 12)); break;
            case 3: triangles = test::box_with_seams(); break;
            case 4: triangles = test::tetrahedron(place(), place(), place(), place()); break;
            default: triangles = test::random_mesh(random); break;
        }
        while (random.chance(0.3)) {
            triangles =
                test::merged(std::move(triangles), test::moved(test::box(), 3.0F * place()));
        }
        auto mesh = test::build(triangles);
        if (fits_edge_quads(*mesh)) return mesh;
    }
}

// The light outside of all components.
LightLocal light_of(Random& random, const ShadowMesh& mesh) {
    for (;;) {
        LightLocal light = test::random_light(random, mesh);
        if (one_sided_margin(mesh, light)) return light;
        light.position += glm::vec4(10.0 * random.unit_vector(), 0.0);
        if (one_sided_margin(mesh, light)) return light;
    }
}

using Corners = std::array<std::uint32_t, 3>;

std::vector<Corners> sorted(const Volume& volume, const IndexRange& range) {
    std::vector<Corners> result;
    for (std::uint32_t i = range.first; i < range.first + range.count; i += 3) {
        result.push_back({volume.indices[i], volume.indices[i + 1], volume.indices[i + 2]});
    }
    std::ranges::sort(result);
    return result;
}

void expect_same(const Volume& actual, const Volume& expected) {
    EXPECT_EQ(sorted(actual, actual.sides), sorted(expected, expected.sides));
    EXPECT_EQ(sorted(actual, actual.far_cap), sorted(expected, expected.far_cap));
    for (std::size_t i = 0; i < 3; ++i) {
        const CapList caps = actual.near_caps()[i];
        const CapList wanted = expected.near_caps()[i];
        EXPECT_EQ(sorted(actual, caps.triples), sorted(expected, wanted.triples)) << i;
        EXPECT_EQ(caps.faces, wanted.faces) << i;
    }
    EXPECT_EQ(actual.far_copies, expected.far_copies);
    EXPECT_EQ(actual.silhouette_edges, expected.silhouette_edges);
}

TEST(EdgeQuads, AreTheVolumeOfTheWeights) {
    GNOMON_RANDOM(random);
    int with_edge_on_faces = 0;
    for (int i = 0; i < 3'000; ++i) {
        const auto mesh = closed_mesh(random);
        const LightLocal light = light_of(random, *mesh);
        const NearCaps near_caps = random.chance(0.5) ? NearCaps::Facing : NearCaps::Averted;
        const FarVertices far = random.chance(0.5) ? FarVertices::AtInfinity : FarVertices::Finite;
        Facing facing;
        classify_faces(*mesh, light, facing, near_caps);
        std::vector<SilhouetteEdge> silhouette;
        find_silhouette(*mesh, facing.weights, silhouette);
        Volume expected;
        build_volume(*mesh, facing.weights, silhouette, light.is_directional(), far, expected,
                     facing.solid_averted);

        const bool one_far_point = light.is_directional() && far == FarVertices::AtInfinity;
        const Volume actual =
            quad_volume(*mesh, face_bits(facing.weights), near_caps, one_far_point);
        EXPECT_TRUE(is_closed(*mesh, actual));
        expect_same(actual, expected);
        ASSERT_FALSE(HasFailure()) << "mesh " << i;
        const auto averted =
            static_cast<std::size_t>(std::ranges::count(facing.weights, std::int8_t{0}));
        classify_faces(*mesh, light, facing,
                       near_caps == NearCaps::Facing ? NearCaps::Averted : NearCaps::Facing);
        const auto facing_ones =
            static_cast<std::size_t>(std::ranges::count(facing.weights, std::int8_t{0}));
        with_edge_on_faces += averted + facing_ones > mesh->faces().size() ? 1 : 0;
    }
    EXPECT_GT(with_edge_on_faces, 500) << "lights in the planes of faces";
}

TEST(EdgeQuads, AreClosedWhateverCasts) {
    GNOMON_RANDOM(random);
    for (int i = 0; i < 1'000; ++i) {
        const auto mesh = closed_mesh(random);
        FaceBits bits((mesh->faces().size() + 31) / 32);
        for (std::uint32_t& word : bits) word = random.bits();
        for (const NearCaps near_caps : {NearCaps::Facing, NearCaps::Averted}) {
            for (const bool one_far_point : {false, true}) {
                ASSERT_TRUE(is_closed(*mesh, quad_volume(*mesh, bits, near_caps, one_far_point)))
                    << "mesh " << i;
            }
        }
    }
}

// A quad that is turned the wrong way, or a face asked twice with different answers, would show.
TEST(EdgeQuads, AreNotClosedWithOneMissing) {
    const auto mesh = test::build(test::sphere(6, 9));
    Facing facing;
    classify_faces(*mesh, {{4, 5, 6, 1}}, facing);
    Volume volume = quad_volume(*mesh, face_bits(facing.weights), NearCaps::Facing, false);
    ASSERT_TRUE(is_closed(*mesh, volume));
    std::swap(volume.indices[0], volume.indices[1]);
    EXPECT_FALSE(is_closed(*mesh, volume));
}

TEST(EdgeQuads, InSinglePrecisionDifferOnlyInFacesAllButEdgeOn) {
    GNOMON_RANDOM(random);
    int faces = 0;
    int different = 0;
    for (int i = 0; i < 3'000; ++i) {
        const auto mesh = closed_mesh(random);
        const LightLocal light = light_of(random, *mesh);
        const NearCaps near_caps = random.chance(0.5) ? NearCaps::Facing : NearCaps::Averted;
        Facing facing;
        classify_faces(*mesh, light, facing, near_caps);
        const FaceBits exact = face_bits(facing.weights);
        const FaceBits single = face_bits_in_single_precision(*mesh, light, near_caps);
        const FacePlanes& planes = mesh->planes();
        const glm::dvec3 towards = light.is_directional()
                                       ? glm::dvec3(light.position)
                                       : glm::dvec3(light.position) - glm::dvec3(planes.origin);
        const double size = std::abs(towards.x) + std::abs(towards.y) + std::abs(towards.z) +
                            static_cast<double>(planes.radius);
        for (std::uint32_t f = 0; f < mesh->faces().size(); ++f) {
            ++faces;
            if (casts(exact, f) == casts(single, f)) continue;
            ++different;
            const double distance =
                glm::dot(glm::dvec3(planes.normal_x[f], planes.normal_y[f], planes.normal_z[f]),
                         towards) +
                static_cast<double>(planes.offset[f]) * (light.is_directional() ? 0.0 : 1.0);
            // Of the light from the face's plane; infinite for slivers, which have no plane there.
            ASSERT_LE(std::abs(distance), static_cast<double>(planes.error[f]) * size * 1.01)
                << "mesh " << i << ", face " << f;
        }
        ASSERT_TRUE(is_closed(*mesh, quad_volume(*mesh, single, near_caps, false))) << i;
    }
    EXPECT_GT(different, 0) << "lights in the planes of faces";
    EXPECT_LT(different, faces / 20);
}

TEST(EdgeQuads, FitClosedMeshesAlone) {
    EXPECT_TRUE(fits_edge_quads(*test::build(test::box())));
    EXPECT_TRUE(fits_edge_quads(*test::build(test::box_with_seams())));
    EXPECT_TRUE(fits_edge_quads(*test::build(test::unindexed(test::torus(5, 7)))));
    EXPECT_FALSE(fits_edge_quads(*test::build({}))) << "nothing";
    EXPECT_FALSE(fits_edge_quads(*test::build(test::sheet(2)))) << "open";
    EXPECT_FALSE(fits_edge_quads(*test::build(test::moebius(8))));
    EXPECT_FALSE(fits_edge_quads(*test::build(test::inside_out(test::box()))));
    test::Triangles flipped = test::box();
    test::flip_face(flipped, 3);
    EXPECT_FALSE(fits_edge_quads(*test::build(flipped))) << "inconsistent";
    const auto two = test::merged(test::box(), test::box(glm::vec3(1.0F), glm::vec3(2.0F)));
    EXPECT_TRUE(fits_edge_quads(*test::build(two))) << "they share a corner";
    const auto four = test::merged(test::box(), test::box({1, 1, -1}, {2, 2, 1}));
    EXPECT_FALSE(fits_edge_quads(*test::build(four))) << "they share an edge";
    const auto one_open = test::merged(test::box(), test::moved(test::sheet(1), glm::vec3(5.0F)));
    EXPECT_FALSE(fits_edge_quads(*test::build(one_open))) << "one component of two";
}

TEST(EdgeQuads, KnowHowFarTheLightMayMove) {
    const auto mesh =
        test::build(test::merged(test::box(), test::moved(test::box(), glm::vec3(9, 0, 0))));
    EXPECT_NEAR(one_sided_margin(*mesh, {{0, 4, 0, 1}}).value(), 3.0, 1e-6);
    EXPECT_NEAR(one_sided_margin(*mesh, {{4, 0, 0, 1}}).value(), 3.0, 1e-6) << "between the two";
    EXPECT_FALSE(one_sided_margin(*mesh, {{9, 0, 0, 1}})) << "in the second";
    EXPECT_FALSE(one_sided_margin(*mesh, {{1, 0, 0, 1}})) << "on the first";
    EXPECT_EQ(one_sided_margin(*mesh, {{9, 0, 0, 0}}), std::numeric_limits<double>::infinity());
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(one_sided_margin(*mesh, {{nan, 0, 0, 0}}));
}

TEST(EdgeQuads, BoundLayers) {
    test::Triangles nested;
    for (int i = 1; i <= 20; ++i) {
        const glm::vec3 half(static_cast<float>(i));
        nested = test::merged(std::move(nested), test::box(-half, half));
    }
    const auto mesh = test::build(nested);
    Facing facing;
    classify_faces(*mesh, {{0.1F, 1, 0.2F, 0}}, facing);
    const auto bits = std::make_shared<const FaceBits>(face_bits(facing.weights));
    EXPECT_EQ(quad_layer_bound(*mesh, {.bits = bits}), 6U * 20U) << "three sides a box cast";
    EXPECT_EQ(quad_layer_bound(*mesh, {.facing = QuadFacing::InShader, .bits = nullptr}), 120U);
    classify_faces(*mesh, {{0, 1, 0, 0}}, facing);
    const auto top = std::make_shared<const FaceBits>(face_bits(facing.weights));
    EXPECT_EQ(quad_layer_bound(*mesh, {.bits = top}), 2U * 20U) << "the top side alone casts";
}

}  // namespace
}  // namespace gnomon::shadows
