// SPDX-License-Identifier: MIT
#include "tests/rows/stage.hpp"

#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/transforms.hpp>

namespace gnomon::test {

MeshPointer shared(scene::Mesh mesh) {
    return std::make_shared<const scene::Mesh>(std::move(mesh));
}

glm::dmat4 moved(const glm::dvec3& by) { return glm::translate(glm::dmat4(1.0), by); }
glm::dmat4 turned(double degrees, const glm::dvec3& axis) {
    return glm::rotate(glm::dmat4(1.0), glm::radians(degrees), glm::normalize(axis));
}
glm::dmat4 scaled(const glm::dvec3& by) { return glm::scale(glm::dmat4(1.0), by); }

scene::Entity Stage::place(const MeshPointer& mesh, const glm::dmat4& pose, bool casts,
                           bool drawn) {
    scene::LocalTransform local;
    local.matrix = pose;
    const scene::Entity entity = scene_.create_node(mesh->name, local);
    scene_.registry.emplace<scene::MeshInstance>(entity, mesh);
    if (casts) scene_.registry.emplace<scene::Caster>(entity);
    if (drawn) scene_.registry.emplace<scene::Receiver>(entity);
    return entity;
}

void Stage::ground(float size, const glm::dmat4& pose) {
    place(shared(scene::make_plane(size, size, 4)), pose);
}

void Stage::lamp(const glm::dvec3& at, std::optional<double> range_m) {
    scene::LocalTransform local;
    local.translation = at;
    scene_.registry.emplace<scene::PointLight>(scene_.create_node("lamp", local)).range_m = range_m;
}

void Stage::sun(const glm::dvec3& travel) {
    scene::LocalTransform local;
    local.matrix = glm::inverse(shadows::look_at(glm::dvec3(0.0), travel, {0.123, 1.0, 0.456}));
    scene_.registry.emplace<scene::DirectionalLight>(scene_.create_node("sun", local));
}

void Stage::look(const glm::dvec3& eye, const glm::dvec3& target, double fovy_deg, double near_m) {
    view_.view_from_world = shadows::look_at(eye, target, {0.0, 1.0, 0.0});
    view_.clip_from_view = shadows::infinite_perspective(
        glm::radians(fovy_deg), static_cast<double>(row_width) / row_height, near_m);
}

void Stage::look_orthographic(const glm::dvec3& eye, const glm::dvec3& target, double half_height,
                              double near_m, double far_m) {
    view_.view_from_world = shadows::look_at(eye, target, {0.0, 1.0, 0.0});
    view_.clip_from_view =
        shadows::orthographic(half_height * row_width / row_height, half_height, near_m, far_m);
    view_.projection = shadows::ProjectionKind::Orthographic;
}

Setting Stage::finish() {
    scene::update_world_transforms(scene_.registry);
    return {std::move(scene_), view_};
}

}  // namespace gnomon::test
