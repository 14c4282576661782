// SPDX-License-Identifier: MIT
#include "caster_space.hpp"

#include <cmath>

#include "crossing.hpp"
#include "flattened_facing.hpp"

namespace gnomon::shadows::internal {

namespace {

constexpr double largest = 0x1p300;  // exact_orientation's
// What a few operations in double precision round, relative to the sum of their magnitudes.
constexpr double rounding = 0x1p-46;

// A box taken through a matrix, and the sum of magnitudes that bounds what was rounded.
Box<double> transformed(const glm::dmat4& matrix, const Box<float>& box) {
    const glm::dvec3 center = box.center();
    const glm::dvec3 half = box.half();
    const glm::dvec3 middle(matrix * glm::dvec4(center, 1.0));
    glm::dvec3 extent(0.0);
    glm::dvec3 magnitude = glm::abs(glm::dvec3(matrix[3]));
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 axis = glm::abs(glm::dvec3(matrix[i]));
        extent += axis * half[i];
        magnitude += axis * (std::abs(center[i]) + half[i]);
    }
    extent += rounding * magnitude;
    return {middle - extent, middle + extent};
}

bool within_range(const glm::dvec3& v) {
    return std::abs(v.x) < largest && std::abs(v.y) < largest && std::abs(v.z) < largest;
}

// To a multiple of 2^-149, as floats are, so that exact predicates do not underflow.
glm::dvec3 snapped(glm::dvec3 v) {
    for (int i = 0; i < 3; ++i) {
        if (std::abs(v[i]) < 0x1p-97) v[i] = static_cast<double>(static_cast<float>(v[i]));
    }
    return v;
}

}  // namespace

CasterSpace::CasterSpace(const ShadowMesh& mesh, const glm::dmat4& world_from_local)
    : pose_(make_pose(world_from_local)), faces_(&face_tree(mesh)) {
    const glm::dmat4& pose = pose_.world_from_local;
    casts_ = pose_.finite && !faces_->tree().empty();
    if (!casts_) return;
    world_bounds_ = transformed(pose, faces_->tree().bounds());
    casts_ = within_range(world_bounds_.min) && within_range(world_bounds_.max);
    if (pose_.singular) {
        parent_from_local_ = pose;
        parent_from_local_[3] = glm::dvec4(0.0, 0.0, 0.0, 1.0);
        return;
    }
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 row(glm::row(pose_.local_from_world, i));
        light_rounding_ += glm::length(glm::dvec3(pose[i])) * glm::length(row);
    }
    light_rounding_ *= 0x1.01p-24;
}

std::optional<glm::dvec3> CasterSpace::point(const glm::dvec3& point_world) const {
    const glm::dvec3 p =
        pose_.singular ? point_world - origin_world()
                       : glm::dvec3(local_light(pose_, glm::dvec4(point_world, 1.0)).position);
    if (!within_range(p)) return std::nullopt;
    return snapped(p);
}

std::optional<glm::dvec4> CasterSpace::light(const glm::dvec4& light_world) const {
    glm::dvec4 l(light_world - glm::dvec4(light_world.w * origin_world(), 0.0));
    if (!pose_.singular) l = glm::dvec4(glm::vec4(local_light(pose_, light_world).position));
    if (!within_range(glm::dvec3(l))) return std::nullopt;
    return glm::dvec4(snapped(glm::dvec3(l)), l.w);
}

Box<double> CasterSpace::box(const Box<float>& box_local) const {
    if (pose_.singular) return transformed(parent_from_local_, box_local);
    return {glm::dvec3(box_local.min), glm::dvec3(box_local.max)};
}

Corners CasterSpace::corners(const FaceTree::Triangle& face) const {
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = pose_.singular ? snapped(flattened_place(parent_from_local_, face[i]))
                                    : glm::dvec3(face[i]);
    }
    return corners;
}

int CasterSpace::facing(const Corners& face, const glm::dvec4& light) const {
    const auto& [a, b, c] = face;
    return pose_.singular ? flattened_facing(a, b, c, light) : orientation(a, b, c, light);
}

}  // namespace gnomon::shadows::internal
