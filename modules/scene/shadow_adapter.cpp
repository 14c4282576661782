// SPDX-License-Identifier: MIT
#include <gnomon/scene/shadow_adapter.hpp>

#include <algorithm>
#include <optional>

namespace gnomon::scene {

namespace {

bool fills_depth(const Scene& scene, Entity entity, const Mesh& mesh) {
    return scene.registry.has<Receiver>(entity) &&
           std::all_of(mesh.sub_meshes.begin(), mesh.sub_meshes.end(), [&](const SubMesh& sub) {
               return scene.materials[sub.material].alpha_mode != AlphaMode::Mask;
           });
}

}  // namespace

std::optional<shadows::Light> shadow_light(const Registry& registry, Entity entity) {
    const auto* transform = registry.try_get<WorldTransform>(entity);
    if (transform == nullptr) return std::nullopt;
    const glm::dmat4& world = transform->world_from_local;
    if (registry.has<DirectionalLight>(entity)) {
        return shadows::Light{.key = entity.key(),
                              .position_world = glm::dvec4(glm::dvec3(world[2]), 0.0)};
    }
    const glm::dvec4 position(glm::dvec3(world[3]), 1.0);
    if (const auto* point = registry.try_get<PointLight>(entity)) {
        return shadows::Light{
            .key = entity.key(), .position_world = position, .range_m = point->range_m};
    }
    if (const auto* spot = registry.try_get<SpotLight>(entity)) {
        return shadows::Light{
            .key = entity.key(), .position_world = position, .range_m = spot->range_m};
    }
    return std::nullopt;
}

Result<std::shared_ptr<const shadows::ShadowMesh>> ShadowAdapter::shadow_mesh(
    const std::shared_ptr<const Mesh>& mesh) {
    Known& known = known_[mesh.get()];
    if (known.shadow_mesh == nullptr || known.mesh.expired()) {
        auto built = shadows::ShadowMesh::build(
            {.positions = reinterpret_cast<const std::byte*>(mesh->positions.data()),
             .vertex_count = mesh->positions.size(),
             .indices = mesh->indices});
        if (!built) {
            known_.erase(mesh.get());
            return fail(built.error().code,
                        "Mesh \"" + mesh->name + "\": " + built.error().message);
        }
        known = {mesh, std::move(*built)};
    }
    return known.shadow_mesh;
}

Result<std::vector<shadows::Caster>> ShadowAdapter::casters(const Scene& scene, bool culled,
                                                            shadows::NearCaps near_caps) {
    std::vector<shadows::Caster> casters;
    Status status;
    scene.registry.each<Caster, MeshInstance, WorldTransform>([&](Entity entity, const Caster&,
                                                                  const MeshInstance& instance,
                                                                  const WorldTransform& transform) {
        auto mesh = shadow_mesh(instance.mesh);
        if (!mesh) {
            status = forward_error(mesh);
            return;
        }
        const bool drawn_whole = fills_depth(scene, entity, *instance.mesh);
        casters.push_back({.key = entity.key(),
                           .mesh = *mesh,
                           .world_from_local = world_from_mesh(transform, *instance.mesh),
                           .in_depth_buffer = !culled && drawn_whole,
                           .near_caps = drawn_whole ? near_caps : shadows::NearCaps::Facing});
    });
    if (!status) return forward_error(status);
    return casters;
}

Status ShadowAdapter::submit(const Scene& scene, shadows::ShadowSystem::Frame& frame, bool culled,
                             shadows::NearCaps near_caps) {
    const auto casters = this->casters(scene, culled, near_caps);
    if (!casters) return forward_error(casters);
    for (const shadows::Caster& caster : *casters) frame.caster(caster);
    const auto submit_light = [&](Entity entity, const auto&) {
        if (const auto light = shadow_light(scene.registry, entity)) frame.light(*light);
    };
    scene.registry.each<PointLight>(submit_light);
    scene.registry.each<SpotLight>(submit_light);
    scene.registry.each<DirectionalLight>(submit_light);
    return {};
}

}  // namespace gnomon::scene
