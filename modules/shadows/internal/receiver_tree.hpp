// SPDX-License-Identifier: MIT
//
// A tree of receivers' bounds: which of them a shadow can reach.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "coverage.hpp"
#include "shadow_hull.hpp"

namespace gnomon::shadows::internal {

class ReceiverTree {
public:
    /// What the receivers that a hull may meet take up, together.
    struct Reached {
        /// Cut off where the hull's own bounds end. Where anything is reached the caster's own
        /// place counts as reached as well: casters mostly receive, and of what lies between the
        /// caster and a ground nothing needs to be looked at then.
        Aabb box = Aabb::nothing();
        double along_axis = 0.0;  ///< the farthest along ShadowHull::axis(); where any is reached
        [[nodiscard]] bool any() const { return !box.empty(); }
    };

    /// Cost: O(n log n).
    void build(std::span<const Aabb> receivers);
    [[nodiscard]] bool empty() const { return nodes_.empty(); }
    /// Of all receivers.
    [[nodiscard]] const Aabb& bounds() const { return nodes_.front().box; }
    /// Adds those reached to `reached`. Cost: the nodes that say something new.
    void reach(const ShadowHull& hull, Reached& reached) const;
    /// Adds what receivers that the hull may meet take up along a normal, where it may meet them.
    /// Cost: the nodes that say something new.
    void cover(const ShadowHull& hull, const glm::dvec3& normal, Coverage& along) const;
    /// Includes in boxes[i] what of receivers the hull may meet from free[i - 1].high to
    /// free[i].low along the normal: between intervals, ascending, in which there is none. There is
    /// one box more.
    void gather(const ShadowHull& hull, const glm::dvec3& normal, std::span<const Interval> free,
                std::span<Aabb> boxes) const;
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    struct Node {
        Aabb box;
        std::uint32_t next = 0;  // the node after all that is below this one
        bool is_leaf = false;
    };
    /// Calls take(within, along) with what the hull may meet of each receiver, and where along the
    /// normal, but for those below nodes of which it is not wanted(within, along).
    template <class Wanted, class Take>
    void for_each_met(const ShadowHull& hull, const glm::dvec3& normal, Wanted&& wanted,
                      Take&& take) const;
    std::uint32_t build(std::span<const Aabb> receivers, std::span<std::uint32_t> of_node);

    std::vector<Node> nodes_;  // depth first
    std::vector<std::uint32_t> order_;
};

}  // namespace gnomon::shadows::internal
