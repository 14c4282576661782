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
            instances.push_back({.positions = instance.mesh->positions,
                                 .indices = instance.mesh->indices,
                                 .world_from_local = scene::world_from_mesh(pose, *instance.mesh),
                                 .casts = casts,
                                 .receives = receives});
        });
    return instances;
}

}  // namespace gnomon::truth
