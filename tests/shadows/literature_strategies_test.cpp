// SPDX-License-Identifier: MIT
//
// What the strategies of the literature promise beyond the right answer, which detector_test.cpp
// sees to: which edges they spare themselves.
#include <gnomon/shadows/detector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

std::uint64_t edges_tested(std::string_view strategy, const ShadowMesh& mesh, LightLocal light) {
    const auto detector = find_strategy(strategy)->create();
    return detector->detect(mesh, light, NearCaps::Facing).stats.edges_tested;
}

constexpr LightLocal light{{5, 6, 7, 1}};

TEST(VisibleNonVisible, LooksAtTheBordersOfPolygonsAlone) {
    const auto box = test::build(test::box());
    EXPECT_EQ(box->edges().size(), 18U);
    EXPECT_EQ(edges_tested("vnv", *box, light), 12U);
    const auto sheet = test::build(test::sheet(10));
    EXPECT_EQ(edges_tested("vnv", *sheet, light), 40U);
}

TEST(VisibleNonVisible, KnowsNoToleranceOfFlatness) {
    test::Triangles quad{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 3}};
    EXPECT_EQ(edges_tested("vnv", *test::build(quad), light), 4U);
    quad.positions[3].z = std::numeric_limits<float>::denorm_min();
    EXPECT_EQ(edges_tested("vnv", *test::build(quad), light), 5U);
}

TEST(VisibleNonVisible, KeepsTheEdgeOfAFold) {
    // Both of one plane, but turned to opposite sides of it.
    const test::Triangles fold{{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {1, 0.5F, 0}}, {0, 1, 2, 1, 0, 3}};
    EXPECT_EQ(edges_tested("vnv", *test::build(fold), light), 5U);
}

TEST(HexTree, LeavesOutMostEdgesOfASmoothMesh) {
    const auto mesh = test::build(test::sphere(150, 300));
    GNOMON_RANDOM(random);
    for (int i = 0; i < 20; ++i) {
        const float directional = i % 2 == 0 ? 1.0F : 0.0F;
        const LightLocal somewhere{glm::vec4(3.0 * random.unit_vector(), directional)};
        EXPECT_LT(edges_tested("hextree", *mesh, somewhere), mesh->edges().size() / 4);
    }
}

// Nothing can be left out where an edge has one face, whatever its place in dual space.
TEST(HexTree, LooksAtEveryBoundaryEdge) {
    GNOMON_RANDOM(random);
    test::Triangles soup;
    for (std::uint32_t i = 0; i < 300; ++i) {
        soup.positions.emplace_back(random.in_cube(1.0));
        soup.indices.push_back(i);
    }
    const auto mesh = test::build(soup);
    EXPECT_EQ(mesh->report().boundary_edges, mesh->edges().size());
    EXPECT_EQ(edges_tested("hextree", *mesh, light), mesh->edges().size());
}

// The offsets of these two sheets differ by more than a float can say.
TEST(HexTree, PlacesPlanesThatLieFarApart) {
    constexpr float size = 1e38F;
    constexpr float high = 2.5e38F;
    const auto mesh = test::build({{{0, 0, high},
                                    {size, 0, high},
                                    {size, size, high},
                                    {0, size, high},
                                    {0, 0, -high},
                                    {size, 0, -high},
                                    {size, size, -high},
                                    {0, size, -high}},
                                   {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7}});
    const LightLocal above{{0.3F * size, 0.2F * size, 3e38F, 1.0F}};
    const auto find = [&](std::string_view strategy) {
        const auto detector = find_strategy(strategy)->create();
        std::vector<SilhouetteEdge> edges =
            detector->detect(*mesh, above, NearCaps::Facing).silhouette;
        std::ranges::sort(edges);
        return edges;
    };
    EXPECT_FALSE(find("brute_force").empty());
    EXPECT_EQ(find("hextree"), find("brute_force"));
}

// Equal ends, but not one pair: Lengyel's list has such an edge several times, the answer once.
TEST(EdgeList, SumsUpTheEdgeOfABook) {
    const auto mesh = test::build(test::book(7));
    const auto detector = find_strategy("edge_list")->create();
    const LightLocal above{{0.3F, 40.0F, 0.1F, 1.0F}};
    const Detection& found = detector->detect(*mesh, above, NearCaps::Facing);
    std::vector<SilhouetteEdge> edges = found.silhouette;
    std::ranges::sort(edges);
    EXPECT_EQ(std::ranges::adjacent_find(
                  edges, {}, [](const SilhouetteEdge& e) { return std::minmax(e.from, e.to); }),
              edges.end());
}

}  // namespace
}  // namespace gnomon::shadows
