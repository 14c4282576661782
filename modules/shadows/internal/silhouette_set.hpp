// SPDX-License-Identifier: MIT
//
// A silhouette of which single edges come and go: a sparse set (P. Briggs and L. Torczon, "An
// Efficient Representation for Sparse Sets", 1993), in which clearing costs nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <gnomon/shadows/silhouette.hpp>

namespace gnomon::shadows::internal {

class SilhouetteSet {
public:
    /// Empties the set. Cost: nothing, unless the number of edges is another than before.
    void clear(std::size_t edges) {
        if (slots_.size() != edges) slots_.assign(edges, 0);
        members_.clear();
        list.clear();
    }
    /// Adds an edge that is not there.
    void add(std::size_t edge, const SilhouetteEdge& as) {
        slots_[edge] = static_cast<std::uint32_t>(members_.size());
        members_.push_back(static_cast<std::uint32_t>(edge));
        list.push_back(as);
    }
    /// Adds, changes, or (where as.count is 0) removes an edge.
    void set(std::size_t edge, const SilhouetteEdge& as) {
        const std::uint32_t slot = slots_[edge];
        const bool there = slot < members_.size() && members_[slot] == edge;
        if (as.count == 0) {
            if (there) remove(slot);
        } else if (there) {
            list[slot] = as;
        } else {
            add(edge, as);
        }
    }

    [[nodiscard]] std::size_t memory_bytes() const {
        return (slots_.capacity() + members_.capacity()) * sizeof(std::uint32_t);
    }

    std::vector<SilhouetteEdge>& list;  ///< the edges that are there, in any order

    explicit SilhouetteSet(std::vector<SilhouetteEdge>& edges) : list(edges) {}

private:
    void remove(std::uint32_t slot) {
        list[slot] = list.back();
        members_[slot] = members_.back();
        slots_[members_[slot]] = slot;
        list.pop_back();
        members_.pop_back();
    }

    std::vector<std::uint32_t> slots_;    // by edge; means nothing for those that are not there
    std::vector<std::uint32_t> members_;  // by slot
};

}  // namespace gnomon::shadows::internal
