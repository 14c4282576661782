// SPDX-License-Identifier: MIT
//
// Which parts of meshes are convex, and what certainly lies in their shadow: held against single
// rays to the light.
#include "internal/umbra.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include <gnomon/shadows/technique.hpp>

#include "internal/convex_parts.hpp"
#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows::internal {
namespace {

using test::Random;

// Whole components.
std::size_t parts_of(const test::Triangles& triangles) {
    const auto mesh = test::build(triangles);
    return static_cast<std::size_t>(std::ranges::count_if(convex_parts(*mesh), &ConvexPart::whole));
}

test::Triangles tetrahedron() {
    return test::tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
}

TEST(ConvexParts, AreClosedAndConvex) {
    EXPECT_EQ(parts_of(test::box()), 1U);
    EXPECT_EQ(parts_of(test::box_with_seams()), 1U);
    EXPECT_EQ(parts_of(tetrahedron()), 1U);
    EXPECT_EQ(parts_of(test::sphere(10, 12)), 1U);
    EXPECT_EQ(parts_of(test::box({-5, -5, -1e-3}, {5, 5, 1e-3})), 1U) << "thin";
    EXPECT_EQ(parts_of(test::torus(8, 8)), 0U);
    EXPECT_EQ(parts_of(test::l_shape()), 0U);
    EXPECT_EQ(test::build(test::l_shape())->report().closed(), true);
    EXPECT_EQ(parts_of(test::sheet(2)), 0U);
    EXPECT_EQ(parts_of(test::moebius(9)), 0U);
    EXPECT_EQ(parts_of({}), 0U);
    EXPECT_EQ(parts_of(test::sphere(40, 40)), 0U) << "of more faces than are looked at";
}

TEST(ConvexParts, MayBeInsideOutButNotOpenNorTorn) {
    EXPECT_EQ(parts_of(test::inside_out(test::box())), 1U);
    test::Triangles open = test::box();
    test::remove_face(open, 3);
    EXPECT_EQ(parts_of(open), 0U);
    test::Triangles flipped = test::box();
    test::flip_face(flipped, 3);
    EXPECT_EQ(parts_of(flipped), 0U);
    test::Triangles repeated = test::box();
    test::repeat_face(repeated, 3);
    EXPECT_EQ(parts_of(repeated), 0U);
}

TEST(ConvexParts, DoNotMindVerticesThatAreThereTwice) {
    test::Triangles mesh = test::box();
    mesh.positions.push_back(mesh.positions[7]);
    for (std::uint32_t& index : mesh.indices) {
        if (index == 7) {
            index = 8;
            break;
        }
    }
    mesh.indices.insert(mesh.indices.end(), {7, 8, 6});  // without area: two corners are one
    ASSERT_EQ(parts_of(mesh), 1U);
    EXPECT_EQ(convex_parts(*test::build(mesh))[0].faces.size(), 12U);
}

TEST(ConvexParts, AreTheLargestOfAMesh) {
    test::Triangles mesh = test::torus(8, 8, 0.2F, 0.05F);
    for (int i = 1; i <= 6; ++i) {
        mesh = test::merged(mesh, test::moved(test::box(glm::vec3(-0.1F * static_cast<float>(i)),
                                                        glm::vec3(0.1F * static_cast<float>(i))),
                                              {3.0F * static_cast<float>(i), 0, 0}));
    }
    const auto built = test::build(mesh);
    const auto& parts = convex_parts(*built);
    ASSERT_EQ(parts.size(), most_convex_parts);
    EXPECT_NEAR(parts[0].area, 6 * 1.2 * 1.2, 1e-5);
    EXPECT_NEAR(parts[3].center.x, 9.0, 1e-5);
    const auto moved = built->deformed(mesh.positions);
    ASSERT_TRUE(moved.has_value());
    EXPECT_TRUE(convex_parts(**moved).empty());
}

TEST(ConvexParts, GrowFromFacesOfOtherComponents) {
    const auto sheet = convex_parts(*test::build(test::sheet(1)));
    ASSERT_EQ(sheet.size(), 1U);
    EXPECT_EQ(sheet[0].faces.size(), 2U);
    EXPECT_TRUE(sheet[0].two_sided);
    test::Triangles open = test::box();
    test::remove_face(open, 3);
    ASSERT_GE(convex_parts(*test::build(open)).size(), 1U);
    EXPECT_EQ(convex_parts(*test::build(open))[0].faces.size(), 11U);
    // Every face of a part has all of it behind or in its plane.
    for (const auto& triangles : {test::l_shape(), test::inside_out(test::l_shape()), open,
                                  test::torus(8, 8), test::sheet(3), test::book(5)}) {
        const auto mesh = test::build(triangles);
        EXPECT_FALSE(convex_parts(*mesh).empty());
        for (const ConvexPart& part : convex_parts(*mesh)) {
            EXPECT_FALSE(part.whole);
            for (const auto& face : part.faces) {
                const glm::vec3& a = part.vertices[face[0]];
                const glm::vec3 normal = glm::normalize(
                    glm::cross(part.vertices[face[1]] - a, part.vertices[face[2]] - a));
                for (const glm::vec3& v : part.vertices) {
                    EXPECT_LT(glm::dot(v - a, normal) * (part.inside_out ? -1.0F : 1.0F), 1e-4F);
                }
            }
        }
    }
    EXPECT_TRUE(convex_parts(*test::build(test::inside_out(test::l_shape())))[0].inside_out);
}

glm::dmat4 posed(const glm::dmat3& linear, const glm::dvec3& at) {
    glm::dmat4 pose(linear);
    pose[3] = glm::dvec4(at, 1.0);
    return pose;
}

// Whether a face lies between the point and the light, for certain: not within 1e-9 of its border.
bool is_behind(const ShadowMesh& mesh, const glm::dmat4& pose, const glm::dvec4& light,
               const glm::dvec3& point) {
    const glm::dvec3 way = glm::dvec3(light) - light.w * point;
    for (const auto& face : mesh.faces()) {
        std::array<glm::dvec3, 3> p;
        for (std::size_t i = 0; i < 3; ++i) {
            p[i] =
                glm::dvec3(pose * glm::dvec4(glm::dvec3(mesh.positions()[face[i]]), 1.0)) - point;
        }
        const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double t = glm::dot(normal, p[0]) / glm::dot(normal, way);
        if (!(t > 0.0) || (light.w != 0.0 && !(t < 1.0))) continue;
        const std::array<double, 3> sides{glm::dot(glm::cross(p[0], p[1]), way),
                                          glm::dot(glm::cross(p[1], p[2]), way),
                                          glm::dot(glm::cross(p[2], p[0]), way)};
        // A corner or edge shared by faces that are crossed alike is crossed for certain as well.
        if ((sides[0] >= 0 && sides[1] >= 0 && sides[2] >= 0) ||
            (sides[0] <= 0 && sides[1] <= 0 && sides[2] <= 0)) {
            return true;
        }
    }
    return false;
}

struct Held {
    const ShadowMesh& mesh;
    glm::dmat4 pose;
    glm::dvec4 light;
    Umbra umbra;

    Held(const ShadowMesh& of, const glm::dmat4& at, const glm::dvec4& from, double follow = 100.0,
         std::size_t part = 0)
        : mesh(of), pose(at), light(from) {
        umbra.make(convex_parts(mesh).at(part), make_pose(pose), light, follow);
    }
    bool operator()(const glm::dmat4& box_pose, const glm::dvec3& low,
                    const glm::dvec3& high) const {
        return umbra.holds(umbra_box(make_pose(box_pose), low, high, light));
    }
};

std::optional<glm::dvec3> corner_in_light(const Held& held, const glm::dmat4& box_pose,
                                          const glm::dvec3& low, const glm::dvec3& high) {
    for (const glm::dvec3& corner : corners_of({box_pose, low, high})) {
        if (!is_behind(held.mesh, held.pose, held.light, corner)) return corner;
    }
    return std::nullopt;
}

TEST(Umbra, HoldsNothingThatARayReaches) {
    GNOMON_RANDOM(random);
    const std::array meshes{test::build(test::box()),
                            test::build(tetrahedron()),
                            test::build(test::sphere(6, 8)),
                            test::build(test::sphere(10, 12)),
                            test::build(test::inside_out(test::box())),
                            test::build(test::l_shape()),
                            test::build(test::torus(8, 8)),
                            test::build(test::sheet(2)),
                            test::build(test::book(5)),
                            test::build(test::inside_out(test::l_shape()))};
    std::array<std::uint64_t, meshes.size()> held_boxes{};
    std::uint64_t missed = 0;
    for (int run = 0; run < 60'000; ++run) {
        SCOPED_TRACE(run);
        const double size = std::pow(10.0, random.uniform(-2.0, 3.0));
        glm::dmat3 linear = random.rotation() * size;
        for (int i = 0; i < 3; ++i) linear[i] *= std::pow(10.0, random.uniform(-1.5, 0.5));
        if (random.chance(0.3)) linear = random.rotation() * linear;  // sheared
        if (random.chance(0.3)) linear[0] *= -1.0;
        const glm::dvec3 at = random.in_cube(random.chance(0.2) ? 1e6 : 5.0 * size);
        const bool sun = random.chance(0.4);
        const glm::dvec4 light =
            sun ? glm::dvec4(random.chance(0.3) ? glm::dvec3(0, 1, 0) : random.unit_vector(), 0.0)
                : glm::dvec4(at + random.in_cube(6.0 * size), 1.0);
        const std::uint32_t which = random.below(meshes.size());
        const ShadowMesh& mesh = *meshes[which];
        const Held held(mesh, posed(linear, at), light, 10 * size,
                        random.below(convex_parts(mesh).size()));
        // Behind it, mostly.
        const glm::dvec3 inside =
            glm::dvec3(held.pose * glm::dvec4(random.in_cube(0.4) + 0.25, 1.0));
        const glm::dvec3 away = sun ? -size * glm::dvec3(light) : inside - glm::dvec3(light);
        const glm::dvec3 place = inside + random.uniform(-0.2, 3.0) * away;
        const glm::dvec3 half = size * std::pow(10.0, random.uniform(-3.0, 0.0)) *
                                glm::dvec3(random.uniform(0.05, 1.0), random.uniform(0.05, 1.0),
                                           random.uniform(0.05, 1.0));
        const glm::dmat4 box_pose = posed(random.rotation(), place);
        if (held(box_pose, -half, half)) {
            ++held_boxes[which];
            ASSERT_FALSE(corner_in_light(held, box_pose, -half, half));
            for (int i = 0; i < 4; ++i) {
                const glm::dvec3 p(random.uniform(-1, 1), random.uniform(-1, 1),
                                   random.uniform(-1, 1));
                ASSERT_TRUE(is_behind(held.mesh, held.pose, light,
                                      glm::dvec3(box_pose * glm::dvec4(half * p, 1.0))));
            }
        } else if (!held.umbra.empty() && !corner_in_light(held, box_pose, -half, half)) {
            // All within, but for the margin? Not if a box larger by that is.
            const glm::dvec3 more = half + 0.02 * size;
            const bool is_within = !corner_in_light(held, box_pose, -more, more);
            // Behind many faces the last one's distance counts: inside a sphere nothing is held.
            const ConvexPart& part = convex_parts(mesh)[0];
            missed += is_within && part.whole && part.faces.size() <= 12 ? 1 : 0;
        }
    }
    for (const std::uint64_t boxes : held_boxes) EXPECT_GT(boxes, 50U);
    EXPECT_EQ(missed, 0U);
}

TEST(Umbra, DoesNotHoldWhatTouchesItsBorder) {
    const auto wall = test::build(test::box());
    const glm::dmat4 here(1.0);
    const Held sun(*wall, here, {0, 3, 0, 0});
    const glm::dmat4 below = posed(glm::dmat3(1.0), {0, -4, 0});
    EXPECT_FALSE(sun(below, glm::dvec3(-1), glm::dvec3(1))) << "corners exactly on it";
    EXPECT_TRUE(sun(below, glm::dvec3(-0.999), glm::dvec3(0.999)));
    EXPECT_FALSE(sun(below, glm::dvec3(-0.99999), glm::dvec3(0.99999))) << "within the margin";
    EXPECT_FALSE(sun(posed(glm::dmat3(1.0), {0, 4, 0}), glm::dvec3(-0.5), glm::dvec3(0.5)))
        << "before it";
    EXPECT_FALSE(sun(here, glm::dvec3(-1), glm::dvec3(1))) << "itself";
    EXPECT_TRUE(sun(here, glm::dvec3(-0.9), glm::dvec3(0.9))) << "in its inside";
    EXPECT_FALSE(sun(here, glm::dvec3(-0.9), glm::dvec3(0.9, 1.0, 0.9))) << "through its lit face";
    const Held lamp(*wall, here, {0, 3, 0, 1});
    EXPECT_TRUE(lamp(below, glm::dvec3(-1), glm::dvec3(1)));
    // The cone's sides rise by the light's distance to the near face, which is 2, for 1.
    EXPECT_FALSE(lamp(below, glm::dvec3(-3, -1, -3), glm::dvec3(3, 1, 3)));
    EXPECT_TRUE(lamp(below, glm::dvec3(-2.9, -1, -2.9), glm::dvec3(2.9, 1, 2.9)));
}

TEST(Umbra, HoldsNothingWhereTheLightIsNear) {
    const auto wall = test::build(test::box());
    const glm::dmat4 below = posed(glm::dmat3(1.0), {0, -4, 0});
    for (const glm::dvec4& light :
         {glm::dvec4(0, 0, 0, 1), glm::dvec4(0, 1, 0, 1), glm::dvec4(0, 1.001, 0, 1),
          glm::dvec4(0.2, 0.9, 0, 1), glm::dvec4(0, 0, 0, 0), glm::dvec4(0, std::nan(""), 0, 1),
          glm::dvec4(0, INFINITY, 0, 1)}) {
        EXPECT_TRUE(Held(*wall, glm::dmat4(1.0), light).umbra.empty()) << light.y;
    }
    EXPECT_FALSE(Held(*wall, glm::dmat4(1.0), {0, 1.1, 0, 1}).umbra.empty());
    // What cannot be placed lies nowhere.
    const Held sun(*wall, glm::dmat4(1.0), {0, 3, 0, 0});
    EXPECT_FALSE(
        sun(posed(glm::dmat3(1.0), {std::nan(""), -4, 0}), glm::dvec3(-0.1), glm::dvec3(0.1)));
    EXPECT_TRUE(sun(below, glm::dvec3(-0.1), glm::dvec3(0.1)));
}

}  // namespace
}  // namespace gnomon::shadows::internal
