// SPDX-License-Identifier: MIT
#include "motion.hpp"

#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

namespace gnomon::bench {

namespace {

const glm::dvec3 orbit_axis = glm::normalize(glm::dvec3(0.3, 1.0, 0.2));
const glm::dvec3 orbit_start = glm::normalize(glm::dvec3(0.8, 0.5, -0.4));

// Directions far apart, one after the other, and never the same twice: the golden spiral.
glm::dvec3 jump(std::uint64_t frame) {
    const auto step = static_cast<double>(frame);
    const double height = 1.0 - 2.0 * std::fmod(0.5 + 0.754877666 * step, 1.0);
    const double angle = 2.0 * std::numbers::pi * std::fmod(0.569840291 * step, 1.0);
    const double ring = std::sqrt(1.0 - height * height);
    return {ring * std::cos(angle), height, ring * std::sin(angle)};
}

glm::dvec3 turned(const glm::dvec3& direction, double angle_rad) {
    return glm::dvec3(glm::rotate(glm::dmat4(1.0), angle_rad, orbit_axis) *
                      glm::dvec4(direction, 0.0));
}

}  // namespace

std::vector<Motion> motions(bool quick) {
    using Kind = Motion::Kind;
    std::vector<Motion> result;
    for (const bool directional : {false, true}) {
        result.push_back({"static", Kind::Static, 0.0, directional});
        result.push_back({"0.001 deg", Kind::Orbit, 0.001, directional});
        result.push_back({"0.01 deg", Kind::Orbit, 0.01, directional});
        result.push_back({"0.1 deg", Kind::Orbit, 0.1, directional});
        result.push_back({"1 deg", Kind::Orbit, 1.0, directional});
        result.push_back({"turn 0.1 deg", Kind::Turn, 0.1, directional});
        result.push_back({"jump", Kind::Jump, 0.0, directional});
    }
    if (quick) return {result[0], result[6], result[10]};
    return result;
}

shadows::LightLocal light_of(const Motion& motion, const Sphere& about, std::uint64_t frame) {
    const double angle = glm::radians(motion.degrees) * static_cast<double>(frame);
    glm::dvec3 direction = orbit_start;
    if (motion.kind == Motion::Kind::Jump) direction = jump(frame);
    if (motion.kind == Motion::Kind::Orbit) direction = turned(orbit_start, angle);
    if (motion.kind == Motion::Kind::Turn) {
        const glm::dmat4 world_from_local =
            glm::rotate(glm::translate(glm::dmat4(1.0), about.center), angle, orbit_axis);
        const glm::dmat4 local_from_world = glm::inverse(world_from_local);
        direction = glm::dvec3(local_from_world * glm::dvec4(orbit_start, 0.0));
    }
    if (motion.directional) return {glm::vec4(direction, 0.0)};
    return {glm::vec4(about.center + 3.0 * about.radius * direction, 1.0)};
}

}  // namespace gnomon::bench
