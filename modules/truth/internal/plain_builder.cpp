// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "internal/box_tree.hpp"

namespace gnomon::truth::internal {

namespace {

constexpr std::size_t bin_count = 16;
// Beyond this depth boxes are halved by number, which ends after 32 more levels whatever they are.
constexpr std::size_t deepest_search = 128;
static_assert(deepest_search + 32 < BoxTree::max_depth);

struct Extent {
    glm::vec3 min{std::numeric_limits<float>::infinity()};
    glm::vec3 max{-std::numeric_limits<float>::infinity()};

    void include(const glm::vec3& low, const glm::vec3& high) {
        min = glm::min(min, low);
        max = glm::max(max, high);
    }
    /// In double precision, where no square of a box that is allowed overflows.
    [[nodiscard]] double half_area() const {
        if (!(min.x <= max.x)) return 0.0;
        const glm::dvec3 size = glm::dvec3(max) - glm::dvec3(min);
        return size.x * size.y + size.y * size.z + size.z * size.x;
    }
};

// Twice the middle: only its order matters.
glm::dvec3 place_of(const NumberedBox& box) { return glm::dvec3(box.min) + glm::dvec3(box.max); }

struct Bins {
    double low = 0.0;
    double per_bin = 0.0;
    int axis = 0;

    [[nodiscard]] std::size_t of(const NumberedBox& box) const {
        const double bin = (place_of(box)[axis] - low) / per_bin;
        return std::min(static_cast<std::size_t>(std::max(bin, 0.0)), bin_count - 1);
    }
};

struct Split {
    Bins bins;
    std::size_t first_right = 0;  // the first bin that goes to the right; 0: no split was found
};

/// Where halves are cheapest: their areas, which is how likely a beam is to enter, times how many
/// boxes wait there.
Split cheapest_split(std::span<const NumberedBox> boxes) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    for (const NumberedBox& box : boxes) {
        low = glm::min(low, place_of(box));
        high = glm::max(high, place_of(box));
    }
    Split best;
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const Bins bins{low[axis], (high[axis] - low[axis]) / double{bin_count}, axis};
        if (!(bins.per_bin > 0.0)) continue;
        std::array<Extent, bin_count> extents;
        std::array<std::size_t, bin_count> counts{};
        for (const NumberedBox& box : boxes) {
            const std::size_t bin = bins.of(box);
            extents[bin].include(box.min, box.max);
            ++counts[bin];
        }
        std::array<double, bin_count> right_costs{};
        Extent right;
        std::size_t right_count = 0;
        for (std::size_t bin = bin_count; bin-- > 1;) {
            right.include(extents[bin].min, extents[bin].max);
            right_count += counts[bin];
            right_costs[bin] = right.half_area() * static_cast<double>(right_count);
        }
        Extent left;
        std::size_t left_count = 0;
        for (std::size_t bin = 1; bin < bin_count; ++bin) {
            left.include(extents[bin - 1].min, extents[bin - 1].max);
            left_count += counts[bin - 1];
            if (left_count == 0 || left_count == boxes.size()) continue;
            const double cost =
                left.half_area() * static_cast<double>(left_count) + right_costs[bin];
            if (!(cost < least)) continue;
            least = cost;
            best = {bins, bin};
        }
    }
    return best;
}

class Builder {
public:
    explicit Builder(std::vector<NumberedBox> boxes) : boxes_(std::move(boxes)) {}

    BoxTree build() {
        if (boxes_.empty()) return {};
        tree_.nodes.reserve(2 * boxes_.size());
        tree_.order.reserve(boxes_.size());
        tree_.nodes.emplace_back();
        fill(0, boxes_, 0);
        return std::move(tree_);
    }

private:
    void fill(std::size_t place, std::span<NumberedBox> boxes, std::size_t depth) {
        Extent all;
        for (const NumberedBox& box : boxes) all.include(box.min, box.max);
        tree_.nodes[place].min = all.min;
        tree_.nodes[place].max = all.max;
        if (boxes.size() <= BoxTree::max_leaf) {
            tree_.nodes[place].first = static_cast<std::uint32_t>(tree_.order.size());
            tree_.nodes[place].count = static_cast<std::uint32_t>(boxes.size());
            for (const NumberedBox& box : boxes) tree_.order.push_back(box.number);
            return;
        }
        const std::size_t left = divide(boxes, depth);
        const std::size_t children = tree_.nodes.size();
        tree_.nodes[place].first = static_cast<std::uint32_t>(children);
        tree_.nodes.resize(children + 2);
        fill(children, boxes.first(left), depth + 1);
        fill(children + 1, boxes.subspan(left), depth + 1);
    }

    /// Moves the left half's boxes to the front; gives their number, at least 1 and not all.
    static std::size_t divide(std::span<NumberedBox> boxes, std::size_t depth) {
        const Split split = depth < deepest_search ? cheapest_split(boxes) : Split{};
        if (split.first_right == 0) return boxes.size() / 2;
        const auto middle = std::partition(boxes.begin(), boxes.end(), [&](const NumberedBox& box) {
            return split.bins.of(box) < split.first_right;
        });
        return static_cast<std::size_t>(middle - boxes.begin());
    }

    std::vector<NumberedBox> boxes_;
    BoxTree tree_;
};

}  // namespace

BoxTree build_plainly(std::vector<NumberedBox> boxes) { return Builder(std::move(boxes)).build(); }

}  // namespace gnomon::truth::internal
