// SPDX-License-Identifier: MIT
#include <gnomon/panel/picker.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::panel {

namespace {

// The ray's parameters at which it is within the box; by slabs.
bool meets_box(const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3& min,
               const glm::dvec3& max, double nearest) {
    double enter = 0.0;
    double leave = nearest;
    for (int axis = 0; axis < 3; ++axis) {
        // Along the slab; where it runs within a side's plane, a quotient would be no number.
        if (direction[axis] == 0.0) {
            if (origin[axis] < min[axis] || origin[axis] > max[axis]) return false;
            continue;
        }
        const double a = (min[axis] - origin[axis]) / direction[axis];
        const double b = (max[axis] - origin[axis]) / direction[axis];
        if (std::min(a, b) > enter) enter = std::min(a, b);
        if (std::max(a, b) < leave) leave = std::max(a, b);
    }
    return enter <= leave;
}

// T. Möller, B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection" (1997), both sides.
double meet_triangle(const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3& a,
                     const glm::dvec3& b, const glm::dvec3& c) {
    constexpr double misses = std::numeric_limits<double>::infinity();
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 p = glm::cross(direction, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0.0) return misses;
    const glm::dvec3 to_origin = origin - a;
    const double u = glm::dot(to_origin, p) / determinant;
    if (!(u >= 0.0 && u <= 1.0)) return misses;
    const glm::dvec3 q = glm::cross(to_origin, ab);
    const double v = glm::dot(direction, q) / determinant;
    if (!(v >= 0.0 && u + v <= 1.0)) return misses;
    const double t = glm::dot(ac, q) / determinant;
    return t > 0.0 ? t : misses;
}

}  // namespace

Ray ray_through(const shadows::View& view, const glm::dvec2& pixel, const glm::uvec2& size_px) {
    const glm::dvec2 ndc = (pixel + 0.5) / glm::dvec2(size_px) * 2.0 - 1.0;
    const glm::dmat4 world_from_clip = glm::inverse(view.clip_from_world());
    const glm::dvec4 near = world_from_clip * glm::dvec4(ndc.x, -ndc.y, 1.0, 1.0);
    // At depth 0, perhaps at infinity: w = 0.
    const glm::dvec4 far = world_from_clip * glm::dvec4(ndc.x, -ndc.y, 0.0, 1.0);
    const glm::dvec3 origin = glm::dvec3(near) / near.w;
    return {origin, glm::normalize(glm::dvec3(far) - origin * far.w)};
}

std::optional<glm::dvec2> pixel_of(const shadows::View& view, const glm::dvec3& world,
                                   const glm::uvec2& size_px) {
    const glm::dvec4 clip = view.clip_from_world() * glm::dvec4(world, 1.0);
    if (!(clip.w > 0.0) || clip.z > clip.w) return std::nullopt;
    const glm::dvec2 ndc = glm::dvec2(clip) / clip.w;
    return (glm::dvec2(ndc.x, -ndc.y) + 1.0) / 2.0 * glm::dvec2(size_px) - 0.5;
}

const Picker::Known& Picker::bounds_of(scene::Entity entity, const scene::MeshInstance& instance,
                                       const scene::Geometry& geometry) {
    Known& known = known_[entity.key()];
    if (known.mesh.lock() == instance.mesh && known.revision == geometry.revision) return known;
    known.mesh = instance.mesh;
    known.revision = geometry.revision;
    known.min = glm::dvec3(std::numeric_limits<double>::infinity());
    known.max = -known.min;
    for (const glm::vec3& p : geometry.positions) {
        known.min = glm::min(known.min, glm::dvec3(p));
        known.max = glm::max(known.max, glm::dvec3(p));
    }
    return known;
}

std::optional<Hit> Picker::pick(const scene::Scene& scene, const Ray& ray) {
    std::optional<Hit> best;
    double nearest = std::numeric_limits<double>::infinity();
    const scene::Registry& registry = scene.registry;
    registry.each<scene::Receiver, scene::MeshInstance, scene::WorldTransform>(
        [&](scene::Entity entity, const scene::Receiver&, const scene::MeshInstance& instance,
            const scene::WorldTransform& world) {
            const scene::Geometry geometry = scene::geometry_of(registry, entity, instance, world);
            if (glm::determinant(glm::dmat3(geometry.world_from_positions)) == 0.0) return;
            const glm::dmat4 local_from_world = glm::inverse(geometry.world_from_positions);
            const glm::dvec3 origin(local_from_world * glm::dvec4(ray.origin_world, 1.0));
            // Not made unit: its parameter is metres in the world then.
            const glm::dvec3 direction(local_from_world * glm::dvec4(ray.direction_world, 0.0));
            const Known& bounds = bounds_of(entity, instance, geometry);
            if (!meets_box(origin, direction, bounds.min, bounds.max, nearest)) return;
            const auto& indices = instance.mesh->indices;
            for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
                const glm::dvec3 a(geometry.positions[indices[i]]);
                const glm::dvec3 b(geometry.positions[indices[i + 1]]);
                const glm::dvec3 c(geometry.positions[indices[i + 2]]);
                const double t = meet_triangle(origin, direction, a, b, c);
                if (!(t < nearest)) continue;
                nearest = t;
                const glm::dmat3 linear(geometry.world_from_positions);
                glm::dvec3 normal = glm::cross(linear * (b - a), linear * (c - a));
                if (glm::dot(normal, ray.direction_world) > 0.0) normal = -normal;
                best = Hit{.entity = entity,
                           .point_world = ray.origin_world + ray.direction_world * t,
                           .normal_world = glm::normalize(normal),
                           .distance_m = t};
            }
        });
    return best;
}

}  // namespace gnomon::panel
