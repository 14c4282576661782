// SPDX-License-Identifier: MIT
//
// A light brought into a caster's own space in double precision, with a bound on what rounding may
// have done to it.
#pragma once

#include <cmath>

#include <glm/glm.hpp>
#include <glm/gtc/matrix_access.hpp>

namespace gnomon::shadows::internal {

/// A caster's affine pose, taken apart once.
struct Pose {
    glm::dmat4 world_from_local{1.0};
    glm::dmat3 local_from_world{1.0};  ///< linear part; meaningless where singular
    bool finite = true;
    bool singular = false;
    bool mirrored = false;
};

inline double frobenius(const glm::dmat3& m) {
    return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

inline Pose make_pose(const glm::dmat4& world_from_local) {
    Pose pose;
    pose.world_from_local = world_from_local;
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r)
            pose.finite = pose.finite && std::isfinite(world_from_local[c][r]);
    }
    const glm::dmat3 linear(world_from_local);
    const double det = glm::determinant(linear);
    // Relative to the axes' lengths, so that a uniformly tiny scale is not taken for a flat one.
    const double volume = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
    pose.singular = !(std::abs(det) > 1e-12 * volume);
    if (!pose.singular) {
        pose.local_from_world = glm::inverse(linear);
        // A caster all but flat is taken for a flat one: its local light would leave the range of
        // single precision, or, where it is flat across its own axes (a squashed parent), be
        // rounded by a large part of the light's distance: by 2^-24 times `askew`.
        double columns = 0.0;  // of local_from_world, with linear's columns taken to unit length
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 row(glm::row(pose.local_from_world, i));
            columns += glm::dot(row, row) * glm::dot(linear[i], linear[i]);
        }
        const double askew = std::sqrt(3.0 * columns);
        const double uneven = frobenius(linear) * frobenius(pose.local_from_world);
        pose.singular = !(uneven < 1e12 && askew < 1e3);
    }
    pose.mirrored = det < 0.0 && !pose.singular;
    return pose;
}

struct LocalLight {
    glm::dvec4 position{0.0};
    double rounding_m = 0.0;  ///< of the world: two poses that mean the same light differ by less
};

/// The pose must not be singular. The bound allows for the host's own composition of poses in
/// double precision (a few units in the last place of the coordinates it composed) and for the
/// arithmetic here. It is one of the world: in the caster's space an uneven scale would stretch it
/// to metres.
inline LocalLight local_light(const Pose& pose, const glm::dvec4& light_world) {
    constexpr double unit = 0x1p-52;
    const glm::dmat3 linear(pose.world_from_local);
    const glm::dvec3 origin(pose.world_from_local[3]);
    const glm::dvec3 towards = glm::dvec3(light_world) - light_world.w * origin;
    glm::dvec3 local = pose.local_from_world * towards;
    local += pose.local_from_world * (towards - linear * local);  // the inverse itself was rounded
    const double magnitude =
        glm::length(glm::dvec3(light_world)) + std::abs(light_world.w) * glm::length(origin) +
        glm::length(linear[0]) * std::abs(local.x) + glm::length(linear[1]) * std::abs(local.y) +
        glm::length(linear[2]) * std::abs(local.z);
    return {glm::dvec4(local, light_world.w), 32.0 * unit * magnitude};
}

/// Whether the light is where it was, but for what composing the poses rounds.
inline bool indistinguishable(const Pose& pose, const LocalLight& now, const glm::dvec4& before) {
    const glm::dvec3 moved(now.position - before);
    return glm::length(glm::dmat3(pose.world_from_local) * moved) <= now.rounding_m;
}

}  // namespace gnomon::shadows::internal
