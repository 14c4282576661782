// SPDX-License-Identifier: MIT
//
// Faces in one plane with the light, and casters side by side: where two decisions have to agree.
#include <array>
#include <cmath>
#include <limits>

#include <gnomon/scene/primitives.hpp>

#include "tests/hard_cases/hard_case.hpp"
#include "tests/hard_cases/hard_meshes.hpp"
#include "tests/rows/stage.hpp"

namespace gnomon::test {

namespace {

// Exact in single precision, and so is the light in the space of what is moved by it.
constexpr glm::dvec3 lift(0.0, 1.75, 0.0);

scene::Mesh exact_knot() {
    return snapped(scene::make_torus_knot(1.0F, 0.32F, 2, 3, 96, 16), 1.0F / 256.0F);
}

// A place in the plane of one of the mesh's faces, from number `first` on: exactly in it, since it
// is a corner plus whole multiples of two sides. High enough to light the scene.
glm::dvec3 place_in_a_face_plane(const scene::Mesh& mesh, std::size_t first) {
    for (std::size_t f = first;; ++f) {
        const std::uint32_t* face = &mesh.indices[3 * (f % mesh.triangle_count())];
        const glm::dvec3 a(mesh.positions[face[0]]);
        const glm::dvec3 u = glm::dvec3(mesh.positions[face[1]]) - a;
        const glm::dvec3 v = glm::dvec3(mesh.positions[face[2]]) - a;
        for (int i = -12; i <= 12; ++i) {
            for (int j = -12; j <= 12; ++j) {
                const glm::dvec3 place = a + double(i) * u + double(j) * v;
                const bool is_aside = std::abs(place.x) < 2.5 && std::abs(place.z) < 2.5;
                if (is_aside && place.y > 1.75 && place.y < 3.5) return place;
            }
        }
    }
}

Setting light_in_face_planes(int frame) {
    const scene::Mesh knot = exact_knot();
    Stage s;
    s.ground();
    s.lamp(lift + place_in_a_face_plane(knot, 331 * static_cast<std::size_t>(frame)));
    s.place(shared(knot), moved(lift));
    s.look({0.0, 3.4, 5.4}, {0.0, 0.9, 0.0});
    return s.finish();
}

// The lid's thousand needles lie in one plane with the light; the light goes round.
Setting needles_in_one_plane(int frame) {
    Stage s;
    s.ground();
    s.place(shared(scene::make_cylinder(1.0F, 2.0F, 1000)), moved({0.0, 1.25, 0.0}));
    constexpr std::array<glm::dvec2, 3> round{{{3.0, 1.0}, {-2.0, 2.0}, {2.5, -1.25}}};
    const glm::dvec2 at = round[static_cast<std::size_t>(frame)];
    s.lamp({at.x, 2.25, at.y});
    s.look({0.5, 4.6, 5.6}, {0.0, 0.6, 0.0});
    return s.finish();
}

// Exactly in the plane of a side's 128 triangles, in two such planes at once, and one step of
// single precision off to either side.
Setting light_in_the_plane_of_a_cubes_side(int frame) {
    constexpr std::array<glm::dvec3, 4> places{
        {{3.0, 2.75, 1.5}, {1.0, 2.75, 3.0}, {1.0, 4.5, 2.0}, {1.0, 4.5, 1.0}}};
    const glm::dvec3& place = places[static_cast<std::size_t>(frame / 3)];
    const auto step = static_cast<double>(std::numeric_limits<float>::epsilon()) * (frame % 3 - 1);
    Stage s;
    s.ground();
    s.place(shared(grid_cube(8)), moved(lift));
    s.lamp(place + glm::dvec3(step, step, 0.0));
    s.look({1.5, 4.4, 5.0}, {0.2, 0.7, 0.0});
    return s.finish();
}

// A roof of two sheets, each a mesh of its own.
Setting two_meshes_on_one_edge(int frame) {
    const glm::dmat4 pose = moved({0.1, 0.9, 0.3}) * turned(33, {0.2, 1.0, 0.1});
    Stage s;
    s.ground();
    s.place(shared(left_wing()), pose);
    s.place(shared(right_wing()), pose);
    const double angle = 1.1 * frame;
    s.lamp({2.2 * std::cos(angle), 4.1, 2.2 * std::sin(angle)});
    s.look({0.0, 3.4, 4.6}, {0.0, 0.5, 0.0});
    return s.finish();
}

// Two cubes face to face, the common square cut along different diagonals.
Setting two_cubes_face_to_face(int frame) {
    const MeshPointer cube = shared(grid_cube(1));
    Stage s;
    s.ground();
    s.place(cube, moved({-1.0, 1.5, 0.0}));
    s.place(cube, moved({1.0, 1.5, 0.0}) * scaled({-1.0, 1.0, 1.0}));
    constexpr std::array<glm::dvec3, 3> places{
        {{0.0, 5.0, 2.0}, {-3.0, 4.5, 2.5}, {0.0, 4.0, -3.0}}};
    s.lamp(places[static_cast<std::size_t>(frame)]);
    s.look({0.5, 4.4, 6.6}, {0.0, 0.6, 0.0});
    return s.finish();
}

Setting wall_of_a_thousand_bricks(int frame) {
    Stage s;
    s.ground();
    lay_bricks(s, 0.125, true);
    s.lamp(frame == 0 ? glm::dvec3(1.0, 4.5, -2.5) : glm::dvec3(0.5, 2.0, -6.0));
    s.look({-2.5, 5.5, 7.0}, {0.0, 0.8, 0.8});
    return s.finish();
}

}  // namespace

std::vector<HardCase> adjoining_cases() {
    std::vector<HardCase> cases;
    add_by_both(cases, {.name = "01_light_in_face_planes",
                        .story = "a facing bit that comes out differently for an edge and a cap",
                        .make = light_in_face_planes,
                        .frames = 6});
    cases.push_back({.name = "01_light_in_the_plane_of_1000_needles",
                     .story = "thin faces in whose plane the light lies flip by rounding",
                     .make = needles_in_one_plane,
                     .frames = 3});
    add_by_both(cases, {.name = "02_light_in_the_plane_of_a_cubes_side",
                        .story = "edges between coplanar faces, left out by an epsilon",
                        .make = light_in_the_plane_of_a_cubes_side,
                        .frames = 12});
    add_by_both(cases, {.name = "06_two_meshes_on_one_edge",
                        .story = "two casters split their common side quad differently",
                        .make = two_meshes_on_one_edge,
                        .frames = 6});
    add_by_both(cases, {.name = "06_two_cubes_face_to_face",
                        .story = "two casters split their common face differently",
                        .make = two_cubes_face_to_face,
                        .frames = 3});
    cases.push_back({.name = "34_wall_of_1000_bricks",
                     .story = "light leaks between casters that touch",
                     .make = wall_of_a_thousand_bricks,
                     .frames = 2});
    return cases;
}

}  // namespace gnomon::test
