// SPDX-License-Identifier: MIT
#include "motion.hpp"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace gnomon::cli {

namespace {

glm::dmat4 turn_about(const glm::dvec3& point, double degrees) {
    const glm::dmat4 to = glm::translate(glm::dmat4(1.0), point);
    const glm::dmat4 back = glm::translate(glm::dmat4(1.0), -point);
    return to * glm::rotate(glm::dmat4(1.0), glm::radians(degrees), glm::dvec3(0.0, 1.0, 0.0)) *
           back;
}

}  // namespace

Animator::Animator(const Shot& shot, const Motion& motion)
    : motion_(motion), camera_start_(shot.world_from_camera), time_start_s_(shot.time_s) {
    const scene::Registry& registry = shot.scene.registry;
    const auto keep = [&](scene::Entity entity, const auto&) {
        if (const auto* transform = registry.try_get<scene::WorldTransform>(entity)) {
            moving_.push_back({entity, transform->world_from_local});
        }
    };
    if (motion.kind == MotionKind::Light) {
        registry.each<scene::PointLight>(keep);
        registry.each<scene::SpotLight>(keep);
        registry.each<scene::DirectionalLight>(keep);
    }
    if (motion.kind == MotionKind::Casters) {
        registry.each<scene::Caster>([&](scene::Entity entity, const scene::Caster& caster) {
            if (moving_.size() < motion.casters) keep(entity, caster);
        });
    }
}

Status Animator::apply(std::uint32_t frame, Shot& shot) const {
    if (motion_.kind == MotionKind::Time) {
        return pose_at(shot, time_start_s_ + motion_.seconds * frame);
    }
    // Whole turns are taken out first: the product stays exact enough for any number.
    const double degrees = std::fmod(motion_.degrees, 360.0) * frame;
    const glm::dvec3 center = shot.bounds.empty() ? glm::dvec3(0.0) : shot.bounds.center();
    if (motion_.kind == MotionKind::Camera) {
        shot.world_from_camera = turn_about(center, degrees) * camera_start_;
    }
    for (const Start& start : moving_) {
        // Lights go round the scene, casters turn where they stand.
        const glm::dvec3 pivot =
            motion_.kind == MotionKind::Light ? center : glm::dvec3(start.world[3]);
        shot.scene.registry.get<scene::WorldTransform>(start.entity).world_from_local =
            turn_about(pivot, degrees) * start.world;
    }
    return {};
}

}  // namespace gnomon::cli
