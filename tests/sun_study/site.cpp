// SPDX-License-Identifier: MIT
#include "tests/sun_study/site.hpp"

#include <stdexcept>

#include <gnomon/scene/primitives.hpp>
#include <gnomon/sun_study/plan_scan.hpp>

namespace gnomon::sun_study::test {

namespace {

void add_quad(scene::Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
              std::uint32_t d) {
    for (const std::uint32_t i : {a, b, c, a, c, d}) mesh.indices.push_back(i);
}

}  // namespace

shadows::Caster caster_of(std::uint64_t key, const scene::Mesh& mesh, const glm::dvec3& at_plan) {
    auto built =
        shadows::ShadowMesh::build({.positions = std::as_bytes(std::span(mesh.positions)).data(),
                                    .vertex_count = mesh.positions.size(),
                                    .indices = mesh.indices});
    if (!built) throw std::runtime_error(built.error().message);
    shadows::Caster caster{.key = key, .mesh = std::move(*built)};
    caster.world_from_local[3] = glm::dvec4(world_from_plan(at_plan), 1.0);
    return caster;
}

scene::Mesh house(double width_m, double depth_m, double eaves_m, double ridge_m) {
    const auto x = static_cast<float>(width_m / 2.0);
    const auto z = static_cast<float>(depth_m / 2.0);
    const auto eaves = static_cast<float>(eaves_m);
    const auto ridge = static_cast<float>(ridge_m);
    scene::Mesh mesh;
    mesh.positions = {{-x, 0, -z},     {x, 0, -z},     {x, 0, z},     {-x, 0, z},
                      {-x, eaves, -z}, {x, eaves, -z}, {x, eaves, z}, {-x, eaves, z},
                      {-x, ridge, 0},  {x, ridge, 0}};
    add_quad(mesh, 0, 1, 2, 3);  // floor, from below
    add_quad(mesh, 3, 2, 6, 7);
    add_quad(mesh, 1, 0, 4, 5);
    add_quad(mesh, 2, 1, 5, 6);
    add_quad(mesh, 0, 3, 7, 4);
    add_quad(mesh, 7, 6, 9, 8);
    add_quad(mesh, 5, 4, 8, 9);
    for (const std::uint32_t i : {6U, 5U, 9U, 4U, 7U, 8U}) mesh.indices.push_back(i);
    return mesh;
}

scene::Mesh fence(double length_m, double height_m, std::uint32_t cells) {
    scene::Mesh mesh;
    for (std::uint32_t j = 0; j <= cells; ++j) {
        for (std::uint32_t i = 0; i <= cells; ++i) {
            mesh.positions.emplace_back(static_cast<float>(length_m * (i / double(cells) - 0.5)),
                                        static_cast<float>(height_m * j / double(cells)), 0.0F);
        }
    }
    const std::uint32_t across = cells + 1;
    for (std::uint32_t j = 0; j < cells; ++j) {
        for (std::uint32_t i = 0; i < cells; ++i) {
            if ((i + 2 * j) % 5 == 0) continue;  // a hole
            const std::uint32_t a = j * across + i;
            add_quad(mesh, a, a + 1, a + 1 + across, a + across);
        }
    }
    return mesh;
}

std::vector<shadows::Caster> site(const glm::dvec3& shift) {
    return {caster_of(1, house(9.0, 7.0, 5.0, 8.7), shift + glm::dvec3(0.3, 0.4, 0.0)),
            caster_of(2, scene::make_plane(4.0F, 3.0F), shift + glm::dvec3(-1.2, -4.6, 2.7)),
            caster_of(3, fence(12.0, 1.8, 9), shift + glm::dvec3(2.1, -9.3, 0.0)),
            caster_of(4, scene::make_torus(2.0F, 0.4F, 24, 12), shift + glm::dvec3(-9.0, 3.0, 4.1)),
            caster_of(5, scene::make_cylinder(0.15F, 7.0F, 8), shift + glm::dvec3(9.7, 5.2, 3.5))};
}

std::vector<bool> cells_off_edges(std::span<const shadows::Caster> casters, const PlanGrid& grid,
                                  const glm::dvec3& sun) {
    std::vector<int> lit(grid.cell_count());
    for (const int x : {-1, 0, 1}) {
        for (const int y : {-1, 0, 1}) {
            PlanGrid moved = grid;
            moved.min_m += glm::dvec2(x, y) * (grid.cell_m / 16.0);
            const std::vector<PlanMask> masks = PlanScan(casters, moved).lit(std::span(&sun, 1));
            for (std::size_t i = 0; i < lit.size(); ++i) lit[i] += masks.front()[i];
        }
    }
    std::vector<bool> off(lit.size());
    for (std::size_t i = 0; i < lit.size(); ++i) off[i] = lit[i] % 9 == 0;
    return off;
}

PlanGrid site_grid(const glm::dvec3& shift) {
    const auto grid =
        make_grid(glm::dvec2(shift) + glm::dvec2(-16.0, -13.0),
                  glm::dvec2(shift) + glm::dvec2(16.0, 13.0), 0.25, shift.z + 0.05, 4096);
    if (!grid) throw std::runtime_error(grid.error().message);
    return *grid;
}

}  // namespace gnomon::sun_study::test
