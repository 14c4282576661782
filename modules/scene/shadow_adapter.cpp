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

Result<std::shared_ptr<const shadows::ShadowMesh>> build(const Mesh& mesh) {
    shadows::MeshView view{.positions = std::as_bytes(std::span(mesh.positions)).data(),
                           .vertex_count = mesh.positions.size(),
                           .indices = mesh.indices};
    // What may move apart is not welded, in no pose: the topology is the same in all of them.
    if (mesh.deformation) view.identities = mesh.deformation->identities;
    auto built = shadows::ShadowMesh::build(view);
    if (!built) {
        return fail(built.error().code, "Mesh \"" + mesh.name + "\": " + built.error().message);
    }
    return built;
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
        auto built = build(*mesh);
        if (!built) {
            known_.erase(mesh.get());
            return forward_error(built);
        }
        known = {mesh, std::move(*built)};
    }
    return known.shadow_mesh;
}

Result<std::shared_ptr<const shadows::ShadowMesh>> ShadowAdapter::deformed_mesh(
    Entity entity, const std::shared_ptr<const Mesh>& mesh, const Geometry& geometry) {
    KnownDeformed& known = deformed_[entity.key()];
    known.used = true;
    if (known.revision != geometry.revision || known.mesh != mesh) {
        // The topology is that of the pose at rest, which all instances share.
        const auto at_rest = shadow_mesh(mesh);
        if (!at_rest) return forward_error(at_rest);
        auto deformed = (*at_rest)->deformed(geometry.positions);
        if (!deformed) {
            return fail(deformed.error().code,
                        "Mesh \"" + mesh->name + "\": " + deformed.error().message);
        }
        known = {.mesh = mesh,
                 .shadow_mesh = std::move(*deformed),
                 .revision = geometry.revision,
                 .used = true};
    }
    return known.shadow_mesh;
}

Result<std::vector<shadows::Caster>> ShadowAdapter::casters(const Scene& scene, bool culled,
                                                            shadows::NearCaps near_caps) {
    std::vector<shadows::Caster> casters;
    casters.reserve(casters_before_);
    Status status;
    for (auto& [key, known] : deformed_) known.used = false;
    scene.registry.each<Caster, MeshInstance, WorldTransform>([&](Entity entity, const Caster&,
                                                                  const MeshInstance& instance,
                                                                  const WorldTransform& transform) {
        const Geometry geometry = geometry_of(scene.registry, entity, instance, transform);
        auto mesh = geometry.revision == 0 ? shadow_mesh(instance.mesh)
                                           : deformed_mesh(entity, instance.mesh, geometry);
        if (!mesh) {
            status = forward_error(mesh);
            return;
        }
        const bool drawn_whole = fills_depth(scene, entity, *instance.mesh);
        casters.push_back({.key = entity.key(),
                           .mesh = *mesh,
                           .world_from_local = geometry.world_from_positions,
                           .in_depth_buffer = !culled && drawn_whole,
                           .near_caps = drawn_whole ? near_caps : shadows::NearCaps::Facing});
    });
    std::erase_if(deformed_, [](const auto& entry) { return !entry.second.used; });
    if (!status) return forward_error(status);
    casters_before_ = casters.size();
    return casters;
}

void ShadowAdapter::submit_receivers(const Scene& scene, shadows::ShadowSystem::Frame& frame) {
    for (auto& [key, known] : bounds_) known.used = false;
    scene.registry.each<Receiver, MeshInstance, WorldTransform>([&](Entity entity, const Receiver&,
                                                                    const MeshInstance& instance,
                                                                    const WorldTransform& world) {
        const Geometry geometry = geometry_of(scene.registry, entity, instance, world);
        if (geometry.positions.empty()) return;
        KnownBounds& known = bounds_[entity.key()];
        known.used = true;
        if (known.revision != geometry.revision || known.mesh.lock() != instance.mesh) {
            known.mesh = instance.mesh;
            known.revision = geometry.revision;
            known.min = known.max = geometry.positions[0];
            for (const glm::vec3& p : geometry.positions) {
                known.min = glm::min(known.min, p);
                known.max = glm::max(known.max, p);
            }
        }
        frame.receiver(
            {.key = entity.key(), .bounds = {geometry.world_from_positions, known.min, known.max}});
    });
    std::erase_if(bounds_, [](const auto& entry) { return !entry.second.used; });
}

Status ShadowAdapter::submit(const Scene& scene, shadows::ShadowSystem::Frame& frame, bool culled,
                             shadows::NearCaps near_caps, std::span<const Entity> without_shadow) {
    const auto casters = this->casters(scene, culled, near_caps);
    if (!casters) return forward_error(casters);
    for (const shadows::Caster& caster : *casters) frame.caster(caster);
    if (frame.takes_receivers()) submit_receivers(scene, frame);
    const auto submit_light = [&](Entity entity, const auto&) {
        if (std::ranges::find(without_shadow, entity) != without_shadow.end()) return;
        if (const auto light = shadow_light(scene.registry, entity)) frame.light(*light);
    };
    scene.registry.each<PointLight>(submit_light);
    scene.registry.each<SpotLight>(submit_light);
    scene.registry.each<DirectionalLight>(submit_light);
    return {};
}

}  // namespace gnomon::scene
