// SPDX-License-Identifier: MIT
#include "box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace gnomon::shadows::internal {

namespace {

template <class Real>
double area_of(const Box<Real>& box) {
    const glm::dvec3 s = glm::dvec3(box.max) - glm::dvec3(box.min);
    return s.x < 0.0 ? 0.0 : s.x * s.y + s.y * s.z + s.z * s.x;
}

}  // namespace

template <class Real>
struct BoxTree<Real>::Builder {
    static constexpr std::size_t bin_count = 16;

    std::span<const Box<Real>> boxes;
    std::uint32_t leaf_size;
    std::vector<Node>& nodes;
    std::vector<std::uint32_t>& order;

    void build(std::uint32_t first, std::uint32_t count, std::size_t depth) {
        const std::size_t at = nodes.size();
        Box<Real> bounds;
        for (std::uint32_t i = first; i < first + count; ++i) bounds.add(boxes[order[i]]);
        nodes.push_back({bounds, first, count});
        if (count <= leaf_size) return;
        const std::uint32_t left = depth < max_depth / 2 ? split(first, count) : count / 2;
        nodes[at].count = 0;
        build(first, left, depth + 1);
        nodes[at].next = static_cast<std::uint32_t>(nodes.size());
        build(first + left, count - left, depth + 1);
    }

    // Puts the boxes of the first child in front and says how many they are.
    std::uint32_t split(std::uint32_t first, std::uint32_t count) {
        const auto begin = order.begin() + first;
        const auto end = begin + count;
        Box<double> centers;
        for (auto i = begin; i != end; ++i) centers.add(boxes[*i].center());
        const glm::dvec3 size = centers.max - centers.min;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        const double scale = static_cast<double>(bin_count) / size[axis];
        if (!(size[axis] > 0.0) || !(scale < std::numeric_limits<double>::infinity())) {
            return count / 2;  // all in one place
        }
        const auto bin_of = [&](std::uint32_t box) {
            const double place = (boxes[box].center()[axis] - centers.min[axis]) * scale;
            return std::min(bin_count - 1, static_cast<std::size_t>(place));
        };
        std::array<Box<Real>, bin_count> bins;
        std::array<std::uint32_t, bin_count> counts{};
        for (auto i = begin; i != end; ++i) {
            const std::size_t bin = bin_of(*i);
            bins[bin].add(boxes[*i]);
            ++counts[bin];
        }
        std::array<double, bin_count> cost_before{};  // of bins [0, i)
        Box<Real> box;
        std::uint32_t so_far = 0;
        for (std::size_t i = 1; i < bin_count; ++i) {
            box.add(bins[i - 1]);
            so_far += counts[i - 1];
            cost_before[i] = area_of(box) * so_far;
        }
        box = {};
        so_far = 0;
        double best = std::numeric_limits<double>::infinity();
        std::size_t border = bin_count / 2;
        for (std::size_t i = bin_count - 1; i > 0; --i) {
            box.add(bins[i]);
            so_far += counts[i];
            const double cost = cost_before[i] + area_of(box) * so_far;
            if (so_far > 0 && so_far < count && cost < best) {
                best = cost;
                border = i;
            }
        }
        const auto middle =
            std::partition(begin, end, [&](std::uint32_t i) { return bin_of(i) < border; });
        const auto left = static_cast<std::uint32_t>(middle - begin);
        return left == 0 || left == count ? count / 2 : left;
    }
};

template <class Real>
BoxTree<Real>::BoxTree(std::span<const Box<Real>> boxes, std::uint32_t leaf_size) {
    if (boxes.empty()) return;
    order_.resize(boxes.size());
    std::iota(order_.begin(), order_.end(), 0U);
    nodes_.reserve(2 * boxes.size() / leaf_size + 1);
    Builder{boxes, leaf_size, nodes_, order_}.build(0, static_cast<std::uint32_t>(boxes.size()), 0);
}

template <class Real>
void BoxTree<Real>::refit(std::span<const Box<Real>> boxes) {
    for (std::size_t at = nodes_.size(); at-- > 0;) {  // children come after their parents
        Node& node = nodes_[at];
        if (node.count == 0) {
            node.box = nodes_[at + 1].box;
            node.box.add(nodes_[node.next].box);
            continue;
        }
        node.box = {};
        for (std::uint32_t i = node.next; i < node.next + node.count; ++i) {
            node.box.add(boxes[order_[i]]);
        }
    }
}

template <class Real>
double BoxTree<Real>::area() const {
    double sum = 0.0;
    for (const Node& node : nodes_) sum += area_of(node.box);
    return sum;
}

template class BoxTree<float>;
template class BoxTree<double>;

}  // namespace gnomon::shadows::internal
