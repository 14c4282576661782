// SPDX-License-Identifier: MIT
#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>

#include <gnomon/panel/lights.hpp>

namespace gnomon::panel {

std::vector<LightLine> lights_of(const scene::Scene& scene, std::string_view nameless) {
    const scene::Registry& registry = scene.registry;
    std::vector<LightLine> lights;
    const auto collect = [&](const char* otherwise) {
        return [&, otherwise](scene::Entity entity, const auto&) {
            const auto* name = registry.try_get<scene::Name>(entity);
            const bool has_name =
                name != nullptr && !name->value.empty() && name->value != nameless;
            std::string shown = has_name ? name->value : otherwise;
            // A line of a table.
            std::ranges::replace_if(
                shown, [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
            lights.push_back({.entity = entity, .name = std::move(shown)});
        };
    };
    registry.each<scene::DirectionalLight>(collect("sun"));
    registry.each<scene::PointLight>(collect("lamp"));
    registry.each<scene::SpotLight>(collect("lamp"));
    std::unordered_map<std::string, std::size_t> seen;
    for (LightLine& light : lights) {
        const std::size_t number = ++seen[light.name];
        if (number > 1) light.name += fmt::format(" {}", number);
    }
    return lights;
}

SwitchedLights switched(std::span<const LightLine> lights) {
    SwitchedLights result;
    for (const LightLine& light : lights) {
        if (!light.on) {
            result.off.push_back(light.entity);
        } else if (!light.casts) {
            result.unshadowed.push_back(light.entity);
        }
    }
    return result;
}

bool is_directional(const scene::Registry& registry, scene::Entity light) {
    return registry.has<scene::DirectionalLight>(light);
}

glm::vec3 color_of_light(const scene::Registry& registry, scene::Entity light) {
    if (const auto* sun = registry.try_get<scene::DirectionalLight>(light)) return sun->color;
    if (const auto* point = registry.try_get<scene::PointLight>(light)) return point->color;
    if (const auto* spot = registry.try_get<scene::SpotLight>(light)) return spot->color;
    return glm::vec3(0.0F);
}

glm::dvec3 handle_of(const scene::Registry& registry, scene::Entity light,
                     const scene::Bounds& bounds) {
    const glm::dmat4& world = registry.get<scene::WorldTransform>(light).world_from_local;
    if (!is_directional(registry, light)) return glm::dvec3(world[3]);
    const glm::dvec3 center = bounds.empty() ? glm::dvec3(0.0) : bounds.center();
    const double away_m = bounds.empty() ? 1.0 : 0.55 * bounds.diagonal();
    return center + glm::normalize(glm::dvec3(world[2])) * away_m;
}

}  // namespace gnomon::panel
