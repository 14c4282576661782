// SPDX-License-Identifier: MIT
//
// Meshes, lights and poses to attack the CPU core with: shapes with known topology, and random ones
// that are open, non-manifold, flipped, degenerate, coplanar by design, far away or of wild scale.
// It judges nothing; the tests do.
#pragma once

#include <cstdint>
#include <memory>
#include <ostream>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <glm/glm.hpp>

#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>

namespace gnomon::test {

/// GNOMON_SEED where it is set, else a fixed number: a plain run is the same every time.
[[nodiscard]] std::uint64_t run_seed();

/// Opens a random test: declares `random` and has failures name the seed that repeats them.
#define GNOMON_RANDOM(random)                                  \
    ::gnomon::test::Random random(::gnomon::test::run_seed()); \
    SCOPED_TRACE(::testing::Message() << "GNOMON_SEED=" << ::gnomon::test::run_seed())

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    int integer(int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(engine_);
    }
    std::uint32_t below(std::size_t count) {
        return static_cast<std::uint32_t>(integer(0, static_cast<int>(count) - 1));
    }
    std::uint32_t bits() { return static_cast<std::uint32_t>(engine_()); }
    bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
    glm::dvec3 in_cube(double half) {
        return {uniform(-half, half), uniform(-half, half), uniform(-half, half)};
    }
    glm::dvec3 unit_vector();
    /// A proper rotation.
    glm::dmat3 rotation();

private:
    std::mt19937_64 engine_;
};

struct Triangles {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    [[nodiscard]] std::size_t count() const { return indices.size() / 3; }
};

/// The mesh of valid triangles; a failed build ends the test program.
[[nodiscard]] std::shared_ptr<const shadows::ShadowMesh> build(const Triangles& triangles);

// Shapes. Closed ones are wound outwards.
[[nodiscard]] Triangles box(glm::vec3 low = glm::vec3(-1.0F), glm::vec3 high = glm::vec3(1.0F));
/// The same with four vertices a side, as exporters write it.
[[nodiscard]] Triangles box_with_seams();
[[nodiscard]] Triangles sphere(int rings, int segments, float radius = 1.0F);
[[nodiscard]] Triangles torus(int around, int along, float ring = 1.0F, float tube = 0.4F);
[[nodiscard]] Triangles tetrahedron(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d);
/// An L of two unit cubes' thickness, closed: (0,0,0) to (2,2,1), without its far corner.
[[nodiscard]] Triangles l_shape();
/// A flat open sheet of n x n quads in y = 0.
[[nodiscard]] Triangles sheet(int n);
/// Quads that share one edge.
[[nodiscard]] Triangles book(int pages);
[[nodiscard]] Triangles moebius(int quads);

// Changes.
[[nodiscard]] Triangles merged(Triangles a, const Triangles& b);
[[nodiscard]] Triangles moved(Triangles mesh, glm::vec3 offset);
[[nodiscard]] Triangles inside_out(Triangles mesh);
/// Every triangle with three vertices of its own.
[[nodiscard]] Triangles unindexed(const Triangles& mesh);
void remove_face(Triangles& mesh, std::size_t face);
void flip_face(Triangles& mesh, std::size_t face);
void repeat_face(Triangles& mesh, std::size_t face);

/// Any of all that, some 4 to 150 triangles within a few metres of the origin. About a third lies
/// on a small integer grid, where exact degeneracies are common.
[[nodiscard]] Triangles random_mesh(Random& random);
/// Triangles whose coordinates spread over sixty powers of two.
[[nodiscard]] Triangles wild_soup(Random& random, int count);

/// A light near the mesh, mostly where it hurts: on a vertex, an edge, a face, in a face's plane,
/// on the bounds, inside, or anywhere; a third are directional, many of them along an edge or an
/// axis.
[[nodiscard]] shadows::LightLocal random_light(Random& random, const shadows::ShadowMesh& mesh);

}  // namespace gnomon::test
