// SPDX-License-Identifier: MIT
//
// Small steps that scenes are put together with, by the description reader and by the built-in
// scenes alike.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <gnomon/scene/scene.hpp>

namespace gnomon::scene::internal {

/// Adds a material after the default one, which is made first where it is missing.
std::uint32_t add_material(Scene& scene, Material material);

struct DrawnAs {
    bool casts = true;
    bool receives = true;
};

Entity add_instance(Scene& scene, std::string name, std::shared_ptr<const Mesh> mesh,
                    const LocalTransform& local, std::optional<Entity> parent = std::nullopt,
                    DrawnAs drawn = {});

/// Copies all of `from` below one new node of `into`. Meshes are shared where their material
/// numbers stay the same, else copied once each.
Entity append_scene(Scene& into, const Scene& from, std::string name, const LocalTransform& local,
                    DrawnAs drawn = {});

/// World bounds of a node and everything below it. Needs up-to-date world transforms.
[[nodiscard]] Bounds bounds_below(const Scene& scene, Entity root);

/// At `position`, with -Z along `direction` (not zero) and +Y as close to `up` as that allows.
[[nodiscard]] LocalTransform looking_along(const glm::dvec3& position, const glm::dvec3& direction,
                                           const glm::dvec3& up = {0.0, 1.0, 0.0});

/// Turned about the fixed axes x, then y, then z, in degrees.
[[nodiscard]] glm::dquat turned_deg(const glm::dvec3& angles_deg);

}  // namespace gnomon::scene::internal
