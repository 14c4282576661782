// SPDX-License-Identifier: MIT
//
// A checked glTF file as tinygltf's structures, with the bytes of its buffers, and views of
// accessors. tinygltf is kept to these internal files.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <tiny_gltf.h>

#include "internal/gltf_animation.hpp"
#include "internal/gltf_file.hpp"
#include "internal/gltf_format.hpp"

namespace gnomon::scene::internal {

struct ImageSource {
    std::string name;
    std::string uri;  ///< empty: in the buffer view
    int buffer_view = -1;
};

struct GltfModel {
    std::string file;  ///< as messages call it
    std::optional<std::filesystem::path> folder;
    tinygltf::Model model;  ///< without buffers, images and animations
    std::vector<std::vector<std::byte>> buffers;
    std::vector<ImageSource> images;
    std::vector<AnimationSource> animations;
};

/// Checks the file, loads its buffers and hands the rest to tinygltf. Throws InputError.
[[nodiscard]] GltfModel load_model(GltfFile file);

/// The bytes of a buffer view.
[[nodiscard]] std::span<const std::byte> view_bytes(const GltfModel& model, int buffer_view);

/// Reads elements of one accessor where they lie, sparse substitutions included. Elements are read
/// on demand: the cost is that of what is asked for, not of the accessor's size.
class AccessorView {
public:
    /// Throws InputError when the indices of a sparse accessor do not increase or are too large.
    AccessorView(const GltfModel& model, int accessor);

    [[nodiscard]] std::size_t count() const { return count_; }
    /// Component `c` of element `i`, normalized if the accessor says so. A matrix's components go
    /// column by column.
    [[nodiscard]] double get(std::size_t i, std::size_t c) const;
    /// An unsigned scalar as it is.
    [[nodiscard]] std::uint32_t get_index(std::size_t i) const;

private:
    [[nodiscard]] const std::byte* element(std::size_t i) const;

    const std::byte* base_ = nullptr;  // null: all zero
    std::size_t stride_ = 0;
    std::size_t count_ = 0;
    std::size_t element_bytes_ = 0;
    ElementShape shape_;
    Component component_ = Component::F32;
    bool normalized_ = false;
    std::vector<std::uint32_t> sparse_indices_;
    const std::byte* sparse_values_ = nullptr;
};

}  // namespace gnomon::scene::internal
