// SPDX-License-Identifier: MIT
//
// From gnomon's own registry into a ShadowSystem's frame: a plain loop without privileges. What an
// embedder writes for their own ECS looks the same.
#pragma once

#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/shadows/shadow_system.hpp>

#pragma GCC visibility push(default)
namespace gnomon::scene {

/// The light of an entity as shadows see it, or nothing where it has none. Needs an up-to-date
/// world transform.
[[nodiscard]] std::optional<shadows::Light> shadow_light(const Registry& registry, Entity entity);

/// Submits a scene to a shadow system, and remembers the shadow meshes that it made. One thread at
/// a time.
class ShadowAdapter {
public:
    /// Submits every Caster, every light but those of `without_shadow`, and where the system takes
    /// receivers every Receiver. Shadow meshes are made the first time a mesh is met and kept while
    /// it lives; those of deformed instances, from the very positions that are drawn, whenever
    /// Deformed::revision changes. `culled`: back faces are not drawn, so depth-pass needs caps.
    /// `near_caps` is for casters that are drawn whole; what is hidden or alpha-tested may have
    /// something to be seen inside and keeps its caps towards the light. Fails when a mesh is not
    /// acceptable to ShadowMesh::build. Cost: a look-up a caster and a receiver.
    [[nodiscard]] Status submit(const Scene& scene, shadows::ShadowSystem::Frame& frame,
                                bool culled = false,
                                shadows::NearCaps near_caps = shadows::NearCaps::Facing,
                                std::span<const Entity> without_shadow = {});

    /// The casters alone, as submit() submits them: for ShadowQueries. Fails and costs as that
    /// does.
    [[nodiscard]] Result<std::vector<shadows::Caster>> casters(
        const Scene& scene, bool culled = false,
        shadows::NearCaps near_caps = shadows::NearCaps::Facing);

    /// The shadow mesh of a mesh: one for all its nodes, but those that deform. Where a mesh can
    /// deform this is its topology, in the pose that it was bound in.
    [[nodiscard]] Result<std::shared_ptr<const shadows::ShadowMesh>> shadow_mesh(
        const std::shared_ptr<const Mesh>& mesh);

private:
    void submit_receivers(const Scene& scene, shadows::ShadowSystem::Frame& frame);
    [[nodiscard]] Result<std::shared_ptr<const shadows::ShadowMesh>> deformed_mesh(
        Entity entity, const std::shared_ptr<const Mesh>& mesh, const Geometry& geometry);

    struct Known {
        std::weak_ptr<const Mesh> mesh;  // tells a new mesh at an old address apart
        std::shared_ptr<const shadows::ShadowMesh> shadow_mesh;
    };
    struct KnownDeformed {
        std::shared_ptr<const Mesh> mesh;
        std::shared_ptr<const shadows::ShadowMesh> shadow_mesh;
        std::uint64_t revision = 0;
        bool used = true;  // by the casters() at work
    };
    struct KnownBounds {
        std::weak_ptr<const Mesh> mesh;
        std::uint64_t revision = 0;
        glm::vec3 min{0.0F};
        glm::vec3 max{0.0F};
        bool used = true;  // by the submit() at work
    };
    std::size_t casters_before_ = 0;
    std::unordered_map<const Mesh*, Known> known_;
    std::unordered_map<std::uint64_t, KnownBounds> bounds_;      // by entity
    std::unordered_map<std::uint64_t, KnownDeformed> deformed_;  // by entity
};

}  // namespace gnomon::scene
#pragma GCC visibility pop
