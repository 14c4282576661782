// SPDX-License-Identifier: MIT
#include <algorithm>

#include <gnomon/panel/probe.hpp>
#include <gnomon/scene/shadow_adapter.hpp>

namespace gnomon::panel {

Probe probe_at(const Hit& hit, const scene::Registry& registry,
               const shadows::ShadowQueries& queries, std::span<const LightLine> lights,
               std::span<const scene::Entity> unshadowed, double size_m) {
    Probe probe{.hit = hit, .answers = {}};
    const double lift_m = std::max(1e-6 * size_m, 1e-9);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (!lights[i].on) continue;
        const auto light = scene::shadow_light(registry, lights[i].entity);
        if (!light) continue;
        const glm::dvec3 to_light = light->position_world.w == 0.0
                                        ? glm::dvec3(light->position_world)
                                        : glm::dvec3(light->position_world) - hit.point_world;
        const glm::dvec3 point = hit.point_world + hit.normal_world * lift_m;
        Probe::Answer answer{.light = i,
                             .exposure = queries.at(*light, point),
                             .faces_away = glm::dot(to_light, hit.normal_world) <= 0.0,
                             .surfaces = queries.surfaces_between(*light, point)};
        const bool casts =
            lights[i].casts && std::ranges::find(unshadowed, lights[i].entity) == unshadowed.end();
        if (!casts) {
            answer.surfaces = 0;
            if (answer.exposure == shadows::Exposure::Shadowed) {
                answer.exposure = shadows::Exposure::Lit;
            }
        }
        probe.answers.push_back(answer);
    }
    return probe;
}

}  // namespace gnomon::panel
