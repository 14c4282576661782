// SPDX-License-Identifier: MIT
//
// ShadowMesh::build: the report of known shapes (the same figures, by the same definitions, as a
// mesh statistics tool of its own gives), welding, invariants on random meshes, and every error.
#include <gnomon/shadows/shadow_mesh.hpp>
#include <gnomon/shadows/topology.hpp>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/shadows/orientation.hpp>

#include "modules/shadows/internal/detection_tables.hpp"
#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;
using test::Triangles;

struct Figures {
    std::uint64_t triangles, welded, edges, boundary, non_manifold, inconsistent, unbalanced,
        degenerate, components, closed;
    auto operator<=>(const Figures&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Figures& f) {
    return out << f.triangles << " triangles, " << f.welded << " vertices, " << f.edges
               << " edges, " << f.boundary << " boundary, " << f.non_manifold << " non-manifold, "
               << f.inconsistent << " inconsistent, " << f.unbalanced << " unbalanced, "
               << f.degenerate << " degenerate, " << f.closed << " of " << f.components
               << " closed";
}

Figures figures(const Triangles& triangles) {
    const MeshReport r = test::build(triangles)->report();
    return {r.triangles,        r.welded_vertices,    r.edges,
            r.boundary_edges,   r.non_manifold_edges, r.inconsistent_edges,
            r.unbalanced_edges, r.degenerate_faces,   r.components,
            r.closed_components};
}

Triangles without(Triangles mesh, std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) test::remove_face(mesh, first);
    return mesh;
}

// ---------------------------------------------------------------------------------------------
// Known shapes

TEST(ShadowMesh, ReportsClosedShapes) {
    EXPECT_EQ(figures(test::box()), (Figures{12, 8, 18, 0, 0, 0, 0, 0, 1, 1}));
    EXPECT_EQ(figures(test::box_with_seams()), (Figures{12, 8, 18, 0, 0, 0, 0, 0, 1, 1}));
    EXPECT_EQ(test::build(test::box_with_seams())->report().vertices, 24U);
    EXPECT_EQ(figures(test::unindexed(test::torus(32, 16))),
              (Figures{1024, 512, 1536, 0, 0, 0, 0, 0, 1, 1}));
    EXPECT_EQ(figures(test::sphere(16, 24)), (Figures{720, 362, 1080, 0, 0, 0, 0, 0, 1, 1}));
    EXPECT_EQ(figures(test::inside_out(test::sphere(16, 24))),
              (Figures{720, 362, 1080, 0, 0, 0, 0, 0, 1, 1}));
    EXPECT_TRUE(test::build(test::box())->report().closed());
}

TEST(ShadowMesh, ReportsOpenShapes) {
    EXPECT_EQ(figures(without(test::box(), 2, 2)), (Figures{10, 8, 17, 4, 0, 0, 4, 0, 1, 0}));
    EXPECT_EQ(figures(test::sheet(1)), (Figures{2, 4, 5, 4, 0, 0, 4, 0, 1, 0}));
    EXPECT_EQ(figures(test::moebius(48)), (Figures{96, 96, 192, 96, 0, 1, 97, 0, 1, 0}));
    EXPECT_FALSE(test::build(test::sheet(1))->report().closed());
}

TEST(ShadowMesh, ReportsNonManifoldShapes) {
    EXPECT_EQ(figures(test::book(5)), (Figures{10, 12, 21, 15, 1, 0, 16, 0, 1, 0}));
    // Two cubes with one edge, one vertex, one side in common.
    const Triangles cube = test::box({0, 0, 0}, {1, 1, 1});
    EXPECT_EQ(figures(test::merged(cube, test::box({1, 1, 0}, {2, 2, 1}))),
              (Figures{24, 14, 35, 0, 1, 0, 0, 0, 1, 1}));
    EXPECT_EQ(figures(test::merged(cube, test::box({1, 1, 1}, {2, 2, 2}))),
              (Figures{24, 15, 36, 0, 0, 0, 0, 0, 2, 2}));
    EXPECT_EQ(figures(test::merged(cube, test::box({1, 0, 0}, {2, 1, 1}))),
              (Figures{24, 12, 31, 0, 5, 0, 0, 0, 1, 1}));
    // Two tetrahedra that share a face, both copies kept.
    const glm::vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
    EXPECT_EQ(figures(test::merged(test::tetrahedron(a, b, c, {0, 0, 1}),
                                   test::tetrahedron(a, b, c, {0, 0, -1}))),
              (Figures{8, 5, 9, 0, 3, 0, 0, 0, 1, 1}));
    // A quad and the same quad wound back: no thickness, and closed.
    EXPECT_EQ(figures(test::merged(test::sheet(1), test::inside_out(test::sheet(1)))),
              (Figures{4, 4, 5, 0, 1, 0, 0, 0, 1, 1}));
}

TEST(ShadowMesh, ReportsInconsistentAndRepeatedFaces) {
    Triangles flipped = test::box();
    test::flip_face(flipped, 5);
    EXPECT_EQ(figures(flipped), (Figures{12, 8, 18, 0, 0, 3, 3, 0, 1, 0}));
    // Two adjacent sides listed twice.
    Triangles repeated = test::box();
    for (const std::size_t f : {2U, 3U, 6U, 7U}) test::repeat_face(repeated, f);
    const Figures f = figures(repeated);
    EXPECT_EQ(f.triangles, 16U);
    EXPECT_EQ(f.edges, 18U);
    EXPECT_EQ(f.boundary, 0U);
    EXPECT_EQ(f.inconsistent, 0U);
    EXPECT_EQ(f.closed, 0U);
    EXPECT_GT(f.non_manifold, f.unbalanced) << "the repeated sides' diagonals are balanced";
    EXPECT_GT(f.unbalanced, 0U);
}

TEST(ShadowMesh, ATJunctionIsOpenAsAMesh) {
    // One side's edge has a vertex in the middle that its neighbour lacks.
    Triangles mesh = without(test::box(), 0, 1);  // the triangle 0 4 6 of the low x side
    const Triangles whole = test::box();
    const std::uint32_t a = whole.indices[0];
    const std::uint32_t b = whole.indices[1];
    const std::uint32_t c = whole.indices[2];
    const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back((mesh.positions[a] + mesh.positions[b]) * 0.5F);
    mesh.indices.insert(mesh.indices.end(), {a, middle, c, middle, b, c});
    EXPECT_EQ(figures(mesh), (Figures{13, 9, 21, 3, 0, 0, 3, 0, 1, 0}));
    // The flat triangle that some exporters fill it with closes it.
    mesh.indices.insert(mesh.indices.end(), {a, b, middle});
    EXPECT_EQ(figures(mesh), (Figures{14, 9, 21, 0, 0, 0, 0, 1, 1, 1}));
}

TEST(ShadowMesh, CollapsedFacesHaveNoEdgesAndOpenNothing) {
    Triangles mesh = test::box();
    mesh.indices.insert(mesh.indices.end(), {0, 1, 1, 2, 2, 3, 1, 0, 1});
    EXPECT_EQ(figures(mesh), (Figures{15, 8, 18, 0, 0, 0, 0, 3, 1, 1}));
    // On its own it is no shape at all.
    EXPECT_EQ(figures({{{0, 0, 0}, {1, 0, 0}}, {0, 1, 1}}).edges, 0U);
    // Distinct vertices at one position collapse as well.
    EXPECT_EQ(figures({{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, {0, 1, 2}}),
              (Figures{1, 2, 0, 0, 0, 0, 0, 1, 1, 1}));
}

TEST(ShadowMesh, FindsDegenerateFacesExactly) {
    // On a line but for the last bit of one coordinate.
    const float off = std::nextafter(1.0F, 2.0F);
    EXPECT_EQ(figures({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {0, 1, 2}}).degenerate, 1U);
    EXPECT_EQ(figures({{{0, 0, 0}, {1, off, 1}, {2, 2, 2}}, {0, 1, 2}}).degenerate, 0U);
    EXPECT_EQ(figures({{{0, 0, 0}, {1e-30F, 0, 0}, {0, 1e-30F, 0}}, {0, 1, 2}}).degenerate, 0U);
}

TEST(ShadowMesh, WeldsEqualPositionsAndNoOthers) {
    const glm::vec3 p(1, 2, 3);
    const glm::vec3 close(std::nextafter(1.0F, 2.0F), 2, 3);
    EXPECT_EQ(figures({{p, p, close, {0, 0, 0}, {0, 0, 1}}, {0, 3, 4, 1, 4, 3, 2, 3, 4}}).welded,
              4U);
    // Minus zero is zero.
    const auto mesh =
        test::build({{{0, 0, 0}, {-0.0F, -0.0F, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 2, 3, 1, 3, 2}});
    EXPECT_EQ(mesh->report().welded_vertices, 3U);
    EXPECT_TRUE(mesh->report().closed());
    for (const glm::vec3& v : mesh->positions()) {
        for (int i = 0; i < 3; ++i) EXPECT_FALSE(v[i] == 0.0F && std::signbit(v[i]));
    }
}

TEST(ShadowMesh, WeldsOnlyVerticesOfOneIdentity) {
    // A box whose faces share no vertex.
    const Triangles box = test::box();
    std::vector<glm::vec3> corners;
    std::vector<std::uint32_t> in_order;
    for (const std::uint32_t index : box.indices) {
        in_order.push_back(static_cast<std::uint32_t>(corners.size()));
        corners.push_back(box.positions[index]);
    }
    const auto report = [&](const std::vector<std::uint32_t>& identities) {
        const auto mesh = ShadowMesh::build({.positions = std::as_bytes(std::span(corners)).data(),
                                             .vertex_count = corners.size(),
                                             .indices = in_order,
                                             .identities = identities});
        return mesh.has_value() ? (*mesh)->report() : MeshReport{};
    };
    EXPECT_EQ(report({}).welded_vertices, 8U);
    EXPECT_EQ(report(box.indices).welded_vertices, 8U);
    EXPECT_TRUE(report(box.indices).closed());
    // All alike says nothing that positions do not.
    EXPECT_EQ(report(std::vector<std::uint32_t>(corners.size(), 7)).welded_vertices, 8U);
    EXPECT_EQ(report(in_order).welded_vertices, 36U);
    EXPECT_EQ(report(in_order).boundary_edges, 36U);
    // One corner of one face moves by itself: its two edges are open on both sides.
    std::vector<std::uint32_t> torn = box.indices;
    torn[0] = 100;
    EXPECT_EQ(report(torn).welded_vertices, 9U);
    EXPECT_EQ(report(torn).boundary_edges, 4U);
    EXPECT_FALSE(report(torn).closed());
}

TEST(ShadowMesh, LeavesOutVerticesThatNoTriangleUses) {
    const auto mesh =
        test::build({{{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-9, 0, 0}}, {1, 2, 3}});
    EXPECT_EQ(mesh->report().vertices, 5U);
    EXPECT_EQ(mesh->positions().size(), 3U);
    EXPECT_EQ(mesh->bounds_max(), glm::vec3(1, 1, 0));
    EXPECT_EQ(mesh->bounds_min(), glm::vec3(0, 0, 0));
}

TEST(ShadowMesh, ComponentsKnowTheirSideAndBounds) {
    const auto mesh = test::build(
        test::merged(test::merged(test::box({5, 5, 5}, {6, 7, 8}),
                                  test::inside_out(test::box({-2, -2, -2}, {-1, -1, -1}))),
                     test::sheet(1)));
    const auto components = mesh->components();
    ASSERT_EQ(components.size(), 3U);
    EXPECT_TRUE(components[0].closed);
    EXPECT_FALSE(components[0].inside_out);
    EXPECT_EQ(components[0].bounds_min, glm::vec3(5, 5, 5));
    EXPECT_EQ(components[0].bounds_max, glm::vec3(6, 7, 8));
    EXPECT_EQ(components[0].faces, 12U);
    EXPECT_TRUE(components[1].closed);
    EXPECT_TRUE(components[1].inside_out);
    EXPECT_FALSE(components[2].closed);
    EXPECT_FALSE(components[2].inside_out);
    EXPECT_EQ(mesh->bounds_min(), glm::vec3(-2));
    EXPECT_EQ(mesh->bounds_max(), glm::vec3(6, 7, 8));
    // The sign of the volume survives a million metres.
    for (const float far : {1e3F, 1e6F}) {
        const auto away = test::build(test::moved(test::inside_out(test::box()), glm::vec3(far)));
        EXPECT_TRUE(away->components()[0].inside_out);
        EXPECT_FALSE(
            test::build(test::moved(test::box(), glm::vec3(far)))->components()[0].inside_out);
    }
}

TEST(ShadowMesh, AnEmptyMeshIsLegal) {
    const auto nothing = ShadowMesh::build({});
    ASSERT_TRUE(nothing.has_value());
    EXPECT_EQ((*nothing)->report().triangles, 0U);
    EXPECT_FALSE((*nothing)->report().closed());
    EXPECT_TRUE((*nothing)->edges().empty());
    EXPECT_EQ(figures({{{1, 2, 3}}, {}}), (Figures{0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
}

// ---------------------------------------------------------------------------------------------
// Invariants

TEST(ShadowMesh, EdgesComponentsAndPlanesAreRightForRandomMeshes) {
    GNOMON_RANDOM(random);
    for (int i = 0; i < 1'500; ++i) {
        const Triangles triangles = test::random_mesh(random);
        const auto mesh = test::build(triangles);
        const auto faces = mesh->faces();
        const auto p = mesh->positions();
        ASSERT_EQ(faces.size(), triangles.count());

        // Every face is there once and keeps its corners, and so is every position.
        std::set<std::array<float, 3>> distinct;
        std::set<std::uint32_t> inputs;
        for (std::size_t f = 0; f < faces.size(); ++f) {
            const std::size_t input = mesh->input_faces()[f];
            ASSERT_LT(input, faces.size());
            ASSERT_TRUE(inputs.insert(mesh->input_faces()[f]).second);
            for (std::size_t k = 0; k < 3; ++k) {
                ASSERT_EQ(p[faces[f][k]], triangles.positions[triangles.indices[3 * input + k]]);
            }
        }
        for (const glm::vec3& v : p) ASSERT_TRUE(distinct.insert({v.x, v.y, v.z}).second);

        // Edges and their uses, recounted.
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::map<std::uint32_t, int>> expected;
        std::uint64_t degenerate = 0;
        for (std::uint32_t f = 0; f < faces.size(); ++f) {
            const auto [a, b, c] = faces[f];
            degenerate += exactly_collinear(p[a], p[b], p[c]) ? 1 : 0;
            if (a == b || b == c || c == a) continue;
            for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
                expected[std::minmax(from, to)][f] += from < to ? 1 : -1;
            }
        }
        ASSERT_EQ(mesh->report().degenerate_faces, degenerate);
        ASSERT_EQ(mesh->edges().size(), expected.size());
        std::vector<bool> open(mesh->components().size(), false);
        for (const Edge& edge : mesh->edges()) {
            ASSERT_LT(edge.low, edge.high);
            const auto uses = mesh->uses().subspan(edge.first_use, edge.use_count);
            std::map<std::uint32_t, int> found;
            int sum = 0;
            for (const FaceUse& use : uses) {
                found[use.face] += use.sign();
                sum += use.sign();
                // Faces at one edge belong together.
                ASSERT_EQ(mesh->face_components()[use.face], mesh->face_components()[uses[0].face]);
            }
            ASSERT_EQ(found, (expected[{edge.low, edge.high}]));
            if (sum != 0) open[mesh->face_components()[uses[0].face]] = true;
        }
        for (std::size_t c = 0; c < open.size(); ++c)
            ASSERT_NE(mesh->components()[c].closed, open[c]);

        // Regular edges come first, and faces know their edges.
        for (std::size_t e = 0; e < mesh->edges().size(); ++e) {
            const auto uses = mesh->uses(mesh->edges()[e]);
            ASSERT_EQ(edge_kind(uses) == EdgeKind::Regular, e < mesh->regular_edges());
            if (e >= mesh->regular_edges()) continue;
            ASSERT_EQ(mesh->edges()[e].first_use, 2 * e);
            ASSERT_EQ(uses[0].sign(), 1);
            ASSERT_EQ(uses[1].sign(), -1);
        }
        for (std::size_t f = 0; f < faces.size(); ++f) {
            const auto& [a, b, c] = faces[f];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t e = mesh->face_edges()[f][k];
                if (a == b || b == c || c == a) {
                    ASSERT_EQ(e, ShadowMesh::no_edge);
                    continue;
                }
                const auto [low, high] = std::minmax(faces[f][k], faces[f][(k + 1) % 3]);
                ASSERT_EQ(mesh->edges()[e].low, low);
                ASSERT_EQ(mesh->edges()[e].high, high);
            }
        }

        // Planes: the bound on the error covers the error.
        const FacePlanes& planes = mesh->planes();
        for (std::size_t f = 0; f < faces.size(); ++f) {
            const glm::dvec3 normal(planes.normal_x[f], planes.normal_y[f], planes.normal_z[f]);
            for (const std::uint32_t corner : faces[f]) {
                // Every corner lies on the exact plane.
                const glm::dvec3 x = glm::dvec3(p[corner]) - glm::dvec3(planes.origin);
                const double s = glm::dot(normal, x) + static_cast<double>(planes.offset[f]);
                const double reach = std::abs(x.x) + std::abs(x.y) + std::abs(x.z);
                const auto radius = static_cast<double>(planes.radius);
                ASSERT_LE(reach, radius);
                ASSERT_LE(std::abs(s), static_cast<double>(planes.error[f]) * (reach + radius));
            }
        }
    }
}

// What was built at other places is the mesh as far as anything can tell but for its orders.
TEST(ShadowMesh, DeformedIsWhatWouldBeBuiltThere) {
    GNOMON_RANDOM(random);
    for (int i = 0; i < 500; ++i) {
        const Triangles rest = test::random_mesh(random);
        const auto mesh = test::build(rest);
        Triangles moved = rest;
        const glm::dmat3 turn = random.rotation();
        for (glm::vec3& p : moved.positions) {
            // Bends, and equal places stay equal.
            const glm::dvec3 q = turn * glm::dvec3(p);
            p = glm::vec3(q + 0.125 * q * glm::dvec3(q.y, q.z, q.x));
        }
        const auto deformed = mesh->deformed(moved.positions);
        ASSERT_TRUE(deformed);
        EXPECT_NE((*deformed)->id(), mesh->id());
        const ShadowMesh& there = **deformed;
        ASSERT_EQ(there.faces().data(), mesh->faces().data()) << "topology is shared";
        const auto built = test::build(moved);
        EXPECT_EQ(there.report().components, built->report().components);
        EXPECT_EQ(there.bounds_min(),
                  mesh->report().triangles > 0 ? built->bounds_min() : there.bounds_min());
        EXPECT_EQ(there.bounds_max(),
                  mesh->report().triangles > 0 ? built->bounds_max() : there.bounds_max());
        if (built->report().welded_vertices != mesh->report().welded_vertices) continue;
        EXPECT_EQ(there.report().degenerate_faces, built->report().degenerate_faces);
        std::map<std::uint32_t, std::uint32_t> place;
        for (std::uint32_t f = 0; f < built->faces().size(); ++f) {
            place[built->input_faces()[f]] = f;
        }
        for (std::uint32_t f = 0; f < there.faces().size(); ++f) {
            const std::uint32_t g = place[there.input_faces()[f]];
            ASSERT_EQ(there.is_degenerate(f), built->is_degenerate(g));
            ASSERT_EQ(there.planes().normal_x[f], built->planes().normal_x[g]);
            ASSERT_EQ(there.planes().offset[f], built->planes().offset[g]);
            ASSERT_EQ(there.planes().error[f], built->planes().error[g]);
        }
        for (std::size_t c = 0; c < there.components().size(); ++c) {
            ASSERT_EQ(there.components()[c].bounds_min, built->components()[c].bounds_min);
            ASSERT_EQ(there.components()[c].degenerate_faces,
                      built->components()[c].degenerate_faces);
        }
    }
}

TEST(ShadowMesh, DeformedRefusesOtherVertices) {
    const auto mesh = test::build(test::box());
    std::vector<glm::vec3> positions(mesh->report().vertices + 1, glm::vec3(0.0F));
    const auto more = mesh->deformed(positions);
    ASSERT_FALSE(more);
    EXPECT_EQ(more.error().code, ErrorCode::InvalidInput);
    EXPECT_EQ(more.error().message, "The deformed mesh has 9 vertices; the mesh was built from 8.");
    positions.resize(8);
    positions[5].y = std::numeric_limits<float>::infinity();
    const auto infinite = mesh->deformed(positions);
    ASSERT_FALSE(infinite);
    EXPECT_EQ(infinite.error().message, "Position 5 of the deformed mesh is not finite.");
}

// All that a mesh holds but its id and what queries search in.
void expect_same(const ShadowMesh& a, const ShadowMesh& b) {
    const auto same = [](const auto& x, const auto& y) {
        return x.size() == y.size() &&
               (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof x[0]) == 0);
    };
    EXPECT_TRUE(same(a.positions(), b.positions()));
    EXPECT_TRUE(same(a.faces(), b.faces()));
    EXPECT_TRUE(same(a.input_faces(), b.input_faces()));
    EXPECT_TRUE(same(a.edges(), b.edges()));
    EXPECT_TRUE(same(a.uses(), b.uses()));
    EXPECT_TRUE(same(a.face_edges(), b.face_edges()));
    EXPECT_TRUE(same(a.face_components(), b.face_components()));
    EXPECT_TRUE(same(a.degenerate_faces(), b.degenerate_faces()));
    EXPECT_TRUE(same(a.planes().normal_x, b.planes().normal_x));
    EXPECT_TRUE(same(a.planes().normal_y, b.planes().normal_y));
    EXPECT_TRUE(same(a.planes().normal_z, b.planes().normal_z));
    EXPECT_TRUE(same(a.planes().offset, b.planes().offset));
    EXPECT_TRUE(same(a.planes().error, b.planes().error));
    EXPECT_EQ(a.planes().origin, b.planes().origin);
    EXPECT_EQ(a.regular_edges(), b.regular_edges());
    EXPECT_EQ(a.bounds_min(), b.bounds_min());
    EXPECT_EQ(a.bounds_max(), b.bounds_max());
    EXPECT_EQ(a.memory_bytes(), b.memory_bytes());
    ASSERT_EQ(a.components().size(), b.components().size());
    for (std::size_t i = 0; i < a.components().size(); ++i) {
        EXPECT_EQ(a.components()[i].faces, b.components()[i].faces);
        EXPECT_EQ(a.components()[i].closed, b.components()[i].closed);
        EXPECT_EQ(a.components()[i].inside_out, b.components()[i].inside_out);
        EXPECT_EQ(a.components()[i].degenerate_faces, b.components()[i].degenerate_faces);
    }
    const internal::DetectionTables& ours = internal::tables_of(a);
    const internal::DetectionTables& theirs = internal::tables_of(b);
    EXPECT_TRUE(ours.faces == theirs.faces);
    EXPECT_TRUE(ours.edges == theirs.edges);
}

// Threads, and a runner that takes the tasks backwards: what they make is the same in every bit.
// Meshes of which all is cut into tasks, and small ones.
TEST(ShadowMesh, IsTheSameWhoeverRunsTheTasks) {
    GNOMON_RANDOM(random);
    std::size_t tasks = 0;
    const std::vector<Jobs> runners{
        thread_jobs(3), [&](std::size_t count, const std::function<void(std::size_t)>& task) {
            tasks += count;
            for (std::size_t i = count; i-- > 0;) task(i);
        }};
    std::vector<Triangles> meshes{
        merged(test::sphere(180, 230), merged(test::sheet(150), test::book(5))), {}};
    for (int i = 0; i < 50; ++i) meshes.push_back(test::random_mesh(random));
    for (const Triangles& triangles : meshes) {
        const MeshView view{
            .positions = reinterpret_cast<const std::byte*>(triangles.positions.data()),
            .vertex_count = triangles.positions.size(),
            .indices = triangles.indices};
        const auto alone = ShadowMesh::build(view);
        ASSERT_TRUE(alone.has_value());
        for (const Jobs& jobs : runners) {
            const auto shared = ShadowMesh::build(view, jobs);
            ASSERT_TRUE(shared.has_value());
            expect_same(**alone, **shared);
        }
    }
    EXPECT_GT(tasks, 20U);
}

TEST(ShadowMesh, EveryMeshHasAnIdOfItsOwn) {
    std::set<std::uint64_t> ids;
    for (int i = 0; i < 10; ++i) ids.insert(test::build(test::box())->id());
    EXPECT_EQ(ids.size(), 10U);
    EXPECT_FALSE(ids.contains(0));
}

TEST(ShadowMesh, ReadsStridedPositions) {
    struct Vertex {
        float u = 7, v = 8;
        glm::vec3 position{0.0F};
        std::uint8_t color[4] = {1, 2, 3, 4};
    };
    const Triangles box = test::box();
    std::vector<Vertex> vertices(box.positions.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i].position = box.positions[i];
    const auto mesh =
        ShadowMesh::build({.positions = reinterpret_cast<const std::byte*>(vertices.data()) +
                                        offsetof(Vertex, position),
                           .stride = sizeof(Vertex),
                           .vertex_count = vertices.size(),
                           .indices = box.indices});
    ASSERT_TRUE(mesh.has_value());
    EXPECT_TRUE((*mesh)->report().closed());
    EXPECT_EQ((*mesh)->bounds_max(), glm::vec3(1));
    // Unaligned bytes do as well.
    std::vector<std::byte> bytes(1 + box.positions.size() * 13);
    for (std::size_t i = 0; i < box.positions.size(); ++i) {
        std::memcpy(bytes.data() + 1 + 13 * i, &box.positions[i], sizeof(glm::vec3));
    }
    const auto packed = ShadowMesh::build({.positions = bytes.data() + 1,
                                           .stride = 13,
                                           .vertex_count = box.positions.size(),
                                           .indices = box.indices});
    ASSERT_TRUE(packed.has_value());
    EXPECT_TRUE((*packed)->report().closed());
}

// ---------------------------------------------------------------------------------------------
// Errors

std::string error_of(const MeshView& view) {
    const auto mesh = ShadowMesh::build(view);
    if (mesh) return "no error";
    EXPECT_EQ(mesh.error().code, ErrorCode::InvalidInput);
    return mesh.error().message;
}

TEST(ShadowMesh, NamesWhatIsWrong) {
    const std::vector<glm::vec3> good{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<std::uint32_t> triangle{0, 1, 2};
    const auto view = [](const std::vector<glm::vec3>& p, std::span<const std::uint32_t> i) {
        return MeshView{.positions = std::as_bytes(std::span(p)).data(),
                        .vertex_count = p.size(),
                        .indices = i};
    };
    EXPECT_EQ(error_of(view(good, triangle)), "no error");
    const std::vector<std::uint32_t> four{0, 1, 2, 0};
    EXPECT_EQ(error_of(view(good, four)), "The mesh has 4 indices, which is not a multiple of 3.");
    const std::vector<std::uint32_t> beyond{0, 1, 3};
    EXPECT_EQ(error_of(view(good, beyond)), "Index 2 of the mesh is 3, but it has 3 vertices.");
    const std::vector<std::uint32_t> huge{0, 4'294'967'295U, 2};
    EXPECT_EQ(error_of(view(good, huge)),
              "Index 1 of the mesh is 4294967295, but it has 3 vertices.");
    EXPECT_EQ(error_of(view({}, triangle)), "Index 0 of the mesh is 0, but it has 0 vertices.");
    EXPECT_EQ(error_of({.positions = nullptr, .vertex_count = 3, .indices = triangle}),
              "The mesh has 3 vertices but no positions.");
    MeshView few = view(good, triangle);
    few.identities = std::span(triangle).first(2);
    EXPECT_EQ(error_of(few),
              "The mesh has 2 identities, but must have none or one for each of its 3 vertices.");
    for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
        for (int axis = 0; axis < 3; ++axis) {
            auto positions = good;
            positions[1][axis] = bad;
            EXPECT_EQ(error_of(view(positions, triangle)), "Position 1 of the mesh is not finite.");
        }
    }
}

TEST(ShadowMesh, RefusesMoreThanItCanIndex) {
    const std::byte byte{};
    EXPECT_EQ(error_of({.positions = &byte, .vertex_count = (std::size_t{1} << 30U) + 1}),
              "The mesh has 1073741825 vertices and 0 triangles; the limits are 1073741824 and "
              "134217728.");
    // Never read: the count alone is too many.
    const std::uint32_t index = 0;
    EXPECT_EQ(error_of({.positions = &byte,
                        .vertex_count = 1,
                        .indices = {&index, 3 * ((std::size_t{1} << 27U) + 1)}}),
              "The mesh has 1 vertices and 134217729 triangles; the limits are 1073741824 and "
              "134217728.");
}

}  // namespace
}  // namespace gnomon::shadows
