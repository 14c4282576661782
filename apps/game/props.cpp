// SPDX-License-Identifier: MIT
#include "props.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/scene/primitives.hpp>

namespace gnomon::game {

namespace {

glm::dmat4 moved_by(const glm::dvec3& offset) { return glm::translate(glm::dmat4(1.0), offset); }

/// A bar from one point to another, square, `thick_m` wide.
void add_bar(scene::Mesh& whole, const glm::dvec3& from, const glm::dvec3& to, double thick_m,
             std::uint32_t material) {
    const glm::dvec3 along = to - from;
    const double length = glm::length(along);
    const glm::dvec3 y = along / length;
    const glm::dvec3 hint =
        std::abs(y.y) > 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 x = glm::normalize(glm::cross(hint, y));
    const glm::dvec3 z = glm::cross(x, y);
    glm::dmat4 pose(1.0);
    pose[0] = glm::dvec4(x, 0.0);
    pose[1] = glm::dvec4(y, 0.0);
    pose[2] = glm::dvec4(z, 0.0);
    pose[3] = glm::dvec4((from + to) * 0.5, 1.0);
    add_part(whole, scene::make_box(glm::vec3(glm::dvec3(thick_m, length, thick_m)), material),
             pose);
}

}  // namespace

void add_part(scene::Mesh& whole, const scene::Mesh& part, const glm::dmat4& whole_from_part) {
    const auto first = static_cast<std::uint32_t>(whole.positions.size());
    const glm::dmat3 linear(whole_from_part);
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
        whole.positions.emplace_back(
            glm::dvec3(whole_from_part * glm::dvec4(glm::dvec3(part.positions[v]), 1.0)));
        whole.normals.emplace_back(glm::normalize(linear * glm::dvec3(part.normals[v])));
    }
    const auto begin = static_cast<std::uint32_t>(whole.indices.size());
    for (const std::uint32_t index : part.indices) whole.indices.push_back(first + index);
    const auto count = static_cast<std::uint32_t>(part.indices.size());
    if (whole.sub_meshes.empty()) {
        whole.sub_meshes.push_back({begin, count, part.sub_meshes.front().material});
    } else {
        whole.sub_meshes.back().index_count += count;
    }
}

scene::Mesh make_lattice(double height_m, double width_m, std::uint32_t material) {
    scene::Mesh mesh;
    mesh.name = "lattice";
    const double half = width_m * 0.5;
    const double post = std::max(width_m * 0.11, 0.05);
    const double rung = post * 0.7;
    const std::array<glm::dvec2, 4> corners{
        {{-half, -half}, {half, -half}, {half, half}, {-half, half}}};
    for (const glm::dvec2& corner : corners) {
        add_bar(mesh, {corner.x, 0.0, corner.y}, {corner.x, height_m, corner.y}, post, material);
    }
    const int bays = std::max(1, static_cast<int>(std::lround(height_m / (width_m * 1.25))));
    const double bay_m = height_m / bays;
    for (int bay = 0; bay < bays; ++bay) {
        const double low = bay * bay_m + 0.02;
        const double high = (bay + 1) * bay_m - 0.02;
        for (std::size_t side = 0; side < corners.size(); ++side) {
            const glm::dvec2 a = corners[side];
            const glm::dvec2 b = corners[(side + 1) % corners.size()];
            const bool mirrored = (bay + static_cast<int>(side)) % 2 != 0;
            const glm::dvec2 from = mirrored ? b : a;
            const glm::dvec2 to = mirrored ? a : b;
            add_bar(mesh, {from.x, low, from.y}, {to.x, high, to.y}, rung, material);
            add_bar(mesh, {a.x, high, a.y}, {b.x, high, b.y}, rung, material);
        }
    }
    return mesh;
}

scene::Mesh make_spoked_wheel(double radius_m, std::uint32_t spokes, std::uint32_t material) {
    scene::Mesh mesh;
    mesh.name = "wheel";
    const glm::dmat4 upright =
        glm::rotate(glm::dmat4(1.0), std::numbers::pi * 0.5, glm::dvec3(1.0, 0.0, 0.0));
    const double tube = radius_m * 0.045;
    for (const double side : {-0.22, 0.22}) {
        add_part(mesh,
                 scene::make_torus(static_cast<float>(radius_m), static_cast<float>(tube), 48, 8,
                                   material),
                 moved_by({0.0, 0.0, side}) * upright);
        for (std::uint32_t i = 0; i < spokes; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / spokes;
            const glm::dvec3 out(std::cos(angle), std::sin(angle), 0.0);
            const glm::dvec3 plane(0.0, 0.0, side);
            add_bar(mesh, out * (radius_m * 0.10) + plane, out * radius_m + plane, tube * 1.5,
                    material);
        }
    }
    // Paddles from rim to rim, as a mill has them.
    for (std::uint32_t i = 0; i < spokes; ++i) {
        const double angle = 2.0 * std::numbers::pi * (i + 0.5) / spokes;
        const glm::dmat4 pose = glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(0.0, 0.0, 1.0)) *
                                moved_by({radius_m * 0.97, 0.0, 0.0});
        add_part(mesh,
                 scene::make_box(glm::vec3(glm::dvec3(radius_m * 0.22, 0.06, 0.62)), material),
                 pose);
    }
    add_part(mesh, scene::make_cylinder(static_cast<float>(radius_m * 0.12), 0.7F, 20, material),
             upright);
    return mesh;
}

scene::Mesh make_crate(const glm::dvec3& size_m, std::uint32_t material) {
    scene::Mesh mesh;
    mesh.name = "crate";
    add_part(mesh, scene::make_box(glm::vec3(size_m * 0.94), material), glm::dmat4(1.0));
    const glm::dvec3 half = size_m * 0.5;
    const double thick = std::clamp(std::min({size_m.x, size_m.y, size_m.z}) * 0.09, 0.04, 0.12);
    const glm::dvec3 at = half - thick * 0.5;
    for (const double x : {-1.0, 1.0}) {
        for (const double z : {-1.0, 1.0}) {
            add_bar(mesh, {x * at.x, -half.y, z * at.z}, {x * at.x, half.y, z * at.z}, thick,
                    material);
            const glm::dvec3 low(x * at.x, z * (half.y - thick * 0.52), 0.0);
            add_bar(mesh, low - glm::dvec3(0.0, 0.0, at.z - thick * 0.5),
                    low + glm::dvec3(0.0, 0.0, at.z - thick * 0.5), thick * 0.96, material);
            const glm::dvec3 across(0.0, x * (half.y - thick * 0.52), z * at.z);
            add_bar(mesh, across - glm::dvec3(at.x - thick * 0.5, 0.0, 0.0),
                    across + glm::dvec3(at.x - thick * 0.5, 0.0, 0.0), thick * 0.96, material);
        }
    }
    return mesh;
}

}  // namespace gnomon::game
