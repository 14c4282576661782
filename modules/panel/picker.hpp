// SPDX-License-Identifier: MIT
//
// What lies under a pixel: rays through the picture against the triangles that are drawn.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>

#include <glm/glm.hpp>

#include <gnomon/scene/scene.hpp>
#include <gnomon/shadows/view.hpp>

namespace gnomon::panel {

struct Ray {
    glm::dvec3 origin_world{0.0};
    glm::dvec3 direction_world{0.0, 0.0, -1.0};  ///< unit
};

/// From the near plane away from the eye, through the middle of a pixel (fractions are between
/// pixels' middles; row 0 on top).
[[nodiscard]] Ray ray_through(const shadows::View& view, const glm::dvec2& pixel,
                              const glm::uvec2& size_px);

/// Where a point is in the picture; nothing behind the eye.
[[nodiscard]] std::optional<glm::dvec2> pixel_of(const shadows::View& view, const glm::dvec3& world,
                                                 const glm::uvec2& size_px);

struct Hit {
    scene::Entity entity;
    glm::dvec3 point_world{0.0};
    glm::dvec3 normal_world{0.0, 1.0, 0.0};  ///< the triangle's, unit, towards the ray's origin
    double distance_m = 0.0;
};

/// Remembers the bounds of meshes, so that most are passed over.
class Picker {
public:
    /// The nearest of the Receivers' triangles. World transforms are up to date. Cost: linear in
    /// the triangles of the meshes whose bounds the ray meets, some nanoseconds each.
    [[nodiscard]] std::optional<Hit> pick(const scene::Scene& scene, const Ray& ray);

private:
    struct Known {
        std::weak_ptr<const scene::Mesh> mesh;
        std::uint64_t revision = 0;
        glm::dvec3 min{0.0};
        glm::dvec3 max{0.0};
    };
    const Known& bounds_of(scene::Entity entity, const scene::MeshInstance& instance,
                           const scene::Geometry& geometry);
    std::unordered_map<std::uint64_t, Known> known_;  // by entity
};

}  // namespace gnomon::panel
