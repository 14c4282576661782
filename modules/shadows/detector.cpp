// SPDX-License-Identifier: MIT
#include <gnomon/shadows/detector.hpp>

#include <algorithm>
#include <array>

#include "internal/strategies.hpp"

namespace gnomon::shadows {

void runs_of(std::span<const std::int8_t> weights, std::vector<FaceRun>& runs) {
    runs.clear();
    for (std::size_t begin = 0; begin < weights.size();) {
        const std::int8_t weight = weights[begin];
        std::size_t end = begin + 1;
        while (end < weights.size() && weights[end] == weight) ++end;
        if (weight != 0) {
            runs.push_back({static_cast<std::uint32_t>(begin),
                            static_cast<std::uint32_t>(end - begin), weight});
        }
        begin = end;
    }
}

void weights_of(std::span<const FaceRun> runs, std::span<std::int8_t> weights) {
    std::ranges::fill(weights, std::int8_t{0});
    for (const FaceRun& run : runs) {
        std::ranges::fill(weights.subspan(run.first, run.count),
                          static_cast<std::int8_t>(run.weight));
    }
}

std::size_t internal::memory_of(const Detection& detection) {
    return detection.casting.capacity() * sizeof(FaceRun) +
           detection.silhouette.capacity() * sizeof(SilhouetteEdge) +
           detection.solid_averted.capacity();
}

const Detection& internal::nothing_of(const ShadowMesh& mesh, Detection& detection) {
    detection.casting.clear();
    detection.silhouette.clear();
    detection.solid_averted.assign(mesh.components().size(), 0);
    detection.margin = 0.0;
    detection.changed = true;
    detection.stats = {};
    return detection;
}

std::span<const SilhouetteStrategy> silhouette_strategies() {
    static constexpr std::array<SilhouetteStrategy, 3> strategies{{
        {"brute_force", "every face and every edge, one by one, every time", false,
         internal::brute_force_detector},
        {"simd", "every face and every edge every time, many at once", false,
         internal::simd_detector},
        {"dual_bvh", "hierarchies of planes and of edges in dual space: for a light that jumps",
         false, internal::dual_bvh_detector},
    }};
    return strategies;
}

const SilhouetteStrategy* find_strategy(std::string_view name) {
    const auto strategies = silhouette_strategies();
    const auto found = std::ranges::find(strategies, name, &SilhouetteStrategy::name);
    return found == strategies.end() ? nullptr : &*found;
}

}  // namespace gnomon::shadows
