// SPDX-License-Identifier: MIT
//
// What a mesh costs as a caster: the size of its volumes, measured for a fixed set of distant
// lights. For tools and reports; a frame's own figures are in FrameStats.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/shadow_mesh.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// The lights that costs are measured for: unit vectors towards them, spread evenly over the sphere
/// (a Fibonacci lattice on one half, and the opposites, so that direction 2i + 1 is -(2i)). None
/// lies in a plane of two axes, where boxes would look cheaper than they are.
inline constexpr std::size_t sample_direction_count = 64;
/// The directions themselves. Cost: some microseconds.
[[nodiscard]] std::array<glm::vec3, sample_direction_count> sample_directions();

/// The volume of one light. Sums over components.
struct VolumeSize {
    std::uint64_t silhouette_edges = 0;  ///< each once
    std::uint64_t side_quads = 0;        ///< the edges, each as often as it counts
    std::uint64_t cap_triangles = 0;     ///< of the near cap; the far cap has as many

    /// Of a point light's volume with both caps, which is the largest there is.
    [[nodiscard]] std::uint64_t index_bytes() const {
        return sizeof(std::uint32_t) * 6 * (side_quads + cap_triangles);
    }
    /// Adds up, figure by figure.
    VolumeSize& operator+=(const VolumeSize& other);
    bool operator==(const VolumeSize&) const = default;
};

/// Over all sample directions.
struct CastingCost {
    VolumeSize total;    ///< the sum; its figures over sample_direction_count are the means
    VolumeSize largest;  ///< each figure by itself: they need not be of one direction
    std::uint64_t largest_index_bytes = 0;  ///< of the largest volume

    /// Of a figure of `total`.
    [[nodiscard]] static double mean(std::uint64_t total) {
        return static_cast<double>(total) / sample_direction_count;
    }
};

/// A mesh's or a component's.
struct CasterCost {
    CastingCost as_it_casts;  ///< with the light outside the bounds
    CastingCost two_sided;    ///< as every part casts with the light within its bounds
};

/// What a mesh costs as a caster.
struct MeshCost {
    CasterCost mesh;  ///< all components together
    /// The largest layer_bound() (layer_bound.hpp) of its volumes, as it casts. More than 255 are
    /// counted in batches.
    std::uint32_t most_layers = 0;
    std::vector<CasterCost> components;  ///< in the order of ShadowMesh::components()
};

/// Exact, for these directions. Cost: sample_direction_count detections and volumes; some 0.1 us a
/// triangle and direction.
[[nodiscard]] MeshCost measure_cost(const ShadowMesh& mesh);

}  // namespace gnomon::shadows
#pragma GCC visibility pop
