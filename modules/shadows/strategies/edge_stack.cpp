// SPDX-License-Identifier: MIT
//
// The "triangular" algorithm: the three edges of each face that casts go onto a stack, and an edge
// that is there already, the other way round, takes that one off again. What stays is the boundary.
//
// Source: H. C. Kwoon, "The Theory of Stencil Shadow Volumes", GameDev.net (2002), section
// "Silhouette determination". There each new edge is compared with all on the stack, which
// `edge_stack_naive` does; `edge_stack` looks it up in a hash table. The paper's edges cancel in
// pairs; here an entry counts, so that any number of faces may share an edge, in any direction.
#include <algorithm>
#include <array>
#include <bit>

#include "internal/facing_first.hpp"
#include "internal/paired_edges.hpp"

namespace gnomon::shadows::internal {

namespace {

struct StackedEdge {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    std::int32_t sum = 0;  // 0: no edge
};

// Calls add(low, high, sign * weight) for each edge of each face that casts.
template <class Add>
std::uint64_t push_all(const ShadowMesh& mesh, std::span<const std::int8_t> weights, Add&& add) {
    std::uint64_t pushed = 0;
    for (std::size_t f = 0; f < weights.size(); ++f) {
        const std::int32_t weight = weights[f];
        if (weight == 0) continue;
        const std::array<std::uint32_t, 3>& face = mesh.faces()[f];
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = face[i];
            const std::uint32_t to = face[(i + 1) % 3];
            add(std::min(from, to), std::max(from, to), from < to ? weight : -weight);
        }
        pushed += 3;
    }
    return pushed;
}

// Open addressing with linear probing; what is removed leaves no mark, so that the table is no
// larger than the stack ever was. Half of the places are free, at least.
class EdgeTable {
public:
    void clear() {
        std::ranges::fill(places_, StackedEdge{});
        used_ = 0;
    }

    void add(std::uint32_t low, std::uint32_t high, std::int32_t weight) {
        if (2 * (used_ + 1) > places_.size()) grow();
        std::size_t at = home(low, high);
        while (places_[at].sum != 0 && (places_[at].low != low || places_[at].high != high)) {
            at = next(at);
        }
        if (places_[at].sum == 0) {
            places_[at] = {low, high, weight};
            ++used_;
        } else if ((places_[at].sum += weight) == 0) {
            --used_;
            close_gap(at);
        }
    }

    [[nodiscard]] std::span<const StackedEdge> places() const { return places_; }
    [[nodiscard]] std::size_t bytes() const { return places_.capacity() * sizeof(StackedEdge); }

private:
    [[nodiscard]] std::size_t home(std::uint32_t low, std::uint32_t high) const {
        const std::uint64_t key = std::uint64_t{low} << 32U | high;
        return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> shift_);
    }
    [[nodiscard]] std::size_t next(std::size_t at) const { return (at + 1) & (places_.size() - 1); }

    // D. E. Knuth, The Art of Computer Programming 3, 6.4, algorithm R.
    void close_gap(std::size_t gap) {
        for (std::size_t at = next(gap); places_[at].sum != 0; at = next(at)) {
            const std::size_t wanted = home(places_[at].low, places_[at].high);
            const std::size_t mask = places_.size() - 1;
            if (((at - wanted) & mask) >= ((at - gap) & mask)) {
                places_[gap] = places_[at];
                gap = at;
            }
        }
        places_[gap] = {};
    }

    void grow() {
        const std::size_t size = std::max<std::size_t>(64, 2 * places_.size());
        std::vector<StackedEdge> old(size);
        old.swap(places_);
        shift_ = 64U - static_cast<unsigned>(std::countr_zero(size));
        used_ = 0;
        for (const StackedEdge& edge : old) {
            if (edge.sum != 0) add(edge.low, edge.high, edge.sum);
        }
    }

    std::vector<StackedEdge> places_;
    std::size_t used_ = 0;
    unsigned shift_ = 64;
};

class EdgeStack final : public FacingFirst {
protected:
    void prepare(const ShadowMesh& /*mesh*/) override {}

    void find_edges(const ShadowMesh& mesh, LightLocal /*light*/,
                    std::span<const std::int8_t> weights, std::vector<SilhouetteEdge>& silhouette,
                    DetectionStats& stats) override {
        table_.clear();
        stats.edges_tested =
            push_all(mesh, weights, [&](std::uint32_t low, std::uint32_t high, std::int32_t w) {
                table_.add(low, high, w);
            });
        for (const StackedEdge& edge : table_.places()) {
            append_edge(edge.low, edge.high, edge.sum, silhouette);
        }
        stats.bytes_touched += stats.edges_tested * (4 + sizeof(StackedEdge)) + 2 * table_.bytes();
    }

    [[nodiscard]] std::size_t own_bytes() const override { return sizeof *this + table_.bytes(); }

private:
    EdgeTable table_;
};

class EdgeStackNaive final : public FacingFirst {
protected:
    void prepare(const ShadowMesh& /*mesh*/) override {}

    void find_edges(const ShadowMesh& mesh, LightLocal /*light*/,
                    std::span<const std::int8_t> weights, std::vector<SilhouetteEdge>& silhouette,
                    DetectionStats& stats) override {
        stack_.clear();
        std::uint64_t compared = 0;
        stats.edges_tested =
            push_all(mesh, weights, [&](std::uint32_t low, std::uint32_t high, std::int32_t w) {
                std::size_t at = 0;
                while (at < stack_.size() && (stack_[at].low != low || stack_[at].high != high)) {
                    ++at;
                }
                compared += at;
                if (at == stack_.size()) {
                    stack_.push_back({low, high, w});
                } else if ((stack_[at].sum += w) == 0) {
                    stack_[at] = stack_.back();
                    stack_.pop_back();
                }
            });
        for (const StackedEdge& edge : stack_) {
            append_edge(edge.low, edge.high, edge.sum, silhouette);
        }
        stats.bytes_touched += stats.edges_tested * 4 + compared * sizeof(StackedEdge);
    }

    [[nodiscard]] std::size_t own_bytes() const override {
        return sizeof *this + stack_.capacity() * sizeof(StackedEdge);
    }

private:
    std::vector<StackedEdge> stack_;
};

}  // namespace

std::unique_ptr<SilhouetteDetector> edge_stack_detector() { return std::make_unique<EdgeStack>(); }

std::unique_ptr<SilhouetteDetector> edge_stack_naive_detector() {
    return std::make_unique<EdgeStackNaive>();
}

}  // namespace gnomon::shadows::internal
