// SPDX-License-Identifier: MIT
#include "internal/face_sides.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "internal/face_plane.hpp"
#include "internal/side_test.hpp"

namespace gnomon::shadows::internal {

void FaceSides::resize(std::size_t faces) {
    if (faces == faces_ && !facing_.empty()) return;
    faces_ = faces;
    // One word more, so that any bit may be read with its neighbours.
    facing_.assign(faces / 64 + 1, 0);
    edge_on_.assign(faces / 64 + 1, 0);
}

bool FaceSides::any_edge_on() const {
    std::uint64_t any = 0;
    for (const std::uint64_t word : edge_on_) any |= word;
    return any != 0;
}

void FaceSides::set_blocks(std::size_t first, std::size_t count, bool facing) {
    const std::size_t begin = first * block_size;
    const std::size_t end = std::min(begin + count * block_size, faces_);
    const std::uint64_t value = facing ? ~std::uint64_t{0} : 0;
    const auto fill = [&](std::size_t word, std::uint64_t mask) {
        facing_[word] = (facing_[word] & ~mask) | (value & mask);
        edge_on_[word] &= ~mask;
    };
    const std::size_t first_word = begin / 64;
    const std::size_t last_word = end / 64;
    const std::uint64_t from = ~std::uint64_t{0} << (begin % 64);
    const std::uint64_t to = (std::uint64_t{1} << (end % 64)) - 1;
    if (first_word == last_word) {
        fill(first_word, from & to);
        return;
    }
    fill(first_word, from);
    for (std::size_t w = first_word + 1; w < last_word; ++w) {
        facing_[w] = value;
        edge_on_[w] = 0;
    }
    if (to != 0) fill(last_word, to);
}

BlockClassifier::BlockClassifier(const ShadowMesh& mesh, LightLocal light, DetectionStats& stats)
    : mesh_(mesh), exact_(light), filtered_(filter_light(mesh.planes(), light)), stats_(stats) {
    if (!light.is_directional()) return;
    const double length = glm::length(glm::dvec3(light.position));
    per_length_ = length > 0.0 ? 1.0 / length : 0.0;
}

double BlockClassifier::margin_of(float nearest) const {
    return static_cast<double>(nearest) * plane_shrink * per_length_;
}

BlockClassifier::Block BlockClassifier::finish(std::size_t block,
                                               const FilteredBlock& filtered) const {
    const std::size_t first = block * block_size;
    const std::size_t count = std::min(block_size, mesh_.faces().size() - first);
    const std::uint32_t all = 0xFFFFU >> (block_size - count);
    Block result;
    result.facing = filtered.facing & all;
    double nearest = static_cast<double>(filtered.nearest) * plane_shrink;
    for (std::uint32_t rest = all & ~std::uint32_t{filtered.decided}; rest != 0; rest &= rest - 1) {
        const auto bit = static_cast<std::size_t>(std::countr_zero(rest));
        if (mesh_.is_degenerate(first + bit)) {
            result.edge_on |= 1U << bit;
            continue;
        }
        const auto& [a, b, c] = mesh_.faces()[first + bit];
        const auto p = mesh_.positions();
        const Side side = test_side(p[a], p[b], p[c], exact_);
        ++stats_.double_tests;
        stats_.exact_tests += side.was_exact ? 1 : 0;
        if (side.sign > 0) result.facing |= 1U << bit;
        if (side.sign == 0) result.edge_on |= 1U << bit;
        nearest = std::min(nearest, side.distance);
    }
    result.margin = nearest * per_length_;
    return result;
}

BlockClassifier::Block BlockClassifier::classify(std::size_t block) const {
    FilteredBlock filtered;
    filter_blocks(mesh_.planes(), filtered_, block, std::span(&filtered, 1));
    return finish(block, filtered);
}

double BlockClassifier::classify_all(FaceSides& sides) const {
    const std::size_t blocks = (mesh_.faces().size() + block_size - 1) / block_size;
    double margin = std::numeric_limits<double>::infinity();
    float nearest = std::numeric_limits<float>::infinity();
    std::array<FilteredBlock, 64> filtered;
    for (std::size_t first = 0; first < blocks; first += filtered.size()) {
        const std::span part = std::span(filtered).first(std::min(filtered.size(), blocks - first));
        filter_blocks(mesh_.planes(), filtered_, first, part);
        for (std::size_t i = 0; i < part.size(); ++i) {
            if (part[i].decided == 0xFFFF) {
                sides.set_block(first + i, part[i].facing, 0);
                nearest = part[i].nearest < nearest ? part[i].nearest : nearest;
                continue;
            }
            const Block block = finish(first + i, part[i]);
            sides.set_block(first + i, block.facing, block.edge_on);
            margin = std::min(margin, block.margin);
        }
    }
    return std::min(margin, margin_of(nearest));
}

}  // namespace gnomon::shadows::internal
