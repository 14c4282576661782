// SPDX-License-Identifier: MIT
#include "internal/compose.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <gnomon/scene/transforms.hpp>

#include "internal/mesh_bounds.hpp"

namespace gnomon::scene::internal {
namespace {

void ensure_default_material(Scene& scene) {
    if (scene.materials.empty()) {
        scene.materials.emplace_back();
        scene.materials.back().name = "default";
    }
}

template <class T>
void copy_component(const Registry& from, Entity source, Registry& into, Entity target) {
    if (const T* component = from.try_get<T>(source)) into.emplace<T>(target, *component);
}

/// Meshes of another scene with their material numbers moved by `shift`; 0, the default, stays.
class MeshCopies {
public:
    explicit MeshCopies(std::uint32_t shift) : shift_(shift) {}

    std::shared_ptr<const Mesh> of(const std::shared_ptr<const Mesh>& mesh) {
        if (shift_ == 0 || !mesh) return mesh;
        auto& copy = copies_[mesh.get()];
        if (!copy) {
            Mesh moved = *mesh;
            for (SubMesh& sub_mesh : moved.sub_meshes) {
                if (sub_mesh.material != 0) sub_mesh.material += shift_;
            }
            copy = std::make_shared<const Mesh>(std::move(moved));
        }
        return copy;
    }

private:
    std::uint32_t shift_;
    std::map<const Mesh*, std::shared_ptr<const Mesh>> copies_;
};

void copy_instance(const Registry& from, Entity source, Registry& into, Entity target,
                   MeshCopies& meshes) {
    const auto* instance = from.try_get<MeshInstance>(source);
    if (instance == nullptr) return;
    into.emplace<MeshInstance>(target, meshes.of(instance->mesh));
    copy_component<MorphWeights>(from, source, into, target);
    const auto* deformed = from.try_get<Deformed>(source);
    if (deformed == nullptr || deformed->mesh != instance->mesh) return;
    // The same numbers, so the same revision.
    into.emplace<Deformed>(target, *deformed).mesh = meshes.of(instance->mesh);
}

void append_animations(Scene& into, const Scene& from,
                       const std::map<std::uint32_t, Entity>& copies) {
    std::uint32_t model = 0;
    for (const Animation& known : into.animations) model = std::max(model, known.model + 1);
    for (Animation animation : from.animations) {
        animation.model += model;
        for (AnimationChannel& channel : animation.channels) {
            channel.target = copies.at(channel.target.index);
        }
        into.animations.push_back(std::move(animation));
    }
}

}  // namespace

std::uint32_t add_material(Scene& scene, Material material) {
    ensure_default_material(scene);
    scene.materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

Entity add_instance(Scene& scene, std::string name, std::shared_ptr<const Mesh> mesh,
                    const LocalTransform& local, std::optional<Entity> parent, DrawnAs drawn) {
    ensure_default_material(scene);
    const Entity entity = scene.create_node(std::move(name), local, parent);
    scene.registry.emplace<MeshInstance>(entity, std::move(mesh));
    if (drawn.casts) scene.registry.emplace<Caster>(entity);
    if (drawn.receives) scene.registry.emplace<Receiver>(entity);
    return entity;
}

Entity append_scene(Scene& into, const Scene& from, std::string name, const LocalTransform& local,
                    DrawnAs drawn) {
    ensure_default_material(into);
    MeshCopies meshes(static_cast<std::uint32_t>(into.materials.size() - 1));
    if (!from.materials.empty()) {
        into.materials.insert(into.materials.end(), from.materials.begin() + 1,
                              from.materials.end());
    }
    into.messages.insert(into.messages.end(), from.messages.begin(), from.messages.end());

    const Entity root = into.create_node(std::move(name), local);
    std::map<std::uint32_t, Entity> copies;
    from.registry.each<LocalTransform>([&](Entity source, const LocalTransform& pose) {
        const auto* its_name = from.registry.try_get<Name>(source);
        copies[source.index] =
            into.create_node(its_name == nullptr ? std::string() : its_name->value, pose);
    });
    for (const auto& [index, target] : copies) {
        into.registry.emplace<Parent>(target, root);
    }
    from.registry.each<LocalTransform>([&](Entity source, const LocalTransform&) {
        const Entity target = copies.at(source.index);
        if (const auto* parent = from.registry.try_get<Parent>(source)) {
            into.registry.emplace<Parent>(target, copies.at(parent->value.index));
        }
        copy_instance(from.registry, source, into.registry, target, meshes);
        if (const auto* skin = from.registry.try_get<Skin>(source)) {
            Skin copy = *skin;
            for (Entity& joint : copy.joints) joint = copies.at(joint.index);
            into.registry.emplace<Skin>(target, std::move(copy));
        }
        if (drawn.casts) copy_component<Caster>(from.registry, source, into.registry, target);
        if (drawn.receives) copy_component<Receiver>(from.registry, source, into.registry, target);
        copy_component<PointLight>(from.registry, source, into.registry, target);
        copy_component<SpotLight>(from.registry, source, into.registry, target);
        copy_component<DirectionalLight>(from.registry, source, into.registry, target);
        copy_component<Camera>(from.registry, source, into.registry, target);
    });
    append_animations(into, from, copies);
    update_world_transforms(into.registry);
    return root;
}

Bounds bounds_below(const Scene& scene, Entity root) {
    // Children may have been made before their parents: follow every chain up until it is known.
    std::map<std::uint32_t, bool> is_below{{root.index, true}};
    const auto below = [&](Entity entity) {
        std::vector<std::uint32_t> chain;
        bool answer = false;
        for (std::optional<Entity> next = entity; next;) {
            if (const auto known = is_below.find(next->index); known != is_below.end()) {
                answer = known->second;
                break;
            }
            chain.push_back(next->index);
            const auto* parent = scene.registry.try_get<Parent>(*next);
            next = parent == nullptr ? std::nullopt : std::optional(parent->value);
        }
        for (const std::uint32_t index : chain) is_below[index] = answer;
        return answer;
    };
    Bounds bounds;
    scene.registry.each<MeshInstance, WorldTransform>(
        [&](Entity entity, const MeshInstance& instance, const WorldTransform& world) {
            if (!instance.mesh || !below(entity)) return;
            include_positions(bounds, geometry_of(scene.registry, entity, instance, world));
        });
    return bounds;
}

LocalTransform looking_along(const glm::dvec3& position, const glm::dvec3& direction,
                             const glm::dvec3& up) {
    const glm::dvec3 back = -glm::normalize(direction);
    glm::dvec3 right = glm::cross(up, back);
    if (glm::length(right) < 1e-9 * glm::length(up)) {
        // Straight along `up`: any other axis will do.
        right = glm::cross(
            std::abs(back.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0), back);
    }
    right = glm::normalize(right);
    LocalTransform local;
    local.translation = position;
    local.rotation =
        glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back)));
    return local;
}

glm::dquat turned_deg(const glm::dvec3& angles_deg) {
    const glm::dvec3 angles = glm::radians(angles_deg);
    return glm::angleAxis(angles.z, glm::dvec3(0.0, 0.0, 1.0)) *
           glm::angleAxis(angles.y, glm::dvec3(0.0, 1.0, 0.0)) *
           glm::angleAxis(angles.x, glm::dvec3(1.0, 0.0, 0.0));
}

}  // namespace gnomon::scene::internal
