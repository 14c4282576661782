// SPDX-License-Identifier: MIT
#include "internal/casting.hpp"

#include <algorithm>
#include <limits>

namespace gnomon::shadows::internal {

namespace {

bool inside(const Component& component, const glm::vec3& p) {
    return glm::all(glm::greaterThanEqual(p, component.bounds_min)) &&
           glm::all(glm::lessThanEqual(p, component.bounds_max));
}

// How far a point may move and neither enter nor leave the box, nor reach its border from outside.
double distance_to_boundary(const Component& component, const glm::vec3& p) {
    const glm::dvec3 below = glm::dvec3(component.bounds_min) - glm::dvec3(p);
    const glm::dvec3 above = glm::dvec3(p) - glm::dvec3(component.bounds_max);
    const glm::dvec3 outside = glm::max(below, above);  // negative: how deep inside
    if (inside(component, p)) {
        return -std::max({outside.x, outside.y, outside.z}) * (1.0 - margin_slack);
    }
    return glm::length(glm::max(outside, glm::dvec3(0.0))) * (1.0 - margin_slack);
}

bool is_one_sided(const Component& component, LightLocal light) {
    return component.closed &&
           (light.is_directional() || !inside(component, glm::vec3(light.position)));
}

Casting casting_of(const Component& component, bool one_sided, NearCaps near_caps) {
    if (!one_sided) return {-1, 0, 1};
    // What is inside out is a hollow in a solid: its averted faces are those that the light meets
    // first, and they hide the hollow from the light whichever kind was asked for.
    if (component.inside_out || near_caps == NearCaps::Averted) return {-1, 0, 0};
    return {0, 0, 1};
}

}  // namespace

void find_castings(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps, Castings& castings,
                   std::vector<std::uint8_t>& solid_averted) {
    const auto components = mesh.components();
    castings.of_component.resize(components.size());
    castings.uniform = true;
    castings.margin = std::numeric_limits<double>::infinity();
    solid_averted.resize(components.size());
    for (std::size_t c = 0; c < components.size(); ++c) {
        const Component& component = components[c];
        const bool one_sided = is_one_sided(component, light);
        castings.of_component[c] = casting_of(component, one_sided, near_caps);
        castings.uniform = castings.uniform && castings.of_component[c] == castings.of_component[0];
        const bool solid = one_sided && !component.inside_out;
        solid_averted[c] = solid && near_caps == NearCaps::Averted ? 1 : 0;
        if (component.closed && !light.is_directional()) {
            castings.margin = std::min(castings.margin,
                                       distance_to_boundary(component, glm::vec3(light.position)));
        }
    }
}

}  // namespace gnomon::shadows::internal
