// SPDX-License-Identifier: MIT
#include <gnomon/shadows/edge_quads.hpp>

#include <algorithm>
#include <bit>
#include <limits>
#include <tuple>

#include "internal/face_filter.hpp"
#include "internal/finite.hpp"

namespace gnomon::shadows {

namespace {

// The metres between a point and a box, less what measuring them rounds; nullopt within it.
std::optional<double> metres_outside(const Component& component, const glm::dvec3& p) {
    const glm::dvec3 below = glm::dvec3(component.bounds_min) - p;
    const glm::dvec3 above = p - glm::dvec3(component.bounds_max);
    const glm::dvec3 outside = glm::max(glm::max(below, above), glm::dvec3(0.0));
    if (outside == glm::dvec3(0.0)) return std::nullopt;
    return glm::length(outside) * (1.0 - 1e-9);
}

struct CornerOf {
    bool forward;  // the casting faces run a -> b

    [[nodiscard]] std::uint32_t from(const EdgeQuad& e) const { return forward ? e.a : e.b; }
    [[nodiscard]] std::uint32_t to(const EdgeQuad& e) const { return forward ? e.b : e.a; }
};

}  // namespace

bool fits_edge_quads(const ShadowMesh& mesh) {
    const MeshReport& report = mesh.report();
    return report.closed() && report.boundary_edges == 0 && report.non_manifold_edges == 0 &&
           report.inconsistent_edges == 0 &&
           std::ranges::none_of(mesh.components(), &Component::inside_out);
}

std::vector<EdgeQuad> edge_quads(const ShadowMesh& mesh) {
    const auto positions = mesh.positions();
    std::vector<EdgeQuad> quads;
    quads.reserve(mesh.edges().size());
    for (const Edge& edge : mesh.edges()) {
        const auto uses = mesh.uses(edge);
        EdgeQuad quad{edge.low, edge.high, uses[0].face, uses[1].face};
        if (uses[0].sign() < 0) std::swap(quad.along, quad.back);
        const glm::vec3& low = positions[edge.low];
        const glm::vec3& high = positions[edge.high];
        if (std::tie(high.x, high.y, high.z) < std::tie(low.x, low.y, low.z)) {
            std::swap(quad.a, quad.b);
            std::swap(quad.along, quad.back);
        }
        quads.push_back(quad);
    }
    return quads;
}

FaceBits face_bits(std::span<const std::int8_t> weights) {
    FaceBits bits((weights.size() + 31) / 32, 0);
    for (std::size_t f = 0; f < weights.size(); ++f) {
        bits[f / 32] |= (weights[f] != 0 ? 1U : 0U) << (f % 32);
    }
    return bits;
}

glm::vec4 light_of_planes(const ShadowMesh& mesh, LightLocal light) {
    const internal::FilterLight filtered = internal::filter_light(mesh.planes(), light);
    return {filtered.towards, filtered.w};
}

FaceBits face_bits_in_single_precision(const ShadowMesh& mesh, LightLocal light,
                                       NearCaps near_caps) {
    const FacePlanes& planes = mesh.planes();
    const glm::vec4 l = light_of_planes(mesh, light);
    FaceBits bits((mesh.faces().size() + 31) / 32, 0);
    for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
        const float side = planes.normal_x[f] * l.x + planes.normal_y[f] * l.y +
                           planes.normal_z[f] * l.z + planes.offset[f] * l.w;
        const bool casts = near_caps == NearCaps::Averted ? side < 0.0F : side > 0.0F;
        bits[f / 32] |= (casts ? 1U : 0U) << (f % 32);
    }
    return bits;
}

std::optional<double> one_sided_margin(const ShadowMesh& mesh, LightLocal light) {
    const glm::vec3 l(light.position);
    if (!internal::is_finite(l)) return std::nullopt;
    double margin = std::numeric_limits<double>::infinity();
    if (light.is_directional()) return margin;
    for (const Component& component : mesh.components()) {
        const std::optional<double> metres = metres_outside(component, glm::dvec3(l));
        if (!metres) return std::nullopt;
        margin = std::min(margin, *metres);
    }
    return margin;
}

std::uint32_t quad_layer_bound(const ShadowMesh& mesh, const QuadCasting& casting) {
    const auto faces = static_cast<std::uint32_t>(mesh.faces().size());
    if (casting.bits == nullptr) return faces / 2;
    std::uint32_t cast = 0;
    for (const std::uint32_t word : *casting.bits) {
        cast += static_cast<std::uint32_t>(std::popcount(word));
    }
    return std::min(cast, faces - cast);
}

QuadRanges quad_ranges(const ShadowMesh& mesh, bool one_far_point) {
    const auto edges = static_cast<std::uint32_t>(mesh.edges().size());
    const auto faces = static_cast<std::uint32_t>(mesh.faces().size());
    QuadRanges ranges;
    ranges.side_vertices = one_far_point ? 3 : 6;
    ranges.sides = {0, edges * ranges.side_vertices};
    ranges.near_cap = {ranges.sides.count, 3 * faces};
    ranges.far_cap = {ranges.near_cap.first + ranges.near_cap.count, one_far_point ? 0 : 3 * faces};
    return ranges;
}

std::optional<std::uint32_t> quad_vertex(const ShadowMesh& mesh, std::span<const EdgeQuad> quads,
                                         const QuadRanges& ranges,
                                         std::span<const std::uint32_t> bits, NearCaps near_caps,
                                         std::uint32_t vertex) {
    const bool averted = near_caps == NearCaps::Averted;
    const auto near = [](std::uint32_t v) { return 2 * v; };
    const auto far = [](std::uint32_t v) { return 2 * v + 1; };
    if (vertex < ranges.near_cap.first) {
        const EdgeQuad& edge = quads[vertex / ranges.side_vertices];
        const bool along = casts(bits, edge.along);
        if (along == casts(bits, edge.back)) return std::nullopt;
        const CornerOf corner{along != averted};
        switch (vertex % ranges.side_vertices) {
            case 0: return near(corner.to(edge));
            case 1: return near(corner.from(edge));
            case 2: return far(ranges.side_vertices == 3 ? corner.from(edge) : edge.b);
            case 3: return near(edge.a);
            case 4: return far(corner.from(edge));
            default: return far(corner.to(edge));
        }
    }
    const bool is_far = vertex >= ranges.near_cap.first + ranges.near_cap.count;
    const std::uint32_t in_cap = vertex - (is_far ? ranges.far_cap.first : ranges.near_cap.first);
    const std::uint32_t face = in_cap / 3;
    if (!casts(bits, face)) return std::nullopt;
    const std::uint32_t corner = in_cap % 3;
    if (!is_far) return near(mesh.faces()[face][corner]);
    return far(mesh.faces()[face][averted ? corner : 2 - corner]);
}

Volume quad_volume(const ShadowMesh& mesh, std::span<const std::uint32_t> bits, NearCaps near_caps,
                   bool one_far_point) {
    const std::vector<EdgeQuad> quads = edge_quads(mesh);
    const QuadRanges ranges = quad_ranges(mesh, one_far_point);
    Volume volume;
    const auto append = [&](const IndexRange& range) {
        const std::size_t first = volume.indices.size();
        for (std::uint32_t v = range.first; v < range.first + range.count; ++v) {
            if (const auto index = quad_vertex(mesh, quads, ranges, bits, near_caps, v)) {
                volume.indices.push_back(*index);
            }
        }
        return IndexRange{static_cast<std::uint32_t>(first),
                          static_cast<std::uint32_t>(volume.indices.size() - first)};
    };
    volume.made_with = {
        .directional = one_far_point,
        .far_vertices = one_far_point ? FarVertices::AtInfinity : FarVertices::Finite,
        .caps = CapOptions::plain()};
    volume.far_cap = append(ranges.far_cap);
    volume.sides = append(ranges.sides);
    volume.silhouette_edges = volume.sides.count / ranges.side_vertices;
    CapList& caps = near_caps == NearCaps::Averted ? volume.near_cap_averted : volume.near_cap;
    caps.triples = append(ranges.near_cap);
    caps.faces = caps.triples.count / 3;
    return volume;
}

}  // namespace gnomon::shadows
