// SPDX-License-Identifier: MIT
#include "tests/near_caps/scenes.hpp"

#include <cmath>
#include <memory>
#include <utility>

#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/scene/transforms.hpp>

#include "tests/support/devices.hpp"

namespace gnomon::test {

namespace {

constexpr double aspect = static_cast<double>(row_width) / row_height;

void place(scene::Scene& scene, scene::Mesh mesh, const glm::dvec3& at, bool drawn = true) {
    const scene::Entity node = scene.create_node(mesh.name, {.translation = at});
    scene.registry.emplace<scene::MeshInstance>(
        node, std::make_shared<const scene::Mesh>(std::move(mesh)));
    scene.registry.emplace<scene::Caster>(node);
    if (drawn) scene.registry.emplace<scene::Receiver>(node);
}

void shine(scene::Scene& scene, const glm::dvec3& travel) {
    scene::LocalTransform local;
    local.matrix = glm::inverse(shadows::look_at(glm::dvec3(0.0), travel, {0.123, 1.0, 0.456}));
    scene.registry.emplace<scene::DirectionalLight>(scene.create_node("sun", local));
}

Setting seen_from(scene::Scene scene, const glm::dvec3& eye, double fovy_rad,
                  const glm::dvec3& up = {0.0, 1.0, 0.0}) {
    scene::update_world_transforms(scene.registry);
    return {std::move(scene),
            {shadows::look_at(eye, glm::dvec3(0.0), up),
             shadows::infinite_perspective(fovy_rad, aspect, 0.01)}};
}

}  // namespace

Setting sphere_in_the_sun(std::uint32_t slices, std::uint32_t stacks,
                          const glm::dvec3& sun_travel) {
    scene::Scene scene;
    scene.materials.emplace_back();
    place(scene, scene::make_sphere(1.0F, slices, stacks), glm::dvec3(0.0));
    shine(scene, sun_travel);
    return seen_from(std::move(scene), {0.0, 0.0, 6.0}, 0.4);
}

Setting eye_in_a_solid(bool solid_is_drawn) {
    scene::Scene scene;
    scene.materials.emplace_back();
    place(scene, scene::make_sphere(5.0F, 32, 16), glm::dvec3(0.0), solid_is_drawn);
    place(scene, scene::make_plane(4.0F, 4.0F), {0.0, -1.0, 0.0});
    place(scene, scene::make_box(glm::vec3(0.8F)), {0.3, -0.6, 0.0});
    shine(scene, {-0.4, -1.0, -0.3});
    return seen_from(std::move(scene), {0.0, 1.0, 3.0}, 1.0);
}

Setting undrawn_sheet_above_a_floor(double gap_m) {
    scene::Scene scene;
    scene.materials.emplace_back();
    place(scene, scene::make_plane(8.0F, 8.0F), glm::dvec3(0.0));
    place(scene, scene::make_plane(1.0F, 1.0F), {0.0, gap_m, 0.0}, false);
    shine(scene, {-0.1, -1.0, 0.2});
    return seen_from(std::move(scene), {0.0, 5.0, 0.0}, 0.5, {0.0, 0.0, -1.0});
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
