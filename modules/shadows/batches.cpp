// SPDX-License-Identifier: MIT
#include "internal/batches.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

#include <gnomon/shadows/layer_bound.hpp>

#include "internal/footprint.hpp"
#include "internal/layers.hpp"

namespace gnomon::shadows::internal {

namespace {

// A bit of the stencil remembers what earlier batches left.
constexpr std::uint32_t most_a_batch = 127;

std::vector<std::uint64_t> revisions_of(const LightState& light, std::span<const DrawnPair> pairs) {
    std::vector<std::uint64_t> revisions{light.revision};
    revisions.reserve(2 * pairs.size() + 1);
    for (const DrawnPair& drawn : pairs) {
        revisions.push_back(drawn.revision);
        revisions.push_back(drawn.caster->pose_revision);
    }
    return revisions;
}

class Batching {
public:
    Batching(LightState& light, std::span<const DrawnPair> pairs) : light_(light), pairs_(pairs) {}

    [[nodiscard]] std::uint64_t most_together() {
        footprints_.clear();
        for (const DrawnPair& drawn : pairs_) append(drawn, layers_of(drawn));
        return most_layers(footprints_);
    }
    void refine_coarsely();
    /// False: together they may lie over a point more often than `limit` says, as bounded as they
    /// can be.
    [[nodiscard]] bool refine_until_they_fit(std::uint32_t limit);
    /// Replaces volumes of more layers by their parts, and puts draws into an order in which
    /// neighbours seldom cover each other.
    void make_pieces(std::uint32_t limit);
    /// Numbers of batches, ascending: as many pieces as fit into each, one after the other. Returns
    /// how many there are.
    std::uint32_t distribute(std::uint32_t limit);

private:
    bool refine_until_they_fit(std::uint32_t limit, Bounded how);

    struct Sorted {
        Piece piece;
        const DrawnPair* drawn = nullptr;
        std::uint32_t layers = 0;
        double distance = 0.0;  // from the light to the caster, or along its way
    };
    [[nodiscard]] std::uint32_t& layers_of(const DrawnPair& drawn) const {
        return light_.layers[drawn.slot];
    }
    [[nodiscard]] double distance_to(const DrawnPair& drawn) const;

    void append(const DrawnPair& drawn, std::uint32_t layers) {
        append_footprints(bounds_of(*drawn.caster), light_.light.position_world, layers,
                          footprints_);
    }
    [[nodiscard]] bool fits(std::size_t begin, std::size_t end, std::uint32_t limit) {
        footprints_.clear();
        for (std::size_t i = begin; i < end; ++i) append(*sorted_[i].drawn, sorted_[i].layers);
        return most_layers(footprints_) <= limit;
    }

    LightState& light_;
    std::span<const DrawnPair> pairs_;
    std::vector<Sorted> sorted_;
    std::vector<Footprint> footprints_;
};

void Batching::refine_coarsely() {
    for (const DrawnPair& drawn : pairs_) {
        const PairState& pair = light_.pairs[drawn.slot];
        std::uint32_t& layers = layers_of(drawn);
        if (pair.bounded() != Bounded::Quickly || layers <= 1) continue;
        const std::uint32_t coarse = coarse_layer_bound(*drawn.caster->mesh, *drawn.volume,
                                                        space_of(pair, *drawn.caster, light_));
        layers = std::min(layers, coarse);
    }
}

// Bounds proper are dear: first on few cells and of those with the most layers, and no more than it
// takes. What does not fit at last has been bounded as well as can be, whatever came before.
bool Batching::refine_until_they_fit(std::uint32_t limit) {
    return refine_until_they_fit(limit, Bounded::OnHalfGrid) ||
           refine_until_they_fit(limit, Bounded::OnFullGrid) ||
           refine_until_they_fit(limit, Bounded::AsWellAsCanBe);
}

bool Batching::refine_until_they_fit(std::uint32_t limit, Bounded how) {
    const Grid grid = how == Bounded::OnHalfGrid   ? Grid::Half
                      : how == Bounded::OnFullGrid ? Grid::Full
                                                   : Grid::Fine;
    const std::uint32_t few = grid == Grid::Fine ? many_layers : 1;
    std::vector<const DrawnPair*> left;
    for (const DrawnPair& drawn : pairs_) {
        if (light_.pairs[drawn.slot].bounded() < how) left.push_back(&drawn);
    }
    std::ranges::stable_sort(left, std::greater{},
                             [&](const DrawnPair* drawn) { return layers_of(*drawn); });
    std::size_t refined = 0;
    std::size_t next_look = 1;
    for (const DrawnPair* drawn : left) {
        PairState& pair = light_.pairs[drawn->slot];
        std::uint32_t& layers = layers_of(*drawn);
        pair.set_bounded(how);
        if (layers <= few) continue;
        layers = std::min(layers, layer_bound_on(grid, *drawn->caster->mesh, *drawn->volume,
                                                 space_of(pair, *drawn->caster, light_)));
        if (++refined < next_look) continue;
        next_look *= 2;  // a look goes over all pairs
        if (most_together() <= limit) return true;
    }
    return refined > 0 && most_together() <= limit;
}

double Batching::distance_to(const DrawnPair& drawn) const {
    const auto corners = corners_of(bounds_of(*drawn.caster));
    const glm::dvec3 center = 0.5 * corners[0] + 0.5 * corners[7];
    const glm::dvec4& light = light_.light.position_world;
    const double distance = light.w == 0.0 ? -glm::dot(center, glm::dvec3(light))
                                           : glm::length(center - glm::dvec3(light));
    return std::isfinite(distance) ? distance : 0.0;  // what is no number would not sort
}

void Batching::make_pieces(std::uint32_t limit) {
    for (const DrawnPair& drawn : pairs_) {
        PairState& pair = light_.pairs[drawn.slot];
        const double distance = distance_to(drawn);
        if (layers_of(drawn) <= limit) {
            sorted_.push_back({{.caster = drawn.slot}, &drawn, layers_of(drawn), distance});
            continue;
        }
        std::vector<VolumePart>& parts = pair.more().parts;
        if (parts.empty()) {
            for (LayerPart& part : split_volume(*drawn.caster->mesh, *drawn.volume,
                                                space_of(pair, *drawn.caster, light_), limit)) {
                parts.push_back({std::make_shared<const Volume>(std::move(part.volume)),
                                 next_volume_revision(), part.layers});
            }
        }
        for (std::uint32_t p = 0; p < parts.size(); ++p) {
            sorted_.push_back({{.caster = drawn.slot, .part = p, .first = p == 0},
                               &drawn,
                               parts[p].layers,
                               distance});
        }
    }
    // Whole volumes and first parts, then second parts, and so on: parts of one overlap.
    const auto rank = [](const Sorted& s) { return s.piece.first ? 0U : s.piece.part; };
    std::stable_sort(sorted_.begin(), sorted_.end(), [&](const Sorted& a, const Sorted& b) {
        return std::tuple(rank(a), a.distance) < std::tuple(rank(b), b.distance);
    });
}

std::uint32_t Batching::distribute(std::uint32_t limit) {
    std::uint32_t batch = 0;
    for (std::size_t begin = 0; begin < sorted_.size(); ++batch) {
        std::size_t end = begin + 1;
        std::size_t step = 1;
        for (; end + step <= sorted_.size() && fits(begin, end + step, limit); step *= 2) {
            end += step;
        }
        for (; step > 0; step /= 2) {
            if (end + step <= sorted_.size() && fits(begin, end + step, limit)) end += step;
        }
        for (; begin < end; ++begin) sorted_[begin].piece.batch = batch;
    }
    light_.pieces.clear();
    for (const Sorted& s : sorted_) light_.pieces.push_back(s.piece);
    return batch;
}

}  // namespace

bool fit_together(LightState& light, std::uint32_t limit, std::span<const DrawnPair> pairs) {
    return Batching(light, pairs).most_together() <= limit;
}

std::uint32_t split_into_batches(LightState& light, std::uint32_t limit,
                                 std::span<const DrawnPair> pairs) {
    LayerMemory& memory = light.memory;
    auto revisions = revisions_of(light, pairs);
    if (revisions == memory.revisions) return memory.batches;
    memory = {std::move(revisions), 1};
    light.pieces.clear();
    Batching batching(light, pairs);
    if (batching.most_together() <= limit) return 1;
    batching.refine_coarsely();
    if (batching.most_together() <= limit) return 1;
    if (batching.refine_until_they_fit(limit)) return 1;
    const std::uint32_t limit_a_batch = std::min(limit, most_a_batch);
    batching.make_pieces(limit_a_batch);
    memory.batches = batching.distribute(limit_a_batch);
    return memory.batches;
}

}  // namespace gnomon::shadows::internal
