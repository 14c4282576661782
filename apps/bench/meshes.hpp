// SPDX-License-Identifier: MIT
//
// The meshes that benchmarks run on: torus knots of a given number of triangles.
#pragma once

#include <cmath>
#include <memory>

#include <gnomon/scene/primitives.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>

namespace gnomon::bench {

/// About `triangles` triangles, closed.
inline std::shared_ptr<const shadows::ShadowMesh> torus_knot(std::int64_t triangles) {
    const auto tube = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 16.0));
    const scene::Mesh mesh = scene::make_torus_knot(1.0F, 0.3F, 2, 3, tube * 8, tube);
    return *shadows::ShadowMesh::build(
        {.positions = reinterpret_cast<const std::byte*>(mesh.positions.data()),
         .vertex_count = mesh.positions.size(),
         .indices = mesh.indices});
}

/// Lights on a sphere round the mesh, one after the other, far apart.
inline shadows::LightLocal light_at(std::int64_t step) {
    const double angle = 2.399963 * static_cast<double>(step);  // the golden angle
    const double height = std::cos(0.618034 * static_cast<double>(step));
    const double ring = 3.0 * std::sqrt(1.0 - height * height);
    return {glm::vec4(ring * std::cos(angle), 3.0 * height, ring * std::sin(angle), 1.0)};
}

}  // namespace gnomon::bench
