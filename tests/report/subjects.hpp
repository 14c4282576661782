// SPDX-License-Identifier: MIT
//
// A torus over a box over a floor, small enough to be measured in a moment.
#pragma once

#include <memory>

#include <gnomon/render/camera.hpp>
#include <gnomon/report/report.hpp>
#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/transforms.hpp>

namespace gnomon::report::test {

inline void add(scene::Scene& scene, const char* name, scene::Mesh mesh,
                const glm::dvec3& position) {
    const scene::Entity node = scene.create_node(name, {.translation = position});
    scene.registry.emplace<scene::MeshInstance>(
        node, std::make_shared<const scene::Mesh>(std::move(mesh)));
    scene.registry.emplace<scene::Caster>(node);
    scene.registry.emplace<scene::Receiver>(node);
}

/// Seen from above, with a lamp that is well outside.
inline Subject torus_over_floor() {
    Subject subject;
    subject.name = "torus";
    subject.source = "made by a test";
    scene::Scene& scene = subject.scene;
    scene.materials.emplace_back();
    add(scene, "floor", scene::make_plane(8.0F, 8.0F), {0.0, 0.0, 0.0});
    add(scene, "torus", scene::make_torus(0.9F, 0.35F, 48, 24), {0.0, 1.1, 0.0});
    add(scene, "box", scene::make_box({0.9F, 0.4F, 0.9F}), {0.0, 0.25, 0.0});
    const scene::Entity lamp = scene.create_node("lamp", {.translation = {2.0, 9.0, 3.0}});
    scene.registry.emplace<scene::PointLight>(lamp, glm::vec3(1.0F), 40.0F);
    scene::update_world_transforms(scene.registry);
    subject.world_from_camera =
        render::camera_pose({2.2, 4.2, 4.0}, {0.0, 0.5, 0.0}, {0.0, 1.0, 0.0});
    subject.near_m = 0.05;
    return subject;
}

inline Options small_options() {
    Options options;
    options.width = 160;
    options.height = 90;
    options.rounds = 1;
    options.frames = 3;
    options.degrees_per_frame = 2.0;
    options.version = "test";
    return options;
}

}  // namespace gnomon::report::test
