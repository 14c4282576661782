// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include <gmock/gmock.h>

#include <gnomon/scene/primitives.hpp>

namespace gnomon::scene {
namespace {

using Position = std::array<float, 3>;

Position key_of(const glm::vec3& p) {
    return {p.x + 0.0F, p.y + 0.0F, p.z + 0.0F};  // -0 is 0
}

/// For every directed edge between welded positions, how often it runs that way minus the other.
std::map<std::pair<Position, Position>, int> unbalanced_edges(const Mesh& mesh) {
    std::map<std::pair<Position, Position>, int> edges;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Position a = key_of(mesh.positions[mesh.indices[i + k]]);
            const Position b = key_of(mesh.positions[mesh.indices[i + (k + 1) % 3]]);
            if (a < b) {
                ++edges[{a, b}];
            } else {
                --edges[{b, a}];
            }
        }
    }
    std::erase_if(edges, [](const auto& edge) { return edge.second == 0; });
    return edges;
}

double signed_volume(const Mesh& mesh) {
    double sum = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = mesh.positions[mesh.indices[i]];
        const glm::dvec3 b = mesh.positions[mesh.indices[i + 1]];
        const glm::dvec3 c = mesh.positions[mesh.indices[i + 2]];
        sum += glm::dot(a, glm::cross(b, c));
    }
    return sum / 6.0;
}

void expect_sound(const Mesh& mesh) {
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_EQ(mesh.texcoords.size(), mesh.positions.size());
    ASSERT_EQ(mesh.sub_meshes.size(), 1U);
    EXPECT_EQ(mesh.sub_meshes[0].first_index, 0U);
    EXPECT_EQ(mesh.sub_meshes[0].index_count, mesh.indices.size());
    EXPECT_EQ(mesh.sub_meshes[0].material, 5U);
    for (const glm::vec3& normal : mesh.normals) EXPECT_NEAR(glm::length(normal), 1.0F, 1e-6F);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::array<std::uint32_t, 3> t{mesh.indices[i], mesh.indices[i + 1],
                                             mesh.indices[i + 2]};
        for (const std::uint32_t index : t) ASSERT_LT(index, mesh.positions.size());
        const glm::dvec3 a = mesh.positions[t[0]];
        const glm::dvec3 area =
            glm::cross(glm::dvec3(mesh.positions[t[1]]) - a, glm::dvec3(mesh.positions[t[2]]) - a);
        EXPECT_GT(glm::length(area), 0.0) << "triangle " << i / 3 << " has no area";
        const glm::dvec3 mean = glm::dvec3(mesh.normals[t[0]]) + glm::dvec3(mesh.normals[t[1]]) +
                                glm::dvec3(mesh.normals[t[2]]);
        EXPECT_GT(glm::dot(area, mean), 0.0) << "triangle " << i / 3 << " faces its normals' back";
    }
}

struct Solid {
    const char* name;
    std::function<Mesh()> make;
    double volume;     ///< of the smooth shape
    double tolerance;  ///< how much of it the facets cut off at most
};

class Solids : public testing::TestWithParam<Solid> {};

TEST_P(Solids, is_closed_outward_and_smooth) {
    const Mesh mesh = GetParam().make();
    expect_sound(mesh);
    EXPECT_TRUE(unbalanced_edges(mesh).empty());
    const double volume = signed_volume(mesh);
    EXPECT_GT(volume, 0.0);
    EXPECT_NEAR(volume, GetParam().volume, GetParam().tolerance * GetParam().volume);
}

constexpr double pi = std::numbers::pi;

INSTANTIATE_TEST_SUITE_P(
    All, Solids,
    testing::Values(
        Solid{"box",
              [] {
                  return make_box({1.0F, 2.0F, 3.0F}, 5);
              },
              6.0, 1e-9},
        Solid{"sphere", [] { return make_sphere(1.5F, 96, 48, 5); }, 4.0 / 3.0 * pi * 3.375, 0.01},
        Solid{"coarse_sphere", [] { return make_sphere(1.0F, 3, 2, 5); }, std::sqrt(3.0) / 2.0,
              1e-6},
        Solid{"torus", [] { return make_torus(1.0F, 0.3F, 96, 48, 5); }, 2.0 * pi* pi * 0.09, 0.01},
        Solid{"coarse_torus", [] { return make_torus(1.0F, 0.3F, 7, 5, 5); }, 1.35, 0.4},
        Solid{"cylinder", [] { return make_cylinder(0.5F, 2.0F, 96, 5); }, pi * 0.5, 0.01},
        Solid{"coarse_cylinder", [] { return make_cylinder(1.0F, 1.0F, 3, 5); },
              0.75 * std::sqrt(3.0), 1e-6},
        // Pappus: cross-section times the length of the curve, about 15.95 for this one.
        Solid{"knot", [] { return make_torus_knot(1.0F, 0.2F, 2, 3, 512, 48, 5); },
              pi * 0.04 * 15.95, 0.02}),
    [](const auto& param) { return param.param.name; });

TEST(Primitives, poles_and_seams_are_exact) {
    const Mesh sphere = make_sphere(0.7F, 17, 9);
    std::size_t poles = 0;
    for (const glm::vec3& p : sphere.positions) {
        if (std::abs(p.y) == 0.7F) {
            ++poles;
            EXPECT_EQ(p.x, 0.0F);
            EXPECT_EQ(p.z, 0.0F);
        }
    }
    EXPECT_EQ(poles, 2U * 17U);
    const Mesh torus = make_torus(1.0F, 0.25F, 13, 8);
    for (std::size_t j = 0; j <= 8; ++j) {
        EXPECT_EQ(torus.positions[j * 14], torus.positions[j * 14 + 13]);
    }
    for (std::size_t i = 0; i <= 13; ++i) {
        EXPECT_EQ(torus.positions[i], torus.positions[8 * 14 + i]);
    }
}

TEST(Primitives, plane_is_open_flat_and_faces_up) {
    const Mesh plane = make_plane(4.0F, 6.0F, 3, 5);
    expect_sound(plane);
    EXPECT_EQ(plane.triangle_count(), 18U);
    EXPECT_EQ(unbalanced_edges(plane).size(), 12U);  // its border
    for (const glm::vec3& normal : plane.normals) EXPECT_EQ(normal, glm::vec3(0.0F, 1.0F, 0.0F));
    EXPECT_EQ(plane.positions.front(), glm::vec3(-2.0F, 0.0F, -3.0F));
    EXPECT_EQ(plane.positions.back(), glm::vec3(2.0F, 0.0F, 3.0F));
}

}  // namespace
}  // namespace gnomon::scene
