// SPDX-License-Identifier: MIT
//
// Byte ranges were checked by check_gltf; memcpy keeps reads legal whatever the alignment.
#include <algorithm>
#include <array>
#include <cstring>

#include <fmt/format.h>

#include "internal/gltf_model.hpp"
#include "internal/json_place.hpp"

namespace gnomon::scene::internal {
namespace {

ElementShape shape_of(int tinygltf_type) {
    switch (tinygltf_type) {
        case TINYGLTF_TYPE_VEC2: return {2, 1};
        case TINYGLTF_TYPE_VEC3: return {3, 1};
        case TINYGLTF_TYPE_VEC4: return {4, 1};
        case TINYGLTF_TYPE_MAT2: return {2, 2};
        case TINYGLTF_TYPE_MAT3: return {3, 3};
        case TINYGLTF_TYPE_MAT4: return {4, 4};
        default: return {1, 1};
    }
}

template <class T>
T read_as(const std::byte* from) {
    T value{};
    std::memcpy(&value, from, sizeof value);
    return value;
}

std::uint32_t read_unsigned(const std::byte* from, Component component) {
    switch (component) {
        case Component::U8: return read_as<std::uint8_t>(from);
        case Component::U16: return read_as<std::uint16_t>(from);
        default: return read_as<std::uint32_t>(from);
    }
}

}  // namespace

std::span<const std::byte> view_bytes(const GltfModel& model, int buffer_view) {
    const auto& view = model.model.bufferViews[static_cast<std::size_t>(buffer_view)];
    const auto& buffer = model.buffers[static_cast<std::size_t>(view.buffer)];
    return std::span(buffer).subspan(view.byteOffset, view.byteLength);
}

AccessorView::AccessorView(const GltfModel& model, int index) {
    const auto& accessor = model.model.accessors[static_cast<std::size_t>(index)];
    count_ = accessor.count;
    component_ = static_cast<Component>(accessor.componentType);
    normalized_ = accessor.normalized;
    shape_ = shape_of(accessor.type);
    element_bytes_ = shape_.bytes(component_size(accessor.componentType));
    if (accessor.bufferView >= 0) {
        const auto& view = model.model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
        base_ = view_bytes(model, accessor.bufferView).data() + accessor.byteOffset;
        stride_ = view.byteStride != 0 ? view.byteStride : element_bytes_;
    }
    if (!accessor.sparse.isSparse) return;

    const auto& sparse = accessor.sparse;
    const std::byte* indices =
        view_bytes(model, sparse.indices.bufferView).data() + sparse.indices.byteOffset;
    const std::size_t size = component_size(sparse.indices.componentType);
    sparse_values_ = view_bytes(model, sparse.values.bufferView).data() + sparse.values.byteOffset;
    for (int i = 0; i < sparse.count; ++i) {
        const std::uint32_t at =
            read_unsigned(indices + static_cast<std::size_t>(i) * size,
                          static_cast<Component>(sparse.indices.componentType));
        if (at >= count_ || (!sparse_indices_.empty() && at <= sparse_indices_.back())) {
            refuse_input(model.file,
                         fmt::format("accessors[{}].sparse.indices: element {} is {}, but must be "
                                     "larger than the one before and less than {}",
                                     index, i, at, count_));
        }
        sparse_indices_.push_back(at);
    }
}

const std::byte* AccessorView::element(std::size_t i) const {
    if (!sparse_indices_.empty()) {
        const auto found = std::lower_bound(sparse_indices_.begin(), sparse_indices_.end(), i);
        if (found != sparse_indices_.end() && *found == i) {
            return sparse_values_ +
                   static_cast<std::size_t>(found - sparse_indices_.begin()) * element_bytes_;
        }
    }
    return base_ == nullptr ? nullptr : base_ + i * stride_;
}

double AccessorView::get(std::size_t i, std::size_t c) const {
    const std::byte* from = element(i);
    if (from == nullptr) return 0.0;
    const std::size_t size = component_size(static_cast<int>(component_));
    const std::size_t column_bytes = element_bytes_ / shape_.columns;
    from += c / shape_.rows * column_bytes + c % shape_.rows * size;
    const auto scaled = [this](double value, double largest) {
        return normalized_ ? std::max(value / largest, -1.0) : value;
    };
    switch (component_) {
        case Component::I8: return scaled(read_as<std::int8_t>(from), 127.0);
        case Component::U8: return scaled(read_as<std::uint8_t>(from), 255.0);
        case Component::I16: return scaled(read_as<std::int16_t>(from), 32767.0);
        case Component::U16: return scaled(read_as<std::uint16_t>(from), 65535.0);
        case Component::U32: return read_as<std::uint32_t>(from);
        case Component::F32: return read_as<float>(from);
    }
    return 0.0;
}

std::uint32_t AccessorView::get_index(std::size_t i) const {
    const std::byte* from = element(i);
    return from == nullptr ? 0 : read_unsigned(from, component_);
}

}  // namespace gnomon::scene::internal
