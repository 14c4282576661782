// SPDX-License-Identifier: MIT
#include "internal/receiver_tree.hpp"

#include <algorithm>
#include <numeric>

namespace gnomon::shadows::internal {

namespace {

double size_of(std::span<const Aabb> receivers, std::span<const std::uint32_t> some) {
    Aabb box = Aabb::nothing();
    for (const std::uint32_t r : some) box.include(receivers[r]);
    const glm::dvec3 extent = box.high - box.low;
    return glm::dot(extent, extent);
}

}  // namespace

void ReceiverTree::build(std::span<const Aabb> receivers) {
    nodes_.clear();
    if (receivers.empty()) return;
    nodes_.reserve(2 * receivers.size());
    order_.resize(receivers.size());
    std::iota(order_.begin(), order_.end(), 0U);
    build(receivers, order_);
}

std::uint32_t ReceiverTree::build(std::span<const Aabb> receivers,
                                  std::span<std::uint32_t> of_node) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    Aabb box = Aabb::nothing();
    Aabb middles = Aabb::nothing();
    for (const std::uint32_t r : of_node) {
        box.include(receivers[r]);
        const glm::dvec3 middle = 0.5 * (receivers[r].low + receivers[r].high);
        middles.include({middle, middle});
    }
    const bool is_leaf = of_node.size() == 1;
    if (!is_leaf) {
        const glm::dvec3 extent = middles.high - middles.low;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                         : extent.y >= extent.z                       ? 1
                                                                      : 2;
        const std::size_t half = of_node.size() / 2;
        const auto middle = [&](std::uint32_t r) {
            return receivers[r].low[axis] + receivers[r].high[axis];
        };
        std::nth_element(of_node.begin(), of_node.begin() + static_cast<std::ptrdiff_t>(half),
                         of_node.end(), [&](std::uint32_t a, std::uint32_t b) {
                             return middle(a) != middle(b) ? middle(a) < middle(b) : a < b;
                         });
        // The larger half comes first: where a ground has said where a shadow ends, what stands
        // on it has little to add.
        const std::span<std::uint32_t> halves[]{of_node.first(half), of_node.subspan(half)};
        const bool swapped = size_of(receivers, halves[1]) > size_of(receivers, halves[0]);
        build(receivers, halves[swapped ? 1 : 0]);
        build(receivers, halves[swapped ? 0 : 1]);
    }
    nodes_[index] = {box, static_cast<std::uint32_t>(nodes_.size()), is_leaf};
    return index;
}

void ReceiverTree::reach(const ShadowHull& hull, Reached& reached) const {
    if (nodes_.empty()) return;
    const glm::dvec3& axis = hull.axis();
    const Aabb shadow = hull.bounds_in(bounds());
    Aabb known{glm::max(hull.caster().low, shadow.low), glm::min(hull.caster().high, shadow.high)};
    if (known.empty()) known = Aabb::nothing();
    const Aabb own = known;
    std::size_t i = 0;
    while (i < nodes_.size()) {
        const Node& node = nodes_[i];
        const Aabb within{glm::max(node.box.low, shadow.low), glm::min(node.box.high, shadow.high)};
        const bool says_nothing_new =
            within.empty() ||
            (reached.any() && known.holds(within) && support(within, axis) <= reached.along_axis);
        if (says_nothing_new || !hull.may_meet(node.box)) {
            i = node.next;
            continue;
        }
        if (node.is_leaf) {
            // Only so far as the light's way through this one leads.
            const Aabb part = hull.bounds_in(within);
            if (!part.empty()) {
                const double along = support(part, axis);
                reached.along_axis = reached.any() ? std::max(reached.along_axis, along) : along;
                reached.box.include(part);
                known.include(part);
            }
        }
        ++i;
    }
    if (!reached.any()) return;
    reached.box.include(own);
    // Less is reached than all, and so the light's way ends sooner.
    const Aabb closer = hull.bounds_in(reached.box);
    if (!closer.empty()) {
        reached.box = closer;
        reached.along_axis = std::min(reached.along_axis, support(closer, axis));
    }
}

template <class Wanted, class Take>
void ReceiverTree::for_each_met(const ShadowHull& hull, const glm::dvec3& normal, Wanted&& wanted,
                                Take&& take) const {
    if (nodes_.empty()) return;
    const Aabb shadow = hull.bounds_in(bounds());
    std::size_t i = 0;
    while (i < nodes_.size()) {
        const Node& node = nodes_[i];
        const Aabb within = hull.bounds_in(
            {glm::max(node.box.low, shadow.low), glm::min(node.box.high, shadow.high)});
        const Interval along{-support(within, -normal), support(within, normal)};
        if (within.empty() || !wanted(within, along) || !hull.may_meet(node.box)) {
            i = node.next;
            continue;
        }
        if (node.is_leaf) take(within, along);
        ++i;
    }
}

void ReceiverTree::cover(const ShadowHull& hull, const glm::dvec3& normal, Coverage& along) const {
    for_each_met(
        hull, normal, [&](const Aabb&, const Interval& interval) { return !along.holds(interval); },
        [&](const Aabb&, const Interval& interval) { along.add(interval); });
}

void ReceiverTree::gather(const ShadowHull& hull, const glm::dvec3& normal,
                          std::span<const Interval> free, std::span<Aabb> boxes) const {
    const auto part_of = [&](const Interval& interval) {
        std::size_t i = 0;
        while (i < free.size() && free[i].high <= interval.low) ++i;
        return i;
    };
    for_each_met(
        hull, normal,
        [&](const Aabb& within, const Interval& interval) {
            const std::size_t i = part_of(interval);
            const bool is_of_one = i == free.size() || interval.high <= free[i].low;
            return !is_of_one || !boxes[i].holds(within);
        },
        [&](const Aabb& within, const Interval& interval) {
            boxes[part_of(interval)].include(within);
        });
}

std::size_t ReceiverTree::memory_bytes() const {
    return nodes_.capacity() * sizeof(Node) + order_.capacity() * sizeof(std::uint32_t);
}

}  // namespace gnomon::shadows::internal
