// SPDX-License-Identifier: MIT
#include "internal/receiver_tree.hpp"

#include <algorithm>
#include <numeric>

namespace gnomon::shadows::internal {

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
        build(receivers, of_node.first(half));
        build(receivers, of_node.subspan(half));
    }
    nodes_[index] = {box, static_cast<std::uint32_t>(nodes_.size()), is_leaf};
    return index;
}

void ReceiverTree::reach(const ShadowHull& hull, Reached& reached) const {
    const glm::dvec3& axis = hull.axis();
    const auto cut = [&](const Aabb& box) {
        return Aabb{glm::max(box.low, hull.bounds().low), glm::min(box.high, hull.bounds().high)};
    };
    std::size_t i = 0;
    while (i < nodes_.size()) {
        const Node& node = nodes_[i];
        const Aabb within = cut(node.box);
        const bool says_nothing_new =
            within.empty() || (reached.any() && reached.box.holds(within) &&
                               support(within, axis) <= reached.along_axis);
        if (says_nothing_new || !hull.may_meet(node.box)) {
            i = node.next;
            continue;
        }
        if (node.is_leaf) {
            const double along = support(within, axis);
            reached.along_axis = reached.any() ? std::max(reached.along_axis, along) : along;
            reached.box.include(within);
        }
        ++i;
    }
}

std::size_t ReceiverTree::memory_bytes() const {
    return nodes_.capacity() * sizeof(Node) + order_.capacity() * sizeof(std::uint32_t);
}

}  // namespace gnomon::shadows::internal
