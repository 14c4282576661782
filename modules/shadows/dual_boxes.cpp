// SPDX-License-Identifier: MIT
#include "internal/dual_boxes.hpp"

#include <algorithm>
#include <cmath>

#include "internal/face_plane.hpp"
#include "internal/processor.hpp"

namespace gnomon::shadows::internal {

namespace {

// Twice what the four products and three sums of a box's test round, per unit of
// FilterLight::reach: no stored |n| is above 1 and no |d| above the radius by more than they are
// rounded themselves.
constexpr float test_error = 16.0F * 0x1p-24F;

void set_box(BoxNode& node, std::size_t at, const DualBounds& bounds) {
    if (bounds.low[0] > bounds.high[0]) return;  // of faces without area: never settled
    for (std::size_t d = 0; d < 4; ++d) {
        const float center = bounds.low[d] * 0.5F + bounds.high[d] * 0.5F;
        const double half = std::max(static_cast<double>(bounds.high[d]) - center,
                                     static_cast<double>(center) - bounds.low[d]);
        node.center[d][at] = center;
        node.half[d][at] = round_up(half * (1.0 + 0x1p-20));
    }
    node.error[at] = round_up(static_cast<double>(bounds.error) + test_error);
}

}  // namespace

BoxSides test_boxes_plain(const BoxNode& node, const FilterLight& light) {
    const std::array<float, 4> l{light.towards.x, light.towards.y, light.towards.z, light.w};
    BoxSides result;
    std::array<float, boxes_per_node> values;
    for (std::size_t i = 0; i < boxes_per_node; ++i) {
        values[i] = node.center[0][i] * l[0] + node.center[1][i] * l[1] + node.center[2][i] * l[2] +
                    node.center[3][i] * l[3];
        result.nearest[i] = std::abs(values[i]) -
                            (node.half[0][i] * std::abs(l[0]) + node.half[1][i] * std::abs(l[1]) +
                             node.half[2][i] * std::abs(l[2]) + node.half[3][i] * l[3] +
                             node.error[i] * light.reach);
    }
    for (std::size_t i = 0; i < boxes_per_node; ++i) {
        // Neither not-a-number nor infinity (an overflow) may pass.
        const bool settled =
            result.nearest[i] > 0.0F && result.nearest[i] <= std::numeric_limits<float>::max();
        const std::uint32_t bit = static_cast<std::uint32_t>(settled) << i;
        if (values[i] > 0.0F) {
            result.facing |= bit;
        } else {
            result.averted |= bit;
        }
    }
    return result;
}

#ifdef GNOMON_HAS_AVX2

namespace {

[[gnu::target("avx2")]] BoxSides test_boxes_avx2(const BoxNode& node, const FilterLight& light) {
    const __m256 sign = _mm256_set1_ps(-0.0F);
    const __m256 x = _mm256_set1_ps(light.towards.x);
    const __m256 y = _mm256_set1_ps(light.towards.y);
    const __m256 z = _mm256_set1_ps(light.towards.z);
    const __m256 w = _mm256_set1_ps(light.w);
    __m256 center[4];
    __m256 half[4];
    for (std::size_t d = 0; d < 4; ++d) {
        center[d] = _mm256_loadu_ps(node.center[d].data());
        half[d] = _mm256_loadu_ps(node.half[d].data());
    }
    const __m256 value = _mm256_add_ps(
        _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(center[0], x), _mm256_mul_ps(center[1], y)),
                      _mm256_mul_ps(center[2], z)),
        _mm256_mul_ps(center[3], w));
    const __m256 reached = _mm256_add_ps(
        _mm256_add_ps(
            _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(half[0], _mm256_andnot_ps(sign, x)),
                                        _mm256_mul_ps(half[1], _mm256_andnot_ps(sign, y))),
                          _mm256_mul_ps(half[2], _mm256_andnot_ps(sign, z))),
            _mm256_mul_ps(half[3], w)),
        _mm256_mul_ps(_mm256_loadu_ps(node.error.data()), _mm256_set1_ps(light.reach)));
    const __m256 nearest = _mm256_sub_ps(_mm256_andnot_ps(sign, value), reached);
    const __m256 settled = _mm256_and_ps(
        _mm256_cmp_ps(nearest, _mm256_setzero_ps(), _CMP_GT_OQ),
        _mm256_cmp_ps(nearest, _mm256_set1_ps(std::numeric_limits<float>::max()), _CMP_LE_OQ));
    const auto settled_bits = static_cast<std::uint32_t>(_mm256_movemask_ps(settled));
    const auto negative = static_cast<std::uint32_t>(_mm256_movemask_ps(value));
    BoxSides result;
    result.facing = settled_bits & ~negative;
    result.averted = settled_bits & negative;
    _mm256_storeu_ps(result.nearest.data(), nearest);
    return result;
}

}  // namespace

BoxSides test_boxes(const BoxNode& node, const FilterLight& light) {
    static const bool avx2 = has_avx2();
    return (avx2 ? test_boxes_avx2 : test_boxes_plain)(node, light);
}

#else

BoxSides test_boxes(const BoxNode& node, const FilterLight& light) {
    return test_boxes_plain(node, light);
}

#endif

void DualBounds::include(const FacePlanes& planes, std::size_t face) {
    if (is_degenerate(planes, face)) return;
    const std::array<float, 4> dual{planes.normal_x[face], planes.normal_y[face],
                                    planes.normal_z[face], planes.offset[face]};
    for (std::size_t d = 0; d < 4; ++d) {
        low[d] = std::min(low[d], dual[d]);
        high[d] = std::max(high[d], dual[d]);
    }
    error = std::max(error, planes.error[face]);
}

void DualBounds::include(const DualBounds& other) {
    for (std::size_t d = 0; d < 4; ++d) {
        low[d] = std::min(low[d], other.low[d]);
        high[d] = std::max(high[d], other.high[d]);
    }
    error = std::max(error, other.error);
}

DualBoxes::DualBoxes(std::vector<DualBounds> boxes) : blocks_(boxes.size()) {
    while (!boxes.empty()) {
        const std::size_t nodes = (boxes.size() + boxes_per_node - 1) / boxes_per_node;
        std::vector<BoxNode>& level = levels_.emplace_back(nodes);
        std::vector<DualBounds> parents(nodes);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            set_box(level[i / boxes_per_node], i % boxes_per_node, boxes[i]);
            parents[i / boxes_per_node].include(boxes[i]);
        }
        if (nodes == 1) break;
        boxes = std::move(parents);
    }
}

std::size_t DualBoxes::memory_bytes() const {
    std::size_t bytes = 0;
    for (const auto& level : levels_) bytes += level.capacity() * sizeof(BoxNode);
    return bytes;
}

}  // namespace gnomon::shadows::internal
