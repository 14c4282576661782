// SPDX-License-Identifier: MIT
#include <gnomon/scene/scene.hpp>

#include <utility>

#include "internal/mesh_bounds.hpp"

namespace gnomon::scene {

Entity Scene::create_node(std::string name, const LocalTransform& local,
                          std::optional<Entity> parent) {
    const Entity entity = registry.create();
    registry.emplace<Name>(entity, std::move(name));
    registry.emplace<LocalTransform>(entity, local);
    glm::dmat4 world = local.parent_from_local();
    if (parent) {
        registry.emplace<Parent>(entity, *parent);
        if (const auto* above = registry.try_get<WorldTransform>(*parent)) {
            world = above->world_from_local * world;
        }
    }
    registry.emplace<WorldTransform>(entity, world);
    return entity;
}

Bounds world_bounds(const Scene& scene) {
    Bounds bounds;
    scene.registry.each<MeshInstance, WorldTransform>(
        [&bounds](Entity, const MeshInstance& instance, const WorldTransform& world) {
            if (instance.mesh) internal::include_mesh(bounds, world, *instance.mesh);
        });
    return bounds;
}

glm::dmat4 world_from_mesh(const WorldTransform& node, const Mesh& mesh) {
    glm::dmat4 result = node.world_from_local;
    result[3] = node.world_from_local * glm::dvec4(mesh.origin, 1.0);
    return result;
}

void internal::include_mesh(Bounds& bounds, const WorldTransform& world, const Mesh& mesh) {
    const glm::dmat4 matrix = world_from_mesh(world, mesh);
    for (const glm::vec3& position : mesh.positions) {
        bounds.include(glm::dvec3(matrix * glm::dvec4(position, 1.0)));
    }
}

}  // namespace gnomon::scene
