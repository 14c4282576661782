// SPDX-License-Identifier: MIT
//
// Silhouettes: the signed boundary of weighted faces, held against a recount that knows no edges.
#include <gnomon/shadows/silhouette.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/shadows/facing.hpp>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;

// Straight from the faces: +weight along each of their edges, -weight against it.
std::vector<SilhouetteEdge> recounted(const ShadowMesh& mesh,
                                      const std::vector<std::int8_t>& weights) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> along;
    for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = mesh.faces()[f][i];
            const std::uint32_t to = mesh.faces()[f][(i + 1) % 3];
            along[{from, to}] += weights[f];
            along[{to, from}] -= weights[f];
        }
    }
    std::vector<SilhouetteEdge> edges;
    for (const auto& [edge, count] : along) {
        if (count > 0) edges.push_back({edge.first, edge.second, count});
    }
    return edges;
}

std::vector<std::int8_t> random_weights(Random& random, const ShadowMesh& mesh) {
    std::vector<std::int8_t> weights;
    for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
        weights.push_back(static_cast<std::int8_t>(random.integer(-2, 2)));
    }
    return weights;
}

TEST(Silhouette, IsWhatARecountFinds) {
    GNOMON_RANDOM(random);
    for (int i = 0; i < 3'000; ++i) {
        const auto mesh = test::build(test::random_mesh(random));
        std::vector<std::int8_t> weights = random_weights(random, *mesh);
        if (i % 2 == 0) {
            Facing facing;
            classify_faces(*mesh, test::random_light(random, *mesh), facing);
            weights = facing.weights;
        }
        std::vector<SilhouetteEdge> found{{7, 8, 9}};  // what was there before is gone
        find_silhouette(*mesh, weights, found);
        std::ranges::sort(found);
        ASSERT_EQ(found, recounted(*mesh, weights)) << "mesh " << i;
    }
}

TEST(Silhouette, EntersEveryVertexAsOftenAsItLeaves) {
    GNOMON_RANDOM(random);
    std::vector<SilhouetteEdge> edges;
    for (int i = 0; i < 3'000; ++i) {
        const auto mesh = test::build(test::random_mesh(random));
        find_silhouette(*mesh, random_weights(random, *mesh), edges);
        std::map<std::uint32_t, int> sum;
        for (const SilhouetteEdge& edge : edges) {
            ASSERT_GT(edge.count, 0);
            sum[edge.from] += edge.count;
            sum[edge.to] -= edge.count;
        }
        for (const auto& [vertex, total] : sum) ASSERT_EQ(total, 0) << "vertex " << vertex;
    }
}

TEST(Silhouette, OfABoxIsItsOutline) {
    const auto mesh = test::build(test::box_with_seams());
    Facing facing;
    std::vector<SilhouetteEdge> edges;
    classify_faces(*mesh, {{5, 6, 7, 1}}, facing);
    find_silhouette(*mesh, facing.weights, edges);
    EXPECT_EQ(edges.size(), 6U);  // a corner view: a hexagon
    classify_faces(*mesh, {{5, 0.5F, 0.25F, 1}}, facing);
    find_silhouette(*mesh, facing.weights, edges);
    EXPECT_EQ(edges.size(), 4U);  // one side
    for (const SilhouetteEdge& edge : edges) EXPECT_EQ(edge.count, 1);
    classify_faces(*mesh, {{0, 0, 0, 1}}, facing);
    find_silhouette(*mesh, facing.weights, edges);
    EXPECT_TRUE(edges.empty());  // from inside everything is shadow: no boundary
}

TEST(Silhouette, TouchesNoEdgeThatTheLightLiesOn) {
    GNOMON_RANDOM(random);
    int on_vertex = 0;
    for (int i = 0; i < 1'000; ++i) {
        const auto mesh = test::build(test::random_mesh(random));
        const std::uint32_t v = random.below(mesh->positions().size());
        Facing facing;
        classify_faces(*mesh, {{mesh->positions()[v], 1.0F}}, facing);
        std::vector<SilhouetteEdge> edges;
        find_silhouette(*mesh, facing.weights, edges);
        for (const SilhouetteEdge& edge : edges) {
            ASSERT_NE(edge.from, v);
            ASSERT_NE(edge.to, v);
        }
        on_vertex += edges.empty() ? 0 : 1;
    }
    EXPECT_GT(on_vertex, 300);
}

TEST(Silhouette, CountsThousandFacesOnOneEdge) {
    const auto mesh = test::build(test::book(1'000));
    std::vector<std::int8_t> weights(mesh->faces().size(), 1);
    for (std::size_t f = 1; f < weights.size(); f += 2) weights[f] = 0;  // keep those at the spine
    std::vector<SilhouetteEdge> edges;
    find_silhouette(*mesh, weights, edges);
    int most = 0;
    for (const SilhouetteEdge& edge : edges) most = std::max(most, edge.count);
    // Of each page's two triangles one has the spine.
    for (std::size_t f = 0; f < weights.size(); ++f) weights[f] = 1;
    find_silhouette(*mesh, weights, edges);
    for (const SilhouetteEdge& edge : edges) most = std::max(most, edge.count);
    EXPECT_EQ(most, 1'000);
}

}  // namespace
}  // namespace gnomon::shadows
