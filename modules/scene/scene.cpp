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
        [&](Entity entity, const MeshInstance& instance, const WorldTransform& world) {
            if (!instance.mesh) return;
            internal::include_positions(bounds,
                                        geometry_of(scene.registry, entity, instance, world));
        });
    return bounds;
}

Geometry geometry_of(const Registry& registry, Entity entity, const MeshInstance& instance,
                     const WorldTransform& world) {
    const Mesh& mesh = *instance.mesh;
    const auto* deformed = registry.try_get<Deformed>(entity);
    if (deformed != nullptr && deformed->mesh != instance.mesh) deformed = nullptr;
    Geometry geometry;
    geometry.positions = deformed == nullptr ? mesh.positions : deformed->positions;
    geometry.normals = deformed == nullptr ? mesh.normals : deformed->normals;
    geometry.revision = deformed == nullptr ? 0 : deformed->revision;
    geometry.world_from_positions = world.world_from_local;
    geometry.world_from_positions[3] =
        world.world_from_local *
        glm::dvec4(deformed == nullptr ? mesh.origin : deformed->origin, 1.0);
    return geometry;
}

void internal::include_positions(Bounds& bounds, const Geometry& geometry) {
    for (const glm::vec3& position : geometry.positions) {
        bounds.include(glm::dvec3(geometry.world_from_positions * glm::dvec4(position, 1.0)));
    }
}

}  // namespace gnomon::scene
