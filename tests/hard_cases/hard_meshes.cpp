// SPDX-License-Identifier: MIT
#include "tests/hard_cases/hard_meshes.hpp"

#include <cmath>
#include <utility>

#include <gnomon/scene/primitives.hpp>

namespace gnomon::test {

namespace {

scene::Mesh wing(float side, std::vector<std::uint32_t> indices) {
    return mesh_of(
        "wing",
        {{0.0F, 0.75F, -1.0F}, {0.0F, 0.75F, 1.0F}, {side, 0.0F, 1.25F}, {side, 0.0F, -1.0F}},
        std::move(indices));
}

}  // namespace

scene::Mesh mesh_of(std::string name, std::vector<glm::vec3> positions,
                    std::vector<std::uint32_t> indices) {
    scene::Mesh mesh;
    mesh.name = std::move(name);
    mesh.normals.assign(positions.size(), glm::vec3(0.0F));
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::vec3& a = positions[indices[i]];
        const glm::vec3& b = positions[indices[i + 1]];
        const glm::vec3& c = positions[indices[i + 2]];
        for (std::size_t k = 0; k < 3; ++k) mesh.normals[indices[i + k]] += cross(b - a, c - a);
    }
    for (glm::vec3& normal : mesh.normals) {
        const float length = glm::length(normal);
        normal = length > 0.0F ? normal / length : glm::vec3(0.0F, 1.0F, 0.0F);
    }
    mesh.positions = std::move(positions);
    mesh.indices = std::move(indices);
    mesh.sub_meshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
    return mesh;
}

scene::Mesh grid_cube(std::uint32_t cells) {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    const std::uint32_t row = cells + 1;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0F, 1.0F}) {
            const auto base = static_cast<std::uint32_t>(positions.size());
            for (std::uint32_t v = 0; v < row; ++v) {
                for (std::uint32_t u = 0; u < row; ++u) {
                    const glm::vec2 at = glm::vec2(static_cast<float>(u), static_cast<float>(v)) *
                                             (2.0F / static_cast<float>(cells)) -
                                         1.0F;
                    glm::vec3 p(side);
                    p[(axis + 1) % 3] = side > 0.0F ? at.x : at.y;  // u x v looks outwards
                    p[(axis + 2) % 3] = side > 0.0F ? at.y : at.x;
                    positions.push_back(p);
                }
            }
            for (std::uint32_t v = 0; v < cells; ++v) {
                for (std::uint32_t u = 0; u < cells; ++u) {
                    const std::uint32_t a = base + v * row + u;
                    for (const std::uint32_t i : {a, a + 1, a + row + 1, a, a + row + 1, a + row})
                        indices.push_back(i);
                }
            }
        }
    }
    return mesh_of("cube", std::move(positions), std::move(indices));
}

scene::Mesh welded_cube() {
    const scene::Mesh cube = grid_cube(1);
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        positions.emplace_back((corner & 1U) != 0 ? 1.0F : -1.0F, (corner & 2U) != 0 ? 1.0F : -1.0F,
                               (corner & 4U) != 0 ? 1.0F : -1.0F);
    }
    for (const std::uint32_t i : cube.indices) {
        const glm::vec3& p = cube.positions[i];
        indices.push_back((p.x > 0.0F ? 1U : 0U) + (p.y > 0.0F ? 2U : 0U) + (p.z > 0.0F ? 4U : 0U));
    }
    return mesh_of("cube", std::move(positions), std::move(indices));
}

scene::Mesh taken_apart(const scene::Mesh& mesh) {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (const std::uint32_t i : mesh.indices) {
        indices.push_back(static_cast<std::uint32_t>(positions.size()));
        positions.push_back(mesh.positions[i]);
    }
    return mesh_of(mesh.name + ", taken apart", std::move(positions), std::move(indices));
}

scene::Mesh snapped(scene::Mesh mesh, float step) {
    for (glm::vec3& p : mesh.positions) p = glm::round(p / step) * step;
    return mesh;
}

scene::Mesh with_faces(const scene::Mesh& mesh, const ChooseFaces& choose) {
    std::vector<std::uint32_t> indices;
    for (std::size_t f = 0; f < mesh.triangle_count(); ++f)
        choose(f, &mesh.indices[3 * f], indices);
    return mesh_of(mesh.name, mesh.positions, std::move(indices));
}

scene::Mesh open_cube() {
    const scene::Mesh cube = grid_cube(1);
    return with_faces(
        cube, [&](std::size_t, const std::uint32_t* c, std::vector<std::uint32_t>& out) {
            const auto on_top = [&](std::uint32_t i) { return cube.positions[i].y > 0.0F; };
            if (!(on_top(c[0]) && on_top(c[1]) && on_top(c[2]))) out.insert(out.end(), c, c + 3);
        });
}

scene::Mesh joined(const scene::Mesh& a, const scene::Mesh& b) {
    std::vector<glm::vec3> positions = a.positions;
    std::vector<std::uint32_t> indices = a.indices;
    const auto base = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), b.positions.begin(), b.positions.end());
    for (const std::uint32_t i : b.indices) indices.push_back(base + i);
    return mesh_of(a.name + " and " + b.name, std::move(positions), std::move(indices));
}

scene::Mesh left_wing() { return wing(-1.0F, {0, 1, 2, 0, 2, 3}); }
scene::Mesh right_wing() { return wing(1.0F, {2, 0, 3, 1, 0, 2}); }

void lay_bricks(Stage& stage, double shift_m, bool drawn) {
    const MeshPointer brick = shared(scene::make_box(glm::vec3(0.25F, 0.125F, 0.125F)));
    for (int row = 0; row < 25; ++row) {
        for (int column = 0; column < 40; ++column) {
            const double x = -5.0 + 0.25 * column + (row % 2 == 0 ? 0.0 : shift_m);
            stage.place(brick, moved({x, 0.0625 + 0.125 * row, 0.0}), true, drawn);
        }
    }
}

}  // namespace gnomon::test
