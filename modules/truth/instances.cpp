// SPDX-License-Identifier: MIT
#include <gnomon/scene/components.hpp>
#include <gnomon/truth/truth.hpp>

namespace gnomon::truth {

std::vector<Instance> instances_of(const scene::Scene& scene) {
    std::vector<Instance> instances;
    const scene::Registry& registry = scene.registry;
    registry.each<scene::MeshInstance, scene::WorldTransform>(
        [&](scene::Entity entity, const scene::MeshInstance& instance,
            const scene::WorldTransform& pose) {
            const bool casts = registry.has<scene::Caster>(entity);
            const bool receives = registry.has<scene::Receiver>(entity);
            if (instance.mesh == nullptr || (!casts && !receives)) return;
            const scene::Geometry geometry = scene::geometry_of(registry, entity, instance, pose);
            instances.push_back({.positions = geometry.positions,
                                 .indices = instance.mesh->indices,
                                 .world_from_local = geometry.world_from_positions,
                                 .casts = casts,
                                 .receives = receives});
        });
    return instances;
}

}  // namespace gnomon::truth
