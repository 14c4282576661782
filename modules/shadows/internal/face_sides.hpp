// SPDX-License-Identifier: MIT
//
// The sides that faces have of a light, one bit each, and how blocks of 16 faces get them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <gnomon/shadows/detector.hpp>
#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>

#include "dual_boxes.hpp"
#include "face_filter.hpp"

namespace gnomon::shadows::internal {

/// Bit f % 64 of word f / 64 is face f. A face that neither faces the light nor is edge-on is
/// averted. Bits beyond the last face are 0.
class FaceSides {
public:
    /// What the bits are afterwards is not said.
    void resize(std::size_t faces);

    /// +1 facing, 0 edge-on, -1 averted.
    [[nodiscard]] int side(std::size_t face) const {
        const std::size_t word = face / 64;
        const std::size_t bit = face % 64;
        if (((facing_[word] >> bit) & 1U) != 0) return 1;
        return ((edge_on_[word] >> bit) & 1U) != 0 ? 0 : -1;
    }
    [[nodiscard]] bool is_facing(std::size_t face) const {
        return ((facing_[face / 64] >> (face % 64)) & 1U) != 0;
    }
    [[nodiscard]] bool any_edge_on() const;
    [[nodiscard]] std::span<const std::uint64_t> facing() const { return facing_; }
    [[nodiscard]] std::span<const std::uint64_t> edge_on() const { return edge_on_; }

    [[nodiscard]] std::uint32_t facing_block(std::size_t block) const {
        return static_cast<std::uint32_t>(facing_[block / 4] >> (block % 4 * block_size)) & 0xFFFFU;
    }
    [[nodiscard]] std::uint32_t edge_on_block(std::size_t block) const {
        return static_cast<std::uint32_t>(edge_on_[block / 4] >> (block % 4 * block_size)) &
               0xFFFFU;
    }
    void set_block(std::size_t block, std::uint32_t facing, std::uint32_t edge_on) {
        const std::size_t shift = block % 4 * block_size;
        std::uint64_t& f = facing_[block / 4];
        f = (f & ~(std::uint64_t{0xFFFF} << shift)) | (std::uint64_t{facing} << shift);
        std::uint64_t& e = edge_on_[block / 4];
        e = (e & ~(std::uint64_t{0xFFFF} << shift)) | (std::uint64_t{edge_on} << shift);
    }
    void set_edge_on(std::size_t face) {
        facing_[face / 64] &= ~(std::uint64_t{1} << (face % 64));
        edge_on_[face / 64] |= std::uint64_t{1} << (face % 64);
    }
    /// Blocks whose faces all face the light, or none of them, and none edge-on.
    void set_blocks(std::size_t first, std::size_t count, bool facing);

    [[nodiscard]] std::size_t memory_bytes() const {
        return (facing_.capacity() + edge_on_.capacity()) * sizeof(std::uint64_t);
    }

private:
    std::size_t faces_ = 0;
    std::vector<std::uint64_t> facing_;
    std::vector<std::uint64_t> edge_on_;
};

/// Decides the sides of whole blocks for one light, exactly.
class BlockClassifier {
public:
    BlockClassifier(const ShadowMesh& mesh, LightLocal light, DetectionStats& stats);

    struct Block {
        std::uint32_t facing = 0;
        std::uint32_t edge_on = 0;
        /// How far the light may move and no face of the block changes its side; in the measure of
        /// Facing::margin. Infinite where all faces are degenerate.
        double margin = 0.0;
    };
    [[nodiscard]] Block classify(std::size_t block) const;
    /// Has the planes of a block fetched, which is classified soon.
    void prefetch_block(std::size_t block) const {
        const FacePlanes& planes = mesh_.planes();
        const std::size_t first = block * block_size;
        prefetch(&planes.normal_x[first]);
        prefetch(&planes.normal_y[first]);
        prefetch(&planes.normal_z[first]);
        prefetch(&planes.offset[first]);
        prefetch(&planes.error[first]);
    }
    /// All blocks, in turn. Returns the smallest margin.
    double classify_all(FaceSides& sides) const;

    [[nodiscard]] const FilterLight& light() const { return filtered_; }
    /// From BoxSides::nearest to a margin.
    [[nodiscard]] double margin_of(float nearest) const;

private:
    [[nodiscard]] Block finish(std::size_t block, const FilteredBlock& filtered) const;

    const ShadowMesh& mesh_;
    LightLocal exact_;
    FilterLight filtered_;
    double per_length_ = 1.0;  // of a direction: its displacement is measured on the unit sphere
    DetectionStats& stats_;
};

}  // namespace gnomon::shadows::internal
