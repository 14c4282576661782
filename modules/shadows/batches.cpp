// SPDX-License-Identifier: MIT
#include "internal/batches.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <gnomon/shadows/layer_bound.hpp>

#include "internal/footprint.hpp"

namespace gnomon::shadows::internal {

namespace {

// A bit of the stencil remembers what earlier batches left.
constexpr std::uint32_t most_a_batch = 127;

LayerSpace space_of(const DrawnPair& drawn, const LightState& light) {
    if (!drawn.pair->flattened) return {glm::dmat4(1.0), glm::dvec4(drawn.pair->current.position)};
    return {drawn.bounds.world_from_local, light.light.position_world};
}

std::vector<std::uint64_t> revisions_of(const LightState& light, std::span<const DrawnPair> pairs) {
    std::vector<std::uint64_t> revisions{light.revision};
    for (const DrawnPair& drawn : pairs) {
        revisions.push_back(drawn.pair->volume_revision);
        revisions.push_back(drawn.pair->pose_revision);
    }
    return revisions;
}

class Batching {
public:
    Batching(const LightState& light, std::span<const DrawnPair> pairs)
        : light_(light), pairs_(pairs) {
        for (const DrawnPair& drawn : pairs) {
            PairState& pair = *drawn.pair;
            if (pair.layers.known == Layers::Known::Nothing) {
                const bool from_outside = seen_from_outside(*pair.mesh, space_of(drawn, light));
                pair.layers = {Layers::Known::QuickBound,
                               quick_layer_bound(*pair.volume, from_outside)};
            }
        }
    }

    [[nodiscard]] std::uint64_t sum() const {
        std::uint64_t total = 0;
        for (const DrawnPair& drawn : pairs_) total += drawn.pair->layers.most;
        return total;
    }
    [[nodiscard]] std::uint64_t most_together() {
        footprints_.clear();
        for (const DrawnPair& drawn : pairs_) append(drawn, drawn.pair->layers.most);
        return most_layers(footprints_);
    }
    void refine();
    /// Replaces volumes of more layers by their parts, and puts draws into an order in which
    /// neighbours seldom cover each other.
    void make_pieces(std::uint32_t limit, std::vector<VolumeDraw>& draws);
    /// The number of a batch for each piece, ascending.
    [[nodiscard]] std::vector<std::uint32_t> distribute(std::uint32_t limit);
    void assign(std::span<const std::uint32_t> batches, std::vector<VolumeDraw>& draws);

private:
    struct Piece {
        const DrawnPair* drawn = nullptr;
        std::uint32_t layers = 0;
        std::uint32_t part = 0;  // of its pair
        double distance = 0.0;   // from the light to the caster, or along its way
        VolumeDraw draw;
    };
    void add_piece(const DrawnPair& drawn, std::uint32_t part, std::uint32_t layers,
                   VolumeDraw draw);

    void append(const DrawnPair& drawn, std::uint32_t layers) {
        append_footprints(drawn.bounds, light_.light.position_world, layers, footprints_);
    }
    [[nodiscard]] bool fits(std::size_t begin, std::size_t end, std::uint32_t limit) {
        footprints_.clear();
        for (std::size_t i = begin; i < end; ++i) append(*pieces_[i].drawn, pieces_[i].layers);
        return most_layers(footprints_) <= limit;
    }

    const LightState& light_;
    std::span<const DrawnPair> pairs_;
    std::vector<Piece> pieces_;
    std::vector<Footprint> footprints_;
};

void Batching::refine() {
    for (const DrawnPair& drawn : pairs_) {
        PairState& pair = *drawn.pair;
        if (pair.layers.known == Layers::Known::Bound || pair.layers.most <= 1) continue;
        pair.layers = {Layers::Known::Bound,
                       layer_bound(*pair.mesh, *pair.volume, space_of(drawn, light_))};
    }
}

void Batching::add_piece(const DrawnPair& drawn, std::uint32_t part, std::uint32_t layers,
                         VolumeDraw draw) {
    const auto corners = corners_of(drawn.bounds);
    const glm::dvec3 center = 0.5 * corners[0] + 0.5 * corners[7];
    const glm::dvec4& light = light_.light.position_world;
    const double distance = light.w == 0.0 ? -glm::dot(center, glm::dvec3(light))
                                           : glm::length(center - glm::dvec3(light));
    // What is no number would not sort.
    pieces_.push_back(
        {&drawn, layers, part, std::isfinite(distance) ? distance : 0.0, std::move(draw)});
}

void Batching::make_pieces(std::uint32_t limit, std::vector<VolumeDraw>& draws) {
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
        const DrawnPair& drawn = pairs_[i];
        PairState& pair = *drawn.pair;
        if (pair.layers.most <= limit) {
            add_piece(drawn, 0, pair.layers.most, std::move(draws[i]));
            continue;
        }
        if (pair.layers.parts.empty()) {
            for (LayerPart& part : split_volume(*pair.mesh, *pair.volume, space_of(drawn, light_),
                                                pair.far_vertices, limit)) {
                pair.layers.parts.push_back({std::make_shared<const Volume>(std::move(part.volume)),
                                             next_volume_revision(), part.layers});
            }
        }
        for (std::uint32_t p = 0; p < pair.layers.parts.size(); ++p) {
            const Layers::Part& part = pair.layers.parts[p];
            VolumeDraw draw = draws[i];
            draw.volume = part.volume;
            draw.revision = part.revision;
            add_piece(drawn, p, part.layers, std::move(draw));
        }
    }
    std::stable_sort(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) {
        return std::tie(a.part, a.distance) < std::tie(b.part, b.distance);
    });
}

void Batching::assign(std::span<const std::uint32_t> batches, std::vector<VolumeDraw>& draws) {
    draws.clear();
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        draws.push_back(std::move(pieces_[i].draw));
        draws.back().batch = batches[i];
    }
}

// As many as fit into each batch, one after the other.
std::vector<std::uint32_t> Batching::distribute(std::uint32_t limit) {
    std::vector<std::uint32_t> batches(pieces_.size());
    std::uint32_t batch = 0;
    for (std::size_t begin = 0; begin < pieces_.size(); ++batch) {
        std::size_t end = begin + 1;
        std::size_t step = 1;
        for (; end + step <= pieces_.size() && fits(begin, end + step, limit); step *= 2) {
            end += step;
        }
        for (; step > 0; step /= 2) {
            if (end + step <= pieces_.size() && fits(begin, end + step, limit)) end += step;
        }
        for (; begin < end; ++begin) batches[begin] = batch;
    }
    return batches;
}

}  // namespace

std::uint32_t split_into_batches(LightState& light, std::uint32_t limit,
                                 std::span<const DrawnPair> pairs, std::vector<VolumeDraw>& draws) {
    if (pairs.empty()) return 0;
    Batching batching(light, pairs);
    if (batching.sum() <= limit) return 1;

    LayerMemory& memory = light.layers;
    auto revisions = revisions_of(light, pairs);
    const bool unchanged = revisions == memory.revisions;
    if (!unchanged) {
        memory = {std::move(revisions), {}};
        if (batching.most_together() <= limit) return 1;
        batching.refine();
        if (batching.most_together() <= limit) return 1;
    } else if (memory.batches.empty()) {
        return 1;
    }
    const std::uint32_t limit_a_batch = std::min(limit, most_a_batch);
    batching.make_pieces(limit_a_batch, draws);
    if (!unchanged) memory.batches = batching.distribute(limit_a_batch);
    batching.assign(memory.batches, draws);
    return memory.batches.back() + 1;
}

}  // namespace gnomon::shadows::internal
