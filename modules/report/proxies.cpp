// SPDX-License-Identifier: MIT
#include <span>
#include <vector>

#include <fmt/format.h>
#if GNOMON_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

#include "internal/volumes.hpp"

namespace gnomon::report::internal {

bool can_simplify() { return GNOMON_HAS_MESHOPTIMIZER != 0; }

#if GNOMON_HAS_MESHOPTIMIZER

namespace {

// Welded first: what is split along seams would be torn open along them.
std::vector<std::uint32_t> welded(std::span<const glm::vec3> positions,
                                  std::span<const std::uint32_t> indices) {
    std::vector<std::uint32_t> remap(positions.size());
    meshopt_generateVertexRemap(remap.data(), nullptr, positions.size(), positions.data(),
                                positions.size(), sizeof(glm::vec3));
    // One of the vertices of each place stands for all of them.
    std::vector<std::uint32_t> first(positions.size(), static_cast<std::uint32_t>(-1));
    std::vector<std::uint32_t> out(indices.size());
    for (std::size_t v = 0; v < positions.size(); ++v) {
        if (first[remap[v]] == static_cast<std::uint32_t>(-1)) {
            first[remap[v]] = static_cast<std::uint32_t>(v);
        }
    }
    for (std::size_t i = 0; i < indices.size(); ++i) out[i] = first[remap[indices[i]]];
    return out;
}

// Along normals weighted by the faces' areas; where these cancel out a vertex stays.
std::vector<glm::vec3> drawn_in(std::span<const glm::vec3> positions,
                                std::span<const std::uint32_t> indices, double by) {
    std::vector<glm::dvec3> normals(positions.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 a(positions[indices[i]]);
        const glm::dvec3 twice = glm::cross(glm::dvec3(positions[indices[i + 1]]) - a,
                                            glm::dvec3(positions[indices[i + 2]]) - a);
        for (std::size_t k = 0; k < 3; ++k) normals[indices[i + k]] += twice;
    }
    std::vector<glm::vec3> out(positions.begin(), positions.end());
    for (std::size_t v = 0; v < out.size(); ++v) {
        const double length = glm::length(normals[v]);
        if (length > 0.0) out[v] -= glm::vec3(normals[v] * (by / length));
    }
    return out;
}

}  // namespace

Result<std::vector<shadows::Caster>> simplified_casters(const scene::Scene& scene, double share,
                                                        bool inset) {
    std::vector<shadows::Caster> casters;
    Status status;
    const scene::Registry& registry = scene.registry;
    registry.each<scene::Caster, scene::MeshInstance, scene::WorldTransform>(
        [&](scene::Entity entity, const scene::Caster&, const scene::MeshInstance& instance,
            const scene::WorldTransform& world) {
            if (!status) return;
            const auto geometry = scene::geometry_of(registry, entity, instance, world);
            const std::vector<std::uint32_t> indices =
                welded(geometry.positions, instance.mesh->indices);
            const auto wanted =
                static_cast<std::size_t>(static_cast<double>(indices.size() / 3) * share) * 3;
            std::vector<std::uint32_t> fewer(indices.size());
            float error = 0.0F;  // of the mesh's extent
            fewer.resize(meshopt_simplify(fewer.data(), indices.data(), indices.size(),
                                          &geometry.positions[0].x, geometry.positions.size(),
                                          sizeof(glm::vec3), wanted, 1.0F, 0, &error));
            std::vector<glm::vec3> moved;
            if (inset) {
                const float extent = meshopt_simplifyScale(
                    &geometry.positions[0].x, geometry.positions.size(), sizeof(glm::vec3));
                moved = drawn_in(geometry.positions, fewer, double{error} * double{extent});
            }
            const std::span<const glm::vec3> positions =
                inset ? std::span<const glm::vec3>(moved) : geometry.positions;
            auto mesh = shadows::ShadowMesh::build(
                {.positions = reinterpret_cast<const std::byte*>(positions.data()),
                 .vertex_count = positions.size(),
                 .indices = fewer});
            if (!mesh) {
                status = forward_error(mesh);
                return;
            }
            casters.push_back({.key = entity.key(),
                               .mesh = std::move(*mesh),
                               .world_from_local = geometry.world_from_positions,
                               .in_depth_buffer = false});
        });
    if (!status) return forward_error(status);
    return casters;
}

#else

Result<std::vector<shadows::Caster>> simplified_casters(const scene::Scene&, double, bool) {
    return fail(ErrorCode::Unsupported,
                "This build cannot simplify casters: meshoptimizer was not found when it was made "
                "(package libmeshoptimizer-dev).");
}

#endif

}  // namespace gnomon::report::internal
