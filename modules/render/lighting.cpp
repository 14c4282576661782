// SPDX-License-Identifier: MIT
#include "internal/lighting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::render::internal {

namespace {

float perspective_flag(const shadows::View& view) {
    return view.projection == shadows::ProjectionKind::Orthographic ? 0.0F : 1.0F;
}

// Metres in front of the eye between the near and the far plane. Everything where clipping does it.
glm::vec4 depth_range(const shadows::View& view) {
    if (view.projection == shadows::ProjectionKind::InfinitePerspective) {
        constexpr float all = std::numeric_limits<float>::max();
        return {-all, all, 0.0F, 0.0F};
    }
    const auto depth = [&](const glm::dvec3& p) {
        return static_cast<float>(-(view.view_from_world * glm::dvec4(p, 1.0)).z);
    };
    return {depth(near_corners(view)[0]), depth(far_corners(view)[0]), 0.0F, 0.0F};
}

// Whether the frustum and a sphere may have a point in common: it is not wholly beyond one of the
// planes that bound clip space.
bool may_show_sphere(const shadows::View& view, const glm::dvec3& center, double radius) {
    const glm::dmat4 rows = glm::transpose(view.clip_from_world());
    const bool has_far_plane = view.projection != shadows::ProjectionKind::InfinitePerspective;
    for (const glm::dvec4& plane : {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                                    rows[3] - rows[1], rows[3] - rows[2], rows[2]}) {
        if (!has_far_plane && plane == rows[2]) continue;
        const double distance = glm::dot(plane, glm::dvec4(center, 1.0));
        // A hair's breadth more, for what is rounded here and in the shader.
        if (distance < -1.0001 * radius * glm::length(glm::dvec3(plane))) return false;
    }
    return true;
}

}  // namespace

std::vector<FrameLight> frame_lights(const scene::Scene& scene, const scene::Bounds& bounds,
                                     std::span<const shadows::LightDraws> lights,
                                     std::span<const scene::Entity> unshadowed,
                                     const shadows::View& view, std::optional<float> exposure) {
    const glm::dvec3 center = bounds.empty() ? glm::dvec3(0.0) : bounds.center();
    const double radius = std::max(bounds.diagonal() * 0.5, 1e-30);
    std::vector<FrameLight> result;
    std::vector<double> illuminance;  // of the scene, in lux
    for (std::size_t i = 0; i < lights.size() + unshadowed.size(); ++i) {
        const bool shadowed = i < lights.size();
        const scene::Entity entity =
            shadowed ? scene::Entity::from_key(lights[i].light) : unshadowed[i - lights.size()];
        const glm::dmat4& world =
            scene.registry.get<scene::WorldTransform>(entity).world_from_local;
        FrameLight light;
        light.uniforms.spot_axis = glm::vec4(0.0F, 0.0F, 0.0F, -2.0F);
        light.uniforms.spot_range = glm::vec4(0.0F);
        if (shadowed) light.draws = i;
        glm::dvec4 position_world(0.0);
        glm::vec3 color(1.0F);
        float intensity = 1.0F;
        if (const auto* sun = scene.registry.try_get<scene::DirectionalLight>(entity)) {
            position_world = glm::dvec4(glm::normalize(glm::dvec3(world[2])), 0.0);
            color = sun->color;
            intensity = sun->intensity;
            illuminance.push_back(static_cast<double>(intensity));
        } else {
            position_world = glm::dvec4(glm::dvec3(world[3]), 1.0);
            std::optional<double> range;
            if (const auto* point = scene.registry.try_get<scene::PointLight>(entity)) {
                color = point->color;
                intensity = point->intensity;
                range = point->range_m;
            } else {
                const auto& spot = scene.registry.get<scene::SpotLight>(entity);
                color = spot.color;
                intensity = spot.intensity;
                range = spot.range_m;
                const glm::dvec3 axis = -glm::normalize(glm::dvec3(world[2]));
                light.uniforms.spot_axis =
                    glm::vec4(glm::vec3(glm::dmat3(view.view_from_world) * axis),
                              std::cos(spot.outer_cone_rad));
                light.uniforms.spot_range.x = std::cos(spot.inner_cone_rad);
            }
            light.uniforms.spot_range.y = static_cast<float>(range.value_or(0.0));
            if (range) light.in_view = may_show_sphere(view, glm::dvec3(position_world), *range);
            // What it is for lies at some distance: the scene's middle, but no farther than its
            // range lets it reach.
            double distance =
                std::max(glm::length(center - glm::dvec3(position_world)), 0.25 * radius);
            if (range) distance = std::min(distance, 0.4 * *range);
            illuminance.push_back(static_cast<double>(intensity) / (distance * distance));
        }
        light.uniforms.light_view = glm::vec4(view.view_from_world * position_world);
        light.uniforms.light_view.w = static_cast<float>(position_world.w);
        light.uniforms.color = glm::vec4(color * intensity, 0.0F);
        result.push_back(light);
    }
    double strongest = 0.0;
    double sum = 0.0;
    for (const double e : illuminance) {
        strongest = std::max(strongest, e);
        sum += e;
    }
    const double together = strongest + 0.35 * (std::min(sum, 3.0 * strongest) - strongest);
    const float scale =
        exposure.value_or(together > 0.0 ? static_cast<float>(3.4 / together) : 0.0F);
    for (FrameLight& light : result) {
        light.uniforms.color.r *= scale;
        light.uniforms.color.g *= scale;
        light.uniforms.color.b *= scale;
    }
    return result;
}

RoundUniforms round_uniforms(const shadows::View& view, std::span<const FrameLight> lights,
                             const Environment& environment, bool first) {
    const glm::vec3 up(glm::dmat3(view.view_from_world) * glm::dvec3(0.0, 1.0, 0.0));
    RoundUniforms round{
        .sky = glm::vec4(environment.sky, 0.0F),
        .ground = glm::vec4(environment.ground, 0.0F),
        .up_view = glm::vec4(up, perspective_flag(view)),
        .depth_range = depth_range(view),
        .lit_by = {static_cast<std::uint32_t>(lights.size()), first ? 1U : 0U, 0U, 0U},
        .lights = {}};
    for (std::size_t i = 0; i < lights.size(); ++i) round.lights[i] = lights[i].uniforms;
    return round;
}

}  // namespace gnomon::render::internal
