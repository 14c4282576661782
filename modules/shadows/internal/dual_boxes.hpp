// SPDX-License-Identifier: MIT
//
// A hierarchy of boxes in dual space. The dual of a plane n . x + d = 0 is the point (n, d), that
// of an edge between two faces the segment between their points, that of a light (p, w) the
// hyperplane { (n, d) : n . p + d w = 0 }. Which side of that a dual point lies on is which side of
// the plane the light lies on; a segment that crosses it is a silhouette edge (A. Hertzmann and D.
// Zorin, "Illustrating Smooth Surfaces", 2000, section 3.2, with planes of faces instead of tangent
// planes). A box that the hyperplane misses settles all that is in it.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include <gnomon/shadows/shadow_mesh.hpp>

#include "face_filter.hpp"
#include "processor.hpp"

namespace gnomon::shadows::internal {

inline constexpr std::size_t block_size = 16;  ///< items (faces or edges) in a leaf
inline constexpr std::size_t boxes_per_node = 8;

/// Eight boxes, one array a quantity. Bounds are those of the planes as stored; `error` is the
/// largest error of any of them (FacePlanes::error) and covers what testing the box rounds.
struct BoxNode {
    std::array<std::array<float, boxes_per_node>, 4> center{};
    std::array<std::array<float, boxes_per_node>, 4> half{};
    std::array<float, boxes_per_node> error{};

    bool operator==(const BoxNode&) const = default;
};

/// What a hyperplane does to the eight boxes of a node, one bit each. Neither: it may cross.
struct BoxSides {
    std::uint32_t facing = 0;
    std::uint32_t averted = 0;
    /// By box that is settled: how far the light is from the nearest plane in it, at least, as
    /// filter_scalar() has it.
    std::array<float, boxes_per_node> nearest{};
};
[[nodiscard]] BoxSides test_boxes(const BoxNode& node, const FilterLight& light);
/// The same box by box: what processors do that have no such vectors.
[[nodiscard]] BoxSides test_boxes_plain(const BoxNode& node, const FilterLight& light);

/// The bounds of dual points.
struct DualBounds {
    std::array<float, 4> low{std::numeric_limits<float>::max(), std::numeric_limits<float>::max(),
                             std::numeric_limits<float>::max(), std::numeric_limits<float>::max()};
    std::array<float, 4> high{
        std::numeric_limits<float>::lowest(), std::numeric_limits<float>::lowest(),
        std::numeric_limits<float>::lowest(), std::numeric_limits<float>::lowest()};
    float error = 0.0F;

    /// A face without area has no plane and adds nothing.
    void include(const FacePlanes& planes, std::size_t face);
    void include(const DualBounds& other);
};

class DualBoxes {
public:
    DualBoxes() = default;
    /// `blocks`: the bounds of items 16 k .. 16 k + 15.
    explicit DualBoxes(std::vector<DualBounds> blocks);

    bool operator==(const DualBoxes&) const = default;

    [[nodiscard]] std::size_t memory_bytes() const;

    /// Calls settled(first_block, block_count, facing, nearest) for the largest boxes that are, and
    /// crossed(block) for the blocks that are not, together for every block once. Where crossed()
    /// returns a bool, false ends the visit. Returns the number of nodes tested. Cost: near the
    /// number of boxes that the hyperplane crosses.
    template <class Settled, class Crossed>
    std::size_t visit(const FilterLight& light, const Settled& settled,
                      const Crossed& crossed) const {
        if (levels_.empty()) return 0;
        std::size_t tested = 0;
        static_cast<void>(visit_node(levels_.size() - 1, 0, light, settled, crossed, tested));
        return tested;
    }

private:
    template <class Settled, class Crossed>
    bool visit_node(std::size_t level, std::size_t node, const FilterLight& light,
                    const Settled& settled, const Crossed& crossed, std::size_t& tested) const {
        const BoxSides sides = test_boxes(levels_[level][node], light);
        ++tested;
        const std::size_t first = node * boxes_per_node;
        const std::size_t boxes = level == 0 ? blocks_ : levels_[level - 1].size();
        const std::uint32_t there = boxes - first < boxes_per_node ? (1U << (boxes - first)) - 1U
                                                                   : (1U << boxes_per_node) - 1U;
        const std::size_t size = std::size_t{1} << (3 * level);
        for (std::uint32_t rest = (sides.facing | sides.averted) & there; rest != 0;
             rest &= rest - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rest));
            const std::size_t begin = (first + i) * size;
            settled(begin, begin + size < blocks_ ? size : blocks_ - begin,
                    ((sides.facing >> i) & 1U) != 0, sides.nearest[i]);
        }
        const std::uint32_t open = ~(sides.facing | sides.averted) & there;
        if (level > 0) {
            for (std::uint32_t rest = open; rest != 0; rest &= rest - 1) {
                const auto* child = reinterpret_cast<const std::byte*>(
                    &levels_[level - 1][first + static_cast<std::size_t>(std::countr_zero(rest))]);
                for (std::size_t line = 0; line < sizeof(BoxNode); line += 64) {
                    prefetch(child + line);
                }
            }
        }
        for (std::uint32_t rest = open; rest != 0; rest &= rest - 1) {
            const std::size_t box = first + static_cast<std::size_t>(std::countr_zero(rest));
            if (level > 0) {
                if (!visit_node(level - 1, box, light, settled, crossed, tested)) return false;
            } else if constexpr (std::is_void_v<decltype(crossed(box))>) {
                crossed(box);
            } else if (!crossed(box)) {
                return false;
            }
        }
        return true;
    }

    std::size_t blocks_ = 0;
    std::vector<std::vector<BoxNode>> levels_;  ///< level k: eight boxes of 8^k blocks each
};

}  // namespace gnomon::shadows::internal
