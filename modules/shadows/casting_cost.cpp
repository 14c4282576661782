// SPDX-License-Identifier: MIT
#include <gnomon/shadows/casting_cost.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <span>

#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/layer_bound.hpp>
#include <gnomon/shadows/silhouette.hpp>
#include <gnomon/shadows/volume.hpp>

namespace gnomon::shadows {

namespace {

/// The volumes of all components for one choice of weights. Components meet in vertices at most, so
/// every edge belongs to one.
void measure(const ShadowMesh& mesh, std::span<const std::int8_t> weights,
             std::vector<VolumeSize>& sizes) {
    sizes.assign(mesh.components().size(), {});
    const auto component_of = mesh.face_components();
    for (std::size_t f = 0; f < weights.size(); ++f) {
        sizes[component_of[f]].cap_triangles += static_cast<std::uint64_t>(std::abs(weights[f]));
    }
    for (const Edge& edge : mesh.edges()) {
        std::int32_t count = 0;
        const auto uses = mesh.uses(edge);
        for (const FaceUse& use : uses) count += use.sign() * weights[use.face];
        if (count == 0) continue;
        VolumeSize& size = sizes[component_of[uses.front().face]];
        ++size.silhouette_edges;
        size.side_quads += static_cast<std::uint64_t>(std::abs(count));
    }
}

void add(CastingCost& cost, const VolumeSize& size) {
    cost.total += size;
    VolumeSize& largest = cost.largest;
    largest.silhouette_edges = std::max(largest.silhouette_edges, size.silhouette_edges);
    largest.side_quads = std::max(largest.side_quads, size.side_quads);
    largest.cap_triangles = std::max(largest.cap_triangles, size.cap_triangles);
    cost.largest_index_bytes = std::max(cost.largest_index_bytes, size.index_bytes());
}

}  // namespace

std::array<glm::vec3, sample_direction_count> sample_directions() {
    constexpr std::size_t half = sample_direction_count / 2;
    const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
    std::array<glm::vec3, sample_direction_count> directions;
    for (std::size_t i = 0; i < half; ++i) {
        const double y = (static_cast<double>(i) + 0.5) / half;
        const double radius = std::sqrt(1.0 - y * y);
        const double angle = golden_angle * (static_cast<double>(i) + 0.5);
        directions[2 * i] =
            glm::vec3(glm::dvec3(radius * std::cos(angle), y, radius * std::sin(angle)));
        directions[2 * i + 1] = -directions[2 * i];
    }
    return directions;
}

VolumeSize& VolumeSize::operator+=(const VolumeSize& other) {
    silhouette_edges += other.silhouette_edges;
    side_quads += other.side_quads;
    cap_triangles += other.cap_triangles;
    return *this;
}

MeshCost measure_cost(const ShadowMesh& mesh) {
    MeshCost cost;
    cost.components.resize(mesh.components().size());
    std::vector<VolumeSize> sizes;
    const auto add_all = [&](std::span<const std::int8_t> weights, CastingCost CasterCost::*which) {
        measure(mesh, weights, sizes);
        VolumeSize whole;
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            add(cost.components[i].*which, sizes[i]);
            whole += sizes[i];
        }
        add(cost.mesh.*which, whole);
    };

    std::vector<SilhouetteEdge> silhouette;
    Volume volume;
    const auto add_as_it_casts = [&](const Facing& facing, const glm::vec3& direction) {
        add_all(facing.weights, &CasterCost::as_it_casts);
        find_silhouette(mesh, facing.weights, silhouette);
        build_volume(mesh, facing.weights, silhouette, true, FarVertices::AtInfinity, volume);
        const LayerSpace space{.light = glm::dvec4(glm::dvec3(direction), 0.0)};
        cost.most_layers = std::max(cost.most_layers, layer_bound(mesh, volume, space));
    };

    const auto directions = sample_directions();
    Facing facing;
    Facing opposite;
    for (std::size_t i = 0; i < directions.size(); i += 2) {
        classify_faces(mesh, {glm::vec4(directions[i], 0.0F)}, facing);
        classify_faces(mesh, {glm::vec4(directions[i + 1], 0.0F)}, opposite);
        add_as_it_casts(facing, directions[i]);
        add_as_it_casts(opposite, directions[i + 1]);
        // Where one side casts, the other side is what casts for the opposite light; so the two
        // together are two-sided. Where both do, the opposite light has every weight's opposite.
        for (std::size_t f = 0; f < facing.weights.size(); ++f) {
            if (facing.weights[f] != 0) continue;
            facing.weights[f] = static_cast<std::int8_t>(-opposite.weights[f]);
        }
        add_all(facing.weights, &CasterCost::two_sided);
        for (std::int8_t& weight : facing.weights) weight = static_cast<std::int8_t>(-weight);
        add_all(facing.weights, &CasterCost::two_sided);
    }
    return cost;
}

}  // namespace gnomon::shadows
