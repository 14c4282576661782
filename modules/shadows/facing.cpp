// SPDX-License-Identifier: MIT
#include <gnomon/shadows/facing.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <gnomon/shadows/orientation.hpp>

#include "internal/face_plane.hpp"

namespace gnomon::shadows {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double slack = 1e-9;  // so that a margin is never reached, whatever its arithmetic rounds

struct Side {
    int sign = 0;
    double distance = 0.0;  // a lower bound on how far the light is from the face's plane
};

// Double precision, then exact. Shewchuk, section 4.3: |error| <= (7 + 56 e) e permanent; 8 e
// covers the products of the permanent itself.
Side side_in_double(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, LightLocal light,
                    FacingStats& stats) {
    ++stats.double_tests;
    const glm::dvec3 origin(a);
    const glm::dvec3 e1 = glm::dvec3(b) - origin;
    const glm::dvec3 e2 = glm::dvec3(c) - origin;
    const glm::dvec3 l(light.position);
    const glm::dvec3 t = light.is_directional() ? l : l - origin;
    const glm::dvec3 n = glm::cross(e1, e2);
    const double s = glm::dot(n, t);
    glm::dvec3 minors;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        minors[i] = std::abs(e1[j] * e2[k]) + std::abs(e1[k] * e2[j]);
    }
    const double bound = 8.0 * 0x1p-53 * glm::dot(minors, glm::abs(t));
    if (std::abs(s) > bound) {
        // A sliver's exact normal may be longer than the computed one, by 5 e minors at most.
        const double longest = glm::length(n) + 5.0 * 0x1p-53 * glm::length(minors);
        return {s > 0.0 ? 1 : -1, (std::abs(s) - bound) / longest * (1.0 - slack)};
    }
    ++stats.exact_tests;
    return {exact_facing(a, b, c, light), 0.0};
}

bool inside(const Component& component, const glm::vec3& p) {
    return glm::all(glm::greaterThanEqual(p, component.bounds_min)) &&
           glm::all(glm::lessThanEqual(p, component.bounds_max));
}

// How far a point may move and neither enter nor leave the box, nor reach its border from outside.
double distance_to_boundary(const Component& component, const glm::vec3& p) {
    const glm::dvec3 below = glm::dvec3(component.bounds_min) - glm::dvec3(p);
    const glm::dvec3 above = glm::dvec3(p) - glm::dvec3(component.bounds_max);
    const glm::dvec3 outside = glm::max(below, above);  // negative: how deep inside
    if (inside(component, p)) return -std::max({outside.x, outside.y, outside.z}) * (1.0 - slack);
    return glm::length(glm::max(outside, glm::dvec3(0.0))) * (1.0 - slack);
}

}  // namespace

void classify_faces(const ShadowMesh& mesh, LightLocal light, Facing& out) {
    const auto faces = mesh.faces();
    const auto planes = mesh.planes();
    const auto positions = mesh.positions();
    const auto components = mesh.components();
    const auto face_components = mesh.face_components();
    const glm::vec3 l(light.position);
    const float w = light.position.w;
    const float l_sum = std::abs(l.x) + std::abs(l.y) + std::abs(l.z);

    out.stats = {};
    out.stats.faces = faces.size();
    out.weights.assign(faces.size(), 0);
    double margin = infinity;

    // What each component lets cast: bit 0 faces towards the light, bit 1 averted ones.
    std::vector<std::uint8_t> casting(components.size());
    for (std::size_t i = 0; i < components.size(); ++i) {
        const Component& component = components[i];
        const bool one_sided =
            component.closed && (light.is_directional() || !inside(component, l));
        casting[i] = static_cast<std::uint8_t>(!one_sided ? 3 : (component.inside_out ? 2 : 1));
        if (component.closed && !light.is_directional()) {
            margin = std::min(margin, distance_to_boundary(component, l));
        }
    }

    for (std::size_t f = 0; f < faces.size(); ++f) {
        const FacePlane& plane = planes[f];
        const float s =
            plane.normal.x * l.x + plane.normal.y * l.y + plane.normal.z * l.z + plane.offset * w;
        const float bound =
            plane.normal_error * l_sum + plane.offset_error * w + std::numeric_limits<float>::min();
        Side side;
        // Not-a-number and infinity (an overflow in single precision) must not pass the filter.
        if (std::abs(s) > bound && std::abs(s) < std::numeric_limits<float>::infinity()) {
            // The exact normal may be longer than the stored one, by its error at most.
            const double longest = glm::length(glm::dvec3(plane.normal)) + plane.normal_error;
            side = {s > 0.0F ? 1 : -1,
                    static_cast<double>(std::abs(s) - bound) / longest * (1.0 - 1e-6)};
        } else {
            if (internal::is_degenerate(plane)) continue;
            side = side_in_double(positions[faces[f][0]], positions[faces[f][1]],
                                  positions[faces[f][2]], light, out.stats);
        }
        margin = std::min(margin, side.distance);
        const unsigned mask = side.sign > 0 ? 1U : 2U;
        if (side.sign != 0 && (casting[face_components[f]] & mask) != 0) {
            out.weights[f] = static_cast<std::int8_t>(side.sign);
        }
    }
    if (light.is_directional()) {
        const double length = glm::length(glm::dvec3(l));
        margin = length > 0.0 ? margin / length : 0.0;
    }
    out.margin = std::max(0.0, margin);
}

void classify_faces_flattened(const ShadowMesh& mesh, const glm::dmat4& parent_from_local,
                              const glm::dvec4& light_parent, Facing& out) {
    const auto faces = mesh.faces();
    const auto positions = mesh.positions();
    const auto place = [&](std::uint32_t v) {
        return glm::dvec3(parent_from_local * glm::dvec4(glm::dvec3(positions[v]), 1.0));
    };
    out.stats = {};
    out.stats.faces = faces.size();
    out.stats.double_tests = faces.size();
    out.weights.assign(faces.size(), 0);
    out.margin = 0.0;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const glm::dvec3 a = place(faces[f][0]);
        const glm::dvec3 n = glm::cross(place(faces[f][1]) - a, place(faces[f][2]) - a);
        const glm::dvec3 t = glm::dvec3(light_parent) - light_parent.w * a;
        const double s = glm::dot(n, t);
        // The corners carry rounding of their own; nearly edge-on counts as edge-on. Whatever is
        // decided here, the volume is closed.
        const double bound = 1e-12 * glm::length(n) * glm::length(t);
        if (std::abs(s) > bound) out.weights[f] = s > 0.0 ? 1 : -1;
    }
}

}  // namespace gnomon::shadows
