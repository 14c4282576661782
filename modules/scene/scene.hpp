// SPDX-License-Identifier: MIT
//
// Scene: a registry and the assets its components share.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <gnomon/scene/animation.hpp>
#include <gnomon/scene/components.hpp>
#include <gnomon/scene/mesh.hpp>
#include <gnomon/scene/registry.hpp>

#pragma GCC visibility push(default)
namespace gnomon::scene {

/// Everything there is: entities, and what they share.
struct Scene {
    Registry registry;  ///< nodes, lights, cameras
    std::vector<Material>
        materials;  ///< at least one once anything is drawn: index 0 is the default
    std::vector<Animation> animations;  ///< played by animate(), animation.hpp
    std::vector<std::string> messages;  ///< what a reader skipped or changed, one sentence each

    /// An entity with a name, a local and a world transform; the latter from the parent's as it is
    /// now.
    Entity create_node(std::string name, const LocalTransform& local = {},
                       std::optional<Entity> parent = std::nullopt);
};

/// Smallest axis-aligned box.
struct Bounds {
    /// metres; infinite where it is empty
    glm::dvec3 min{std::numeric_limits<double>::infinity()};
    /// metres; infinite where it is empty
    glm::dvec3 max{-std::numeric_limits<double>::infinity()};

    /// Whether nothing is in it.
    [[nodiscard]] bool empty() const { return !(min.x <= max.x); }
    /// Its middle; not for an empty one.
    [[nodiscard]] glm::dvec3 center() const { return (min + max) * 0.5; }
    /// Metres; 0 for an empty one.
    [[nodiscard]] double diagonal() const { return empty() ? 0.0 : glm::length(max - min); }
    /// Grows so that the point is in it.
    void include(const glm::dvec3& p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
};

/// The vertices of an instance as they are drawn and cast shadows: its Deformed, where it has one
/// of its mesh, else the mesh's own. The triangles are the mesh's either way.
struct Geometry {
    std::span<const glm::vec3> positions;  ///< metres, relative to world_from_positions
    std::span<const glm::vec3> normals;    ///< unit, one a position
    glm::dmat4 world_from_positions{1.0};  ///< affine
    std::uint64_t revision = 0;            ///< Deformed::revision; 0: the mesh's own
};

/// The spans live as long as the mesh and the Deformed do and are not written.
[[nodiscard]] Geometry geometry_of(const Registry& registry, Entity entity,
                                   const MeshInstance& instance, const WorldTransform& world);

/// World bounds of everything that has a mesh: exact over the vertices. Needs up-to-date world
/// transforms.
[[nodiscard]] Bounds world_bounds(const Scene& scene);

}  // namespace gnomon::scene
#pragma GCC visibility pop
