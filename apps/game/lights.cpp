// SPDX-License-Identifier: MIT
#include "lights.hpp"

#include <algorithm>
#include <cmath>

#include <gnomon/scene/shadow_adapter.hpp>

namespace gnomon::game {

std::vector<MeterLight> meter_lights(const scene::Scene& scene) {
    const scene::Registry& registry = scene.registry;
    std::vector<MeterLight> lights;
    const auto add = [&](scene::Entity entity, double intensity) -> MeterLight* {
        const auto shadow = scene::shadow_light(registry, entity);
        if (!shadow) return nullptr;
        lights.push_back({.shadow = *shadow, .intensity = intensity});
        return &lights.back();
    };
    registry.each<scene::PointLight>([&](scene::Entity entity, const scene::PointLight& point) {
        add(entity, static_cast<double>(point.intensity));
    });
    registry.each<scene::SpotLight>([&](scene::Entity entity, const scene::SpotLight& spot) {
        MeterLight* light = add(entity, static_cast<double>(spot.intensity));
        if (light == nullptr) return;
        const glm::dmat4& pose = registry.get<scene::WorldTransform>(entity).world_from_local;
        light->axis = -glm::normalize(glm::dvec3(pose[2]));
        light->cos_inner = std::cos(static_cast<double>(spot.inner_cone_rad));
        light->cos_outer = std::cos(static_cast<double>(spot.outer_cone_rad));
    });
    registry.each<scene::DirectionalLight>(
        [&](scene::Entity entity, const scene::DirectionalLight& sun) {
            add(entity, static_cast<double>(sun.intensity));
        });
    return lights;
}

double illuminance(const MeterLight& light, const glm::dvec3& point) {
    if (light.shadow.position_world.w == 0.0) return light.intensity;
    const glm::dvec3 to_light = glm::dvec3(light.shadow.position_world) - point;
    const double distance2 = std::max(glm::dot(to_light, to_light), 1e-6);
    double lux = light.intensity / distance2;
    if (light.shadow.range_m) {
        const double x = distance2 / (*light.shadow.range_m * *light.shadow.range_m);
        lux *= std::clamp(1.0 - x * x, 0.0, 1.0);
    }
    if (light.cos_outer > -1.0) {
        const double c = -glm::dot(to_light, light.axis) / std::sqrt(distance2);
        const double t = std::clamp(
            (c - light.cos_outer) / std::max(light.cos_inner - light.cos_outer, 1e-4), 0.0, 1.0);
        lux *= t * t;
    }
    return lux;
}

}  // namespace gnomon::game
