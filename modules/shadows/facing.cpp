// SPDX-License-Identifier: MIT
#include <gnomon/shadows/facing.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "internal/casting.hpp"
#include "internal/face_filter.hpp"
#include "internal/face_plane.hpp"
#include "internal/finite.hpp"
#include "internal/flattened_facing.hpp"
#include "internal/side_test.hpp"

namespace gnomon::shadows {

using internal::Casting;
using internal::Castings;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

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
        const internal::Side side = internal::test_side(
            positions[faces[f][0]], positions[faces[f][1]], positions[faces[f][2]], light);
        ++out.stats.double_tests;
        out.stats.exact_tests += side.was_exact ? 1 : 0;
        sides[f] = static_cast<std::int8_t>(side.sign);
        nearest = std::min(nearest, side.distance);
    }
    return nearest;
}

// Turns sides into weights, in place.
void weigh(const ShadowMesh& mesh, const Castings& castings, std::span<std::int8_t> sides) {
    if (!castings.uniform) {
        const auto face_components = mesh.face_components();
        for (std::size_t f = 0; f < sides.size(); ++f) {
            sides[f] =
                castings.of_component[face_components[f]][static_cast<std::size_t>(sides[f] + 1)];
        }
    } else if (!castings.of_component.empty() && castings.of_component[0] != Casting{-1, 0, 1}) {
        const auto [averted, edge_on, facing] = castings.of_component[0];
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
    Castings castings;
    internal::find_castings(mesh, light, near_caps, castings, out.solid_averted);
    weigh(mesh, castings, out.weights);

    if (light.is_directional()) {
        const double length = glm::length(glm::dvec3(l));
        margin = length > 0.0 ? margin / length : 0.0;
    }
    margin = std::min(margin, castings.margin);
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
