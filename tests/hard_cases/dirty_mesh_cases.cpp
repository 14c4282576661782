// SPDX-License-Identifier: MIT
//
// What exporters write: faces twice, faces without area, T-junctions, seams, the two zeros, and
// more vertices than 16 bits can number.
#include <gnomon/scene/primitives.hpp>

#include "tests/hard_cases/hard_case.hpp"
#include "tests/hard_cases/hard_meshes.hpp"
#include "tests/rows/stage.hpp"

namespace gnomon::test {

namespace {

using Faces = std::vector<std::uint32_t>;

// Every face twice, and every third one a third time, turned over.
scene::Mesh torus_of_repeated_faces() {
    return with_faces(scene::make_torus(1.0F, 0.4F, 40, 20),
                      [](std::size_t f, const std::uint32_t* c, Faces& out) {
                          out.insert(out.end(), c, c + 3);
                          out.insert(out.end(), c, c + 3);
                          if (f % 3 == 0) out.insert(out.end(), {c[0], c[2], c[1]});
                      });
}

// A grid's neighbouring vertices are exactly in line: a triangle of three of them has no area, but
// three edges. Others use a vertex twice, or one vertex alone.
scene::Mesh cube_with_faces_of_no_area() {
    constexpr std::uint32_t row = 5;
    scene::Mesh cube = grid_cube(row - 1);
    Faces indices = cube.indices;
    for (std::uint32_t side = 0; side < 6; ++side) {
        for (std::uint32_t v = 0; v < row; ++v) {
            const std::uint32_t a = (side * row + v) * row;
            for (const std::uint32_t i :
                 {a, a + 1, a + 2, a + 1, a + 4, a + 2, a, a, a + 1, a + 3, a + 3, a + 3})
                indices.push_back(i);
        }
    }
    return mesh_of("cube with faces of no area", std::move(cube.positions), std::move(indices));
}

// A cube whose sides are divided differently, so that vertices of one lie amid edges of another.
scene::Mesh cube_with_t_junctions() {
    const scene::Mesh coarse = grid_cube(1);
    const scene::Mesh fine = grid_cube(4);
    const auto is_on_x_side = [](const scene::Mesh& mesh, const std::uint32_t* c) {
        const float x = mesh.positions[c[0]].x;
        return x * x == 1.0F && mesh.positions[c[1]].x == x && mesh.positions[c[2]].x == x;
    };
    return joined(with_faces(coarse,
                             [&](std::size_t, const std::uint32_t* c, Faces& out) {
                                 if (is_on_x_side(coarse, c)) out.insert(out.end(), c, c + 3);
                             }),
                  with_faces(fine, [&](std::size_t, const std::uint32_t* c, Faces& out) {
                      if (!is_on_x_side(fine, c)) out.insert(out.end(), c, c + 3);
                  }));
}

Setting on_the_ground(scene::Mesh mesh, const glm::dmat4& pose) {
    Stage s;
    s.ground();
    s.place(shared(std::move(mesh)), pose);
    s.lamp({1.75, 4.5, 1.25});
    s.look({0.0, 3.2, 4.6}, {0.0, 0.6, 0.0});
    return s.finish();
}

}  // namespace

std::vector<HardCase> dirty_mesh_cases() {
    const glm::dmat4 tilted = moved({0.0, 1.5, 0.0}) * turned(50, {1.0, 0.0, 0.4});
    const glm::dmat4 small =
        moved({0.0, 1.25, 0.0}) * turned(20, {0.3, 1.0, 0.4}) * scaled(glm::dvec3(0.75));
    std::vector<HardCase> cases;
    const auto add = [&](const char* name, const char* story, std::function<scene::Mesh()> make,
                         const glm::dmat4& pose) {
        add_by_both(cases, {.name = name, .story = story, .make = [=](int) {
                                return on_the_ground(make(), pose);
                            }});
    };
    add("05_repeated_faces", "a face that is listed twice casts twice", torus_of_repeated_faces,
        tilted);
    add("05_faces_without_area", "a face without area faces nothing, but has edges",
        cube_with_faces_of_no_area, small);
    add("05_t_junctions", "a vertex amid its neighbour's edge", cube_with_t_junctions, small);
    add(
        "05_unwelded_seams", "no two triangles share a vertex",
        [] { return taken_apart(scene::make_torus(1.0F, 0.4F, 40, 20)); }, tilted);
    cases.push_back({.name = "18_more_vertices_than_16_bits_number",
                     .story = "indices of 16 bits, and tables for 65,536 edges",
                     .make = [tilted](int) {
                         return on_the_ground(scene::make_torus(1.0F, 0.4F, 300, 240), tilted);
                     }});
    return cases;
}

}  // namespace gnomon::test
