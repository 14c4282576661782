// SPDX-License-Identifier: MIT
//
// What tools tell of a mesh: kinds of edges, figures of each component, and how it casts.
#include <gnomon/shadows/topology.hpp>

#include <array>

#include <gtest/gtest.h>

#include <gnomon/shadows/orientation.hpp>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

TEST(Topology, AnEdgeIsWhatItsUsesAre) {
    const FaceUse along{0, 0};
    const FaceUse back{1, 1};
    EXPECT_EQ(edge_kind(std::array{along, back}), EdgeKind::Regular);
    EXPECT_EQ(edge_kind(std::array{along}), EdgeKind::Boundary);
    EXPECT_EQ(edge_kind(std::array{back, back}), EdgeKind::Inconsistent);
    EXPECT_EQ(edge_kind(std::array{along, back, along}), EdgeKind::NonManifold);
    EXPECT_EQ(edge_kind(std::array{along, back, along, back}), EdgeKind::NonManifold);
    EXPECT_EQ(edge_balance(std::array{along, back, along, back}), 0);
    EXPECT_EQ(edge_balance(std::array{back, back}), -2);
}

TEST(Topology, ComponentsAreCountedApart) {
    test::Triangles mesh = test::box();
    mesh = test::merged(mesh, test::moved(test::sheet(1), {5.0F, 0.0F, 0.0F}));
    mesh = test::merged(mesh, test::moved(test::book(3), {10.0F, 0.0F, 0.0F}));
    test::Triangles flipped = test::box();
    test::flip_face(flipped, 0);
    mesh = test::merged(mesh, test::moved(flipped, {15.0F, 0.0F, 0.0F}));
    mesh = test::merged(mesh, test::moved(test::inside_out(test::box()), {20.0F, 0.0F, 0.0F}));
    mesh = test::merged(mesh, test::tetrahedron({25, 0, 0}, {26, 0, 0}, {27, 0, 0}, {28, 0, 0}));
    const auto built = test::build(mesh);
    const auto components = built->components();
    ASSERT_EQ(components.size(), 6U);

    const Component& box = components[0];
    EXPECT_EQ(box.edges, 18U);
    EXPECT_EQ(box.boundary_edges + box.non_manifold_edges + box.inconsistent_edges +
                  box.unbalanced_edges + box.degenerate_faces,
              0U);
    EXPECT_EQ(caster_kind(box), CasterKind::OneSided);

    EXPECT_EQ(components[1].edges, 5U);
    EXPECT_EQ(components[1].boundary_edges, 4U);
    EXPECT_EQ(components[1].unbalanced_edges, 4U);
    EXPECT_EQ(caster_kind(components[1]), CasterKind::TwoSided);

    EXPECT_EQ(components[2].boundary_edges, 9U);
    EXPECT_EQ(components[2].non_manifold_edges, 1U);
    EXPECT_EQ(components[2].unbalanced_edges, 10U);
    EXPECT_EQ(caster_kind(components[2]), CasterKind::TwoSided);

    EXPECT_EQ(components[3].inconsistent_edges, 3U);
    EXPECT_EQ(components[3].unbalanced_edges, 3U);
    EXPECT_EQ(caster_kind(components[3]), CasterKind::TwoSided);

    EXPECT_EQ(components[4].unbalanced_edges, 0U);
    EXPECT_EQ(caster_kind(components[4]), CasterKind::InsideOut);

    EXPECT_EQ(components[5].faces, 4U);
    EXPECT_EQ(components[5].degenerate_faces, 4U);
    EXPECT_EQ(caster_kind(components[5]), CasterKind::Nothing);
}

TEST(Topology, ComponentsAddUpToTheReport) {
    GNOMON_RANDOM(random);
    for (int round = 0; round < 300; ++round) {
        const auto mesh =
            test::build(test::merged(test::random_mesh(random), test::random_mesh(random)));
        Component sum;
        std::uint64_t closed = 0;
        for (const Component& c : mesh->components()) {
            sum.faces += c.faces;
            sum.edges += c.edges;
            sum.boundary_edges += c.boundary_edges;
            sum.non_manifold_edges += c.non_manifold_edges;
            sum.inconsistent_edges += c.inconsistent_edges;
            sum.unbalanced_edges += c.unbalanced_edges;
            sum.degenerate_faces += c.degenerate_faces;
            closed += c.closed ? 1U : 0U;
            EXPECT_EQ(c.closed, c.unbalanced_edges == 0);
        }
        const MeshReport& r = mesh->report();
        EXPECT_EQ(sum.faces, r.triangles);
        EXPECT_EQ(sum.edges, r.edges);
        EXPECT_EQ(sum.boundary_edges, r.boundary_edges);
        EXPECT_EQ(sum.non_manifold_edges, r.non_manifold_edges);
        EXPECT_EQ(sum.inconsistent_edges, r.inconsistent_edges);
        EXPECT_EQ(sum.unbalanced_edges, r.unbalanced_edges);
        EXPECT_EQ(sum.degenerate_faces, r.degenerate_faces);
        EXPECT_EQ(closed, r.closed_components);
    }
}

TEST(Topology, DegenerateIsExact) {
    GNOMON_RANDOM(random);
    std::size_t degenerate = 0;
    for (int round = 0; round < 100; ++round) {
        const auto mesh = test::build(test::random_mesh(random));
        for (std::size_t f = 0; f < mesh->faces().size(); ++f) {
            const auto& [a, b, c] = mesh->faces()[f];
            const auto p = mesh->positions();
            EXPECT_EQ(mesh->is_degenerate(f), exactly_collinear(p[a], p[b], p[c])) << round;
            degenerate += mesh->is_degenerate(f) ? 1U : 0U;
        }
    }
    EXPECT_GT(degenerate, 0U);
}

}  // namespace
}  // namespace gnomon::shadows
