// SPDX-License-Identifier: MIT
#include <gnomon/shadows/detector.hpp>

#include <algorithm>
#include <array>
#include <bit>

#include <gnomon/core/expects.hpp>

#include "internal/strategies.hpp"

namespace gnomon::shadows {

namespace {

class RunWriter {
public:
    explicit RunWriter(std::vector<FaceRun>& runs) : runs_(runs) { runs_.clear(); }

    void add(std::size_t first, std::size_t count, std::int32_t weight) {
        if (weight == 0) return;
        if (!runs_.empty() && runs_.back().weight == weight &&
            std::size_t{runs_.back().first} + runs_.back().count == first) {
            runs_.back().count += static_cast<std::uint32_t>(count);
            return;
        }
        runs_.push_back(
            {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count), weight});
    }

private:
    std::vector<FaceRun>& runs_;
};

}  // namespace

void pack_weights(std::span<const std::int8_t> weights, CastingFaces& casting) {
    casting.plus.assign((weights.size() + 63) / 64, 0);
    casting.minus.assign((weights.size() + 63) / 64, 0);
    for (std::size_t f = 0; f < weights.size(); ++f) {
        GNOMON_EXPECTS(weights[f] >= -1 && weights[f] <= 1);
        casting.plus[f / 64] |= std::uint64_t{weights[f] > 0} << (f % 64);
        casting.minus[f / 64] |= std::uint64_t{weights[f] < 0} << (f % 64);
    }
}

void runs_of(const CastingFaces& casting, std::vector<FaceRun>& runs) {
    RunWriter writer(runs);
    const std::size_t words = casting.plus.size();
    for (std::size_t word = 0; word < words;) {
        const std::uint64_t plus = casting.plus[word];
        const std::uint64_t minus = casting.minus[word];
        if (plus + 1 <= 1 && minus + 1 <= 1) {
            // Words that are all alike.
            std::size_t end = word + 1;
            while (end < words && casting.plus[end] == plus && casting.minus[end] == minus) ++end;
            writer.add(64 * word, 64 * (end - word), plus != 0 ? 1 : (minus != 0 ? -1 : 0));
            word = end;
            continue;
        }
        for (std::size_t i = 0; i < 64;) {
            const bool in_plus = ((plus >> i) & 1U) != 0;
            const bool in_minus = ((minus >> i) & 1U) != 0;
            const std::uint64_t same = in_plus ? plus : (in_minus ? minus : ~(plus | minus));
            const auto length =
                std::min<std::size_t>(64 - i, static_cast<std::size_t>(std::countr_one(same >> i)));
            writer.add(64 * word + i, length, in_plus ? 1 : (in_minus ? -1 : 0));
            i += length;
        }
        ++word;
    }
}

void runs_of(std::span<const std::int8_t> weights, std::vector<FaceRun>& runs) {
    RunWriter writer(runs);
    for (std::size_t f = 0; f < weights.size(); ++f) writer.add(f, 1, weights[f]);
}

void weights_of(std::span<const FaceRun> runs, std::span<std::int8_t> weights) {
    std::ranges::fill(weights, std::int8_t{0});
    for (const FaceRun& run : runs) {
        std::ranges::fill(weights.subspan(run.first, run.count),
                          static_cast<std::int8_t>(run.weight));
    }
}

std::string_view to_string(Choice choice) {
    switch (choice) {
        case Choice::ByName: return "by name";
        case Choice::FewFaces: return "few faces";
        case Choice::LargeSilhouette: return "large silhouette";
        case Choice::Deforming: return "deforming";
        case Choice::Jump: return "jump";
        case Choice::SmallStep: return "small step";
    }
    return "";
}

std::size_t internal::memory_of(const Detection& detection) {
    return (detection.casting.plus.capacity() + detection.casting.minus.capacity()) *
               sizeof(std::uint64_t) +
           detection.silhouette.capacity() * sizeof(SilhouetteEdge) +
           detection.solid_averted.capacity();
}

const Detection& internal::nothing_of(const ShadowMesh& mesh, Detection& detection) {
    detection.casting.plus.assign((mesh.faces().size() + 63) / 64, 0);
    detection.casting.minus.assign((mesh.faces().size() + 63) / 64, 0);
    detection.silhouette.clear();
    detection.solid_averted.assign(mesh.components().size(), 0);
    detection.margin = 0.0;
    detection.changed = true;
    detection.stats = {};
    return detection;
}

std::span<const SilhouetteStrategy> silhouette_strategies() {
    static constexpr auto strategies = std::to_array<SilhouetteStrategy>({
        {"brute_force", "every face and every edge, one by one, every time", false,
         internal::brute_force_detector},
        {"simd", "every face and every edge every time, many at once", false,
         internal::simd_detector},
        {"dual_bvh", "hierarchies of planes and of edges in dual space: for a light that jumps",
         false, internal::dual_bvh_detector},
        {"certificates", "looks at a face again when the light has travelled its margin", true,
         internal::certificates_detector},
        {"edge_stack",
         "edges of casting faces cancel in a hash table (Kwoon's triangular algorithm)", false,
         internal::edge_stack_detector},
        {"edge_stack_naive", "the same with a search through the stack: quadratic, for comparison",
         false, internal::edge_stack_naive_detector},
        {"vnv", "edges between visible and non-visible polygons; none within a flat polygon", true,
         internal::vnv_detector},
        {"edge_list", "one pass over an edge list made in two (Lengyel)", true,
         internal::edge_list_detector},
        {"hextree", "a tree of 16 children a node over edges between dual planes, four deep", true,
         internal::hextree_detector},
        {"gpu_quads",
         "closed casters: degenerate quads on all edges, facing uploaded; others: simd", false,
         internal::simd_detector, QuadFacing::Uploaded},
        {"gpu_quads_float",
         "the same, but facing is decided in the vertex shader, in single precision", false,
         internal::simd_detector, QuadFacing::InShader},
    });
    return strategies;
}

const SilhouetteStrategy& automatic_strategy() {
    static constexpr SilhouetteStrategy automatic{"auto", "chosen for each pair and frame", true,
                                                  internal::automatic_detector};
    return automatic;
}

const SilhouetteStrategy* find_strategy(std::string_view name) {
    if (name == automatic_strategy().name) return &automatic_strategy();
    const auto strategies = silhouette_strategies();
    const auto found = std::ranges::find(strategies, name, &SilhouetteStrategy::name);
    return found == strategies.end() ? nullptr : &*found;
}

}  // namespace gnomon::shadows
