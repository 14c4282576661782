// SPDX-License-Identifier: MIT
#include <gnomon/shadows/facing.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <span>

#include <gnomon/shadows/orientation.hpp>

#include "internal/face_filter.hpp"
#include "internal/face_plane.hpp"
#include "internal/finite.hpp"
#include "internal/flattened_facing.hpp"

namespace gnomon::shadows {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double slack = 1e-9;  // so that a margin is never reached, whatever its arithmetic rounds

struct Side {
    int sign = 0;
    double distance = 0.0;  // a lower bound on how far the light is from the face's plane
};

// Double precision, then exact. docs/numerics.md, "Facing", derives the bound.
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
    const double bound = 10.0 * 0x1p-53 * glm::dot(minors, glm::abs(t));
    if (std::abs(s) > bound) {
        // A sliver's exact normal may be longer than the computed one, by 5 e minors at most.
        const double longest = glm::length(n) + 5.0 * 0x1p-53 * glm::length(minors);
        return {s > 0.0 ? 1 : -1, (std::abs(s) - bound) / longest * (1.0 - slack)};
    }
    if (bound == 0.0) return {};  // nothing underflows here: every product has a factor of zero
    ++stats.exact_tests;
    return {exact_facing(a, b, c, light), 0.0};
}

// Gives every side that the filter left at 0 its sign. Returns how far the light is from the
// nearest of their planes, at least.
double decide_the_rest(const ShadowMesh& mesh, LightLocal light, Facing& out) {
    const auto faces = mesh.faces();
    const auto positions = mesh.positions();
    const std::span<std::int8_t> sides(out.weights);
    const auto next = [&](std::size_t from) {
        const void* found = std::memchr(sides.data() + from, 0, sides.size() - from);
        return found == nullptr ? sides.size()
                                : static_cast<std::size_t>(static_cast<const std::int8_t*>(found) -
                                                           sides.data());
    };
    double nearest = infinity;
    for (std::size_t f = 0; f < sides.size() && (f = next(f)) < sides.size(); ++f) {
        if (internal::is_degenerate(mesh.planes(), f)) continue;
        const Side side = side_in_double(positions[faces[f][0]], positions[faces[f][1]],
                                         positions[faces[f][2]], light, out.stats);
        sides[f] = static_cast<std::int8_t>(side.sign);
        nearest = std::min(nearest, side.distance);
    }
    return nearest;
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

// What the faces of a component weigh that are averted, edge-on and facing.
using Casting = std::array<std::int8_t, 3>;

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

// Turns sides into weights, in place.
void weigh(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps, Facing& out) {
    const std::span<std::int8_t> sides(out.weights);
    std::vector<Casting> castings;
    castings.reserve(mesh.components().size());
    out.solid_averted.clear();
    for (const Component& component : mesh.components()) {
        const bool one_sided = is_one_sided(component, light);
        castings.push_back(casting_of(component, one_sided, near_caps));
        const bool solid = one_sided && !component.inside_out;
        out.solid_averted.push_back(solid && near_caps == NearCaps::Averted ? 1 : 0);
    }
    const bool uniform = std::adjacent_find(castings.begin(), castings.end(),
                                            std::not_equal_to<>()) == castings.end();
    if (!uniform) {
        const auto face_components = mesh.face_components();
        for (std::size_t f = 0; f < sides.size(); ++f) {
            sides[f] = castings[face_components[f]][static_cast<std::size_t>(sides[f] + 1)];
        }
    } else if (!castings.empty() && castings[0] != Casting{-1, 0, 1}) {
        const auto [averted, edge_on, facing] = castings[0];
        for (std::int8_t& side : sides) side = side > 0 ? facing : (side < 0 ? averted : edge_on);
    }
}

}  // namespace

void classify_faces(const ShadowMesh& mesh, LightLocal light, Facing& out, NearCaps near_caps,
                    FacingFilter filter) {
    const glm::vec3 l(light.position);
    out.stats = {};
    out.stats.faces = mesh.faces().size();
    if (!internal::is_finite(l)) {
        out.weights.assign(mesh.faces().size(), 0);
        out.solid_averted.assign(mesh.components().size(), 0);
        out.margin = 0.0;
        return;
    }
    out.weights.resize(mesh.faces().size());
    const internal::FilterLight filtered = internal::filter_light(mesh.planes(), light);
    const float nearest = filter == FacingFilter::Simd
                              ? internal::filter_simd(mesh.planes(), filtered, out.weights)
                              : internal::filter_scalar(mesh.planes(), filtered, out.weights);
    double margin = static_cast<double>(nearest) * internal::plane_shrink;
    margin = std::min(margin, decide_the_rest(mesh, light, out));
    weigh(mesh, light, near_caps, out);

    if (light.is_directional()) {
        const double length = glm::length(glm::dvec3(l));
        margin = length > 0.0 ? margin / length : 0.0;
    } else {
        for (const Component& component : mesh.components()) {
            if (!component.closed) continue;
            margin = std::min(margin, distance_to_boundary(component, l));
        }
    }
    out.margin = std::max(0.0, margin);
}

void classify_faces_flattened(const ShadowMesh& mesh, const glm::dmat4& parent_from_local,
                              const glm::dvec4& light_parent, Facing& out) {
    const auto faces = mesh.faces();
    const auto positions = mesh.positions();
    const auto place = [&](std::uint32_t v) {
        return internal::flattened_place(parent_from_local, positions[v]);
    };
    out.stats = {};
    out.stats.faces = faces.size();
    out.stats.double_tests = faces.size();
    out.weights.assign(faces.size(), 0);
    out.solid_averted.assign(mesh.components().size(), 0);
    out.margin = 0.0;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const int side = internal::flattened_facing(place(faces[f][0]), place(faces[f][1]),
                                                    place(faces[f][2]), light_parent);
        out.weights[f] = static_cast<std::int8_t>(side);
    }
}

}  // namespace gnomon::shadows
