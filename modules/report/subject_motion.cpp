// SPDX-License-Identifier: MIT
#include "internal/subject_motion.hpp"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/render/camera.hpp>
#include <gnomon/scene/shadow_adapter.hpp>

namespace gnomon::report::internal {

LightTurn::LightTurn(Subject& subject, const Options& options)
    : scene_(subject.scene),
      bounds_(scene::world_bounds(subject.scene)),
      view_(render::make_view(subject.camera, subject.world_from_camera,
                              static_cast<double>(options.width) / options.height, subject.near_m)),
      degrees_per_frame_(options.degrees_per_frame) {
    const auto keep = [&](scene::Entity entity, const auto&) {
        if (const auto* world = scene_.registry.try_get<scene::WorldTransform>(entity)) {
            lights_.push_back({entity, world->world_from_local});
        }
    };
    scene_.registry.each<scene::PointLight>(keep);
    scene_.registry.each<scene::SpotLight>(keep);
    scene_.registry.each<scene::DirectionalLight>(keep);
}

void LightTurn::apply(std::uint32_t frame) {
    const glm::dvec3 center = bounds_.empty() ? glm::dvec3(0.0) : bounds_.center();
    const glm::dmat4 turn = glm::translate(glm::dmat4(1.0), center) *
                            glm::rotate(glm::dmat4(1.0), glm::radians(degrees_per_frame_ * frame),
                                        glm::dvec3(0.0, 1.0, 0.0)) *
                            glm::translate(glm::dmat4(1.0), -center);
    for (const Start& light : lights_) {
        scene_.registry.get<scene::WorldTransform>(light.entity).world_from_local =
            turn * light.world;
    }
}

Moment LightTurn::moment() const {
    Moment moment;
    moment.scene = &scene_;
    moment.view = view_;
    for (const Start& start : lights_) {
        if (const auto light = scene::shadow_light(scene_.registry, start.entity)) {
            moment.lights.push_back(*light);
        }
    }
    std::sort(moment.lights.begin(), moment.lights.end(),
              [](const shadows::Light& a, const shadows::Light& b) { return a.key < b.key; });
    return moment;
}

}  // namespace gnomon::report::internal
