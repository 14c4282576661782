// SPDX-License-Identifier: MIT
#include "tests/near_caps/judged.hpp"

#include <cmath>
#include <map>

#include <gnomon/scene/shadow_adapter.hpp>

#include "tests/support/devices.hpp"

namespace gnomon::test {

std::vector<truth::Picture> trace_lights(const Setting& setting) {
    std::map<std::uint64_t, shadows::Light> lights;
    const auto add = [&](scene::Entity entity, const auto&) {
        if (const auto light = scene::shadow_light(setting.scene.registry, entity)) {
            lights.emplace(light->key, *light);
        }
    };
    setting.scene.registry.each<scene::PointLight>(add);
    setting.scene.registry.each<scene::SpotLight>(add);
    setting.scene.registry.each<scene::DirectionalLight>(add);

    const glm::dvec3 eye(glm::inverse(setting.view.view_from_world)[3]);
    const auto instances = truth::instances_of(setting.scene);
    const truth::Tracer tracer = must(truth::Tracer::build(instances, eye));
    std::vector<truth::Picture> pictures;
    for (const auto& [key, light] : lights) {
        pictures.push_back(
            tracer.trace(setting.view, light, {.width = row_width, .height = row_height}));
    }
    return pictures;
}

truth::Judgement judge_lights(std::span<const truth::Picture> truth,
                              std::span<const std::vector<std::uint8_t>> masks) {
    truth::Judgement total;
    for (std::size_t i = 0; i < masks.size(); ++i) {
        const truth::Judgement one = truth::judge(truth[i], masks[i]);
        total.pixels += one.pixels;
        total.lit += one.lit;
        total.shadowed += one.shadowed;
        total.band += one.band;
        total.false_shadow += one.false_shadow;
        total.false_light += one.false_light;
    }
    return total;
}

Setting only_solids_cast(Setting setting) {
    scene::ShadowAdapter adapter;
    std::vector<scene::Entity> others;
    setting.scene.registry.each<scene::Caster, scene::MeshInstance, scene::WorldTransform>(
        [&](scene::Entity entity, const scene::Caster&, const scene::MeshInstance& instance,
            const scene::WorldTransform& transform) {
            const auto mesh = must(adapter.shadow_mesh(instance.mesh));
            bool solid = mesh->report().closed() &&
                         std::abs(glm::determinant(glm::dmat3(transform.world_from_local))) > 0.0;
            for (const auto& component : mesh->components()) {
                solid = solid && !component.inside_out;
            }
            if (!solid) others.push_back(entity);
        });
    for (const scene::Entity entity : others) setting.scene.registry.remove<scene::Caster>(entity);
    return setting;
}

}  // namespace gnomon::test
