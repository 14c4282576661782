// SPDX-License-Identifier: MIT
//
// What a mesh may be: edges of one face, of three, of a thousand.
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <gnomon/scene/primitives.hpp>

#include "tests/hard_cases/hard_case.hpp"
#include "tests/hard_cases/hard_meshes.hpp"
#include "tests/rows/stage.hpp"

namespace gnomon::test {

namespace {

// `pages` squares on one spine, from the origin upwards.
scene::Mesh book_of(int pages) {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (int page = 0; page < pages; ++page) {
        const float angle = 0.2F + 5.6F * static_cast<float>(page) / static_cast<float>(pages);
        const glm::vec3 out(std::cos(angle), 0.0F, std::sin(angle));
        const glm::vec3 up(0.0F, 1.5F, 0.0F);
        const auto base = static_cast<std::uint32_t>(positions.size());
        for (const glm::vec3& corner : {glm::vec3(0.0F), out, out + up, up})
            positions.push_back(corner);
        for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) indices.push_back(base + i);
    }
    return mesh_of("book", std::move(positions), std::move(indices));
}

// `count` closed wedges round one spine: each has two faces on it.
scene::Mesh wedges_on_one_edge(int count) {
    std::vector<glm::vec3> positions{{0.0F, 0.0F, 0.0F}, {0.0F, 1.5F, 0.0F}};
    std::vector<std::uint32_t> indices;
    for (int wedge = 0; wedge < count; ++wedge) {
        const auto out = static_cast<std::uint32_t>(positions.size());
        for (const double share : {0.0, 0.6}) {
            const double angle = 2.0 * std::numbers::pi * (wedge + share) / count;
            positions.emplace_back(std::cos(angle), 0.75, -std::sin(angle));
        }
        for (const std::uint32_t i :
             {0U, out, 1U, 0U, 1U, out + 1, 0U, out + 1, out, 1U, out, out + 1})
            indices.push_back(i);
    }
    return mesh_of("wedges", std::move(positions), std::move(indices));
}

scene::Mesh moebius_strip(int segments) {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (int i = 0; i < segments; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / segments;
        for (const double across : {-0.5, 0.5}) {
            const double reach = 1.0 + across * std::cos(0.5 * turn);
            positions.emplace_back(reach * std::cos(turn), across * std::sin(0.5 * turn),
                                   reach * std::sin(turn));
        }
        const auto a = static_cast<std::uint32_t>(2 * i);
        const bool last = i + 1 == segments;  // after one turn left has become right
        const std::uint32_t b = last ? 1U : a + 2;
        const std::uint32_t c = last ? 0U : a + 3;
        for (const std::uint32_t index : {a, a + 1, c, a, c, b}) indices.push_back(index);
    }
    return mesh_of("moebius strip", std::move(positions), std::move(indices));
}

// Triangles between random vertices: edges of any number of faces, all of them crossing.
scene::Mesh soup_of(unsigned seed) {
    std::mt19937 random(seed);
    const auto number = [&] { return static_cast<float>(random() % 2049) / 1024.0F - 1.0F; };
    std::vector<glm::vec3> positions(16);
    for (glm::vec3& p : positions) p = {number(), number(), number()};
    std::vector<std::uint32_t> indices(std::size_t{3} * 40);
    for (std::uint32_t& i : indices) i = static_cast<std::uint32_t>(random() % positions.size());
    return mesh_of("soup", std::move(positions), std::move(indices));
}

scene::Mesh torus_with_faces_turned_over_at_random() {
    std::mt19937 random(5);
    return with_faces(scene::make_torus(1.0F, 0.4F, 40, 20),
                      [&](std::size_t, const std::uint32_t* c, std::vector<std::uint32_t>& out) {
                          if (random() % 2 == 0) {
                              out.insert(out.end(), {c[0], c[1], c[2]});
                          } else {
                              out.insert(out.end(), {c[0], c[2], c[1]});
                          }
                      });
}

scene::Mesh shifted(scene::Mesh mesh, const glm::vec3& by) {
    for (glm::vec3& p : mesh.positions) p += by;
    return mesh;
}

// Two cubes that share an edge (four faces) or, with `by` = (2, 2, 2), a vertex.
scene::Mesh two_cubes(const glm::vec3& by) {
    return joined(shifted(welded_cube(), -0.5F * by), shifted(welded_cube(), 0.5F * by));
}

// Seen from the front and above, one lamp outside of the caster's bounds and one within.
Setting on_the_ground(const scene::Mesh& mesh, const glm::dmat4& pose, const glm::dvec3& lamp) {
    Stage s;
    s.ground();
    s.place(shared(mesh), pose);
    s.lamp(lamp);
    s.look({0.0, 3.2, 4.6}, {0.0, 0.6, 0.0});
    return s.finish();
}

Setting book(int pages) {
    Stage s;
    s.ground();
    s.place(shared(book_of(pages)), moved({0.0, 0.3, 0.0}));
    s.lamp({2.3, 3.1, 1.6});
    s.look({0.0, 3.0, 4.0}, {0.0, 0.6, 0.0});
    return s.finish();
}

HardCase lit_from_outside_and_inside(const char* name, const char* story,
                                     std::function<scene::Mesh()> make, const glm::dmat4& pose,
                                     const glm::dvec3& inside) {
    return {.name = name,
            .story = story,
            .make =
                [=](int frame) {
                    return on_the_ground(make(), pose,
                                         frame == 0 ? glm::dvec3(1.7, 4.1, 1.3) : inside);
                },
            .frames = 2};
}

}  // namespace

std::vector<HardCase> topology_cases() {
    std::vector<HardCase> cases;
    for (const int pages : {3, 4, 5, 6, 7, 8, 9}) {
        cases.push_back({.name = "03_book_of_" + std::to_string(pages) + "_pages",
                         .story = "an edge of three faces and more breaks edge lists",
                         .make = [pages](int) { return book(pages); }});
    }
    const glm::dmat4 up = moved({0.0, 1.5, 0.0});
    add_by_both(cases, lit_from_outside_and_inside(
                           "03_open_box", "a boundary edge has no second face", open_cube,
                           moved({0.0, 0.75, 0.0}) * scaled(glm::dvec3(0.5)), {0.125, 1.0, 0.25}));
    add_by_both(
        cases, lit_from_outside_and_inside("03_moebius_strip", "no way of winding it is consistent",
                                           [] { return moebius_strip(48); },
                                           up * turned(70, {1.0, 0.0, 0.2}), {0.125, 1.75, 0.25}));
    add_by_both(cases, lit_from_outside_and_inside(
                           "03_inconsistent_winding", "two faces run along an edge the same way",
                           torus_with_faces_turned_over_at_random, up * turned(60, {1.0, 0.0, 0.2}),
                           {0.125, 1.5, 0.25}));
    for (const unsigned seed : {1U, 2U, 3U}) {
        const std::string name = "03_random_soup_" + std::to_string(seed);
        add_by_both(cases, lit_from_outside_and_inside(
                               name.c_str(), "triangles between random vertices",
                               [seed] { return soup_of(seed); }, up, {0.125, 1.5, 0.25}));
    }
    const glm::dmat4 half = up * scaled(glm::dvec3(0.5));
    cases.push_back(lit_from_outside_and_inside("03_two_cubes_on_one_edge",
                                                "four faces on an edge, and no face too many",
                                                [] {
                                                    return two_cubes({2.0F, 2.0F, 0.0F});
                                                },
                                                half, {-0.5, 1.75, 0.25}));
    cases.push_back(lit_from_outside_and_inside("03_two_cubes_on_one_vertex",
                                                "one vertex, two components",
                                                [] {
                                                    return two_cubes({2.0F, 2.0F, 2.0F});
                                                },
                                                half, {-0.5, 1.75, 0.25}));

    cases.push_back(
        {.name = "04_1000_closed_faces_on_one_edge",
         .story = "edge counts in a few bits overflow",
         .make = [](int) {
             return on_the_ground(wedges_on_one_edge(500), moved({0.0, 0.3, 0.0}), {1.7, 4.1, 1.3});
         }});
    // Half a turn is 225 of them: a ray through the spine crosses no more.
    cases.push_back({.name = "04_400_pages_on_one_edge",
                     .story = "edge counts in a few bits overflow",
                     .make = [](int) { return book(400); }});
    return cases;
}

}  // namespace gnomon::test
