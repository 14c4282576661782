// SPDX-License-Identifier: MIT
//
// Numbers of the glTF 2.0 format that both the checks and the readers need.
#pragma once

#include <cstddef>
#include <cstdint>

namespace gnomon::scene::internal {

/// accessor.componentType
enum class Component : int { I8 = 5120, U8 = 5121, I16 = 5122, U16 = 5123, U32 = 5125, F32 = 5126 };

/// Bytes of one component; 0 for a number that names none.
constexpr std::size_t component_size(int component_type) {
    switch (static_cast<Component>(component_type)) {
        case Component::I8:
        case Component::U8: return 1;
        case Component::I16:
        case Component::U16: return 2;
        case Component::U32:
        case Component::F32: return 4;
    }
    return 0;
}

/// An element of `columns` columns of `rows` components each; a vector is one column. Columns of a
/// matrix start on multiples of four bytes.
struct ElementShape {
    std::size_t rows = 1;
    std::size_t columns = 1;

    [[nodiscard]] constexpr std::size_t bytes(std::size_t component_bytes) const {
        const std::size_t column = rows * component_bytes;
        return columns == 1 ? column : columns * ((column + 3) / 4 * 4);
    }
};

/// primitive.mode
enum class PrimitiveMode : int {
    Points = 0,
    Lines,
    LineLoop,
    LineStrip,
    Triangles,
    TriangleStrip,
    TriangleFan
};

}  // namespace gnomon::scene::internal
