// SPDX-License-Identifier: MIT
//
// Costs are those of the volumes that are built, and what is known of simple shapes.
#include <gnomon/shadows/casting_cost.hpp>

#include <algorithm>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/orientation.hpp>
#include <gnomon/shadows/silhouette.hpp>
#include <gnomon/shadows/volume.hpp>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

TEST(CastingCost, DirectionsAreOppositeUnitVectorsAllAround) {
    const auto directions = sample_directions();
    glm::dvec3 sum(0.0);
    double of_squares_x = 0.0;
    std::set<std::tuple<float, float, float>> different;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        EXPECT_NEAR(glm::length(directions[i]), 1.0F, 1e-6F);
        EXPECT_EQ(directions[i ^ 1U], -directions[i]);
        EXPECT_TRUE(glm::all(glm::notEqual(directions[i], glm::vec3(0.0F))));
        different.insert({directions[i].x, directions[i].y, directions[i].z});
        sum += glm::dvec3(directions[i]);
        of_squares_x += static_cast<double>(directions[i].x) * directions[i].x;
    }
    EXPECT_EQ(different.size(), sample_direction_count);
    EXPECT_NEAR(glm::length(sum), 0.0, 1e-6);
    EXPECT_NEAR(of_squares_x / sample_direction_count, 1.0 / 3.0, 0.01);  // as over a sphere
}

TEST(CastingCost, OfABox) {
    // From anywhere that is not level with a side, a box shows three sides of six triangles and its
    // outline has six edges; two-sided, every side quad is there twice.
    const MeshCost cost = measure_cost(*test::build(test::box()));
    const VolumeSize one{6, 6, 6};
    const VolumeSize two{6, 12, 12};
    EXPECT_EQ(cost.mesh.as_it_casts.largest, one);
    EXPECT_EQ(cost.mesh.two_sided.largest, two);
    EXPECT_EQ(CastingCost::mean(cost.mesh.as_it_casts.total.silhouette_edges), 6.0);
    EXPECT_EQ(CastingCost::mean(cost.mesh.two_sided.total.side_quads), 12.0);
    EXPECT_EQ(one.index_bytes(), 4U * (6 * 6 + 3 * 6 + 3 * 6));
    ASSERT_EQ(cost.components.size(), 1U);
    EXPECT_EQ(cost.components[0].as_it_casts.total, cost.mesh.as_it_casts.total);
}

TEST(CastingCost, ASheetHasNoOtherWay) {
    const MeshCost cost = measure_cost(*test::build(test::sheet(2)));
    EXPECT_EQ(cost.mesh.as_it_casts.total, cost.mesh.two_sided.total);
    EXPECT_EQ(cost.mesh.as_it_casts.largest, (VolumeSize{8, 8, 8}));
}

TEST(CastingCost, WhatCastsNothingCostsNothing) {
    const MeshCost none = measure_cost(*test::build({}));
    EXPECT_EQ(none.mesh.as_it_casts.total, VolumeSize{});
    EXPECT_TRUE(none.components.empty());
    const MeshCost flat =
        measure_cost(*test::build(test::tetrahedron({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0})));
    EXPECT_EQ(flat.mesh.two_sided.total, VolumeSize{});
}

TEST(CastingCost, CountsTheLayersOfShellsWithinShells) {
    EXPECT_EQ(measure_cost(*test::build({})).most_layers, 0U);
    EXPECT_EQ(measure_cost(*test::build(test::box({0, 0, 0}, {1, 1, 1}))).most_layers, 1U);
    test::Triangles shells;
    for (int i = 0; i < 3; ++i) {
        const float size = 3.0F - static_cast<float>(i);
        shells = test::merged(shells, test::box(glm::vec3(-size), glm::vec3(size)));
    }
    const std::uint32_t layers = measure_cost(*test::build(shells)).most_layers;
    EXPECT_GE(layers, 3U);
    EXPECT_LE(layers, 4U) << "the bound is off by one at most on nested shells";
}

// Against the volumes themselves, with two-sided weights decided face by face.
TEST(CastingCost, IsThatOfTheVolumesThatAreBuilt) {
    GNOMON_RANDOM(random);
    for (int round = 0; round < 20; ++round) {
        test::Triangles triangles = test::random_mesh(random);
        if (round % 4 == 0) triangles = test::sphere(6, 8);
        if (round % 4 == 1) triangles = test::inside_out(test::torus(8, 6));
        const auto mesh = test::build(test::merged(triangles, test::box({7, 0, 0}, {8, 1, 1})));
        VolumeSize as_it_casts;
        VolumeSize two_sided;
        std::uint64_t most_bytes = 0;
        std::uint64_t most_edges = 0;
        for (const glm::vec3& direction : sample_directions()) {
            const LightLocal light{glm::vec4(direction, 0.0F)};
            Facing facing;
            classify_faces(*mesh, light, facing);
            std::vector<std::int8_t> both(mesh->faces().size());
            const auto p = mesh->positions();
            for (std::size_t f = 0; f < both.size(); ++f) {
                const auto& [a, b, c] = mesh->faces()[f];
                both[f] = static_cast<std::int8_t>(exact_facing(p[a], p[b], p[c], light));
            }
            const auto measure = [&](const std::vector<std::int8_t>& weights, VolumeSize& sum) {
                std::vector<SilhouetteEdge> silhouette;
                find_silhouette(*mesh, weights, silhouette);
                Volume volume;
                build_volume(*mesh, weights, silhouette, false, FarVertices::AtInfinity, volume);
                VolumeSize size;
                size.silhouette_edges = volume.silhouette_edges;
                size.side_quads = volume.sides.count / 6;
                size.cap_triangles = volume.cap_faces();
                EXPECT_EQ(size.index_bytes(), volume.indices.size() * sizeof(std::uint32_t));
                sum += size;
                return size;
            };
            const VolumeSize size = measure(facing.weights, as_it_casts);
            most_bytes = std::max(most_bytes, size.index_bytes());
            most_edges = std::max(most_edges, size.silhouette_edges);
            measure(both, two_sided);
        }
        const MeshCost cost = measure_cost(*mesh);
        EXPECT_EQ(cost.mesh.as_it_casts.total, as_it_casts) << round;
        EXPECT_EQ(cost.mesh.two_sided.total, two_sided) << round;
        EXPECT_EQ(cost.mesh.as_it_casts.largest_index_bytes, most_bytes) << round;
        EXPECT_EQ(cost.mesh.as_it_casts.largest.silhouette_edges, most_edges) << round;
        VolumeSize of_components;
        for (const CasterCost& one : cost.components) of_components += one.as_it_casts.total;
        EXPECT_EQ(of_components, as_it_casts) << round;
    }
}

}  // namespace
}  // namespace gnomon::shadows
