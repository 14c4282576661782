// SPDX-License-Identifier: MIT
//
// Box and plane: the flat ones. The round ones are in primitives_round.cpp.
#include <gnomon/scene/primitives.hpp>

#include <gnomon/core/expects.hpp>

namespace gnomon::scene {

Mesh make_box(const glm::vec3& size, std::uint32_t material) {
    Mesh mesh;
    mesh.name = "box";
    const glm::vec3 half = size * 0.5F;
    // Each side is spanned by two axes u, v with u x v = the outward normal.
    struct Side {
        int normal_axis, u_axis, v_axis;
        float sign;
    };
    constexpr std::array<Side, 6> sides{{{0, 1, 2, 1.0F},
                                         {0, 2, 1, -1.0F},
                                         {1, 2, 0, 1.0F},
                                         {1, 0, 2, -1.0F},
                                         {2, 0, 1, 1.0F},
                                         {2, 1, 0, -1.0F}}};
    constexpr std::array<glm::vec2, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (const Side& side : sides) {
        const auto base = static_cast<std::uint32_t>(mesh.positions.size());
        glm::vec3 normal{0.0F};
        normal[side.normal_axis] = side.sign;
        for (const glm::vec2& corner : corners) {
            glm::vec3 position{0.0F};
            position[side.normal_axis] = side.sign * half[side.normal_axis];
            position[side.u_axis] = corner.x > 0.5F ? half[side.u_axis] : -half[side.u_axis];
            position[side.v_axis] = corner.y > 0.5F ? half[side.v_axis] : -half[side.v_axis];
            mesh.positions.push_back(position);
            mesh.normals.push_back(normal);
            mesh.texcoords.push_back(corner);
        }
        for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(base + i);
    }
    mesh.sub_meshes.push_back({0, static_cast<std::uint32_t>(mesh.indices.size()), material});
    return mesh;
}

Mesh make_plane(float size_x, float size_z, std::uint32_t cells, std::uint32_t material) {
    GNOMON_EXPECTS(cells >= 1);
    Mesh mesh;
    mesh.name = "plane";
    const std::uint32_t row = cells + 1;
    for (std::uint32_t z = 0; z < row; ++z) {
        for (std::uint32_t x = 0; x < row; ++x) {
            const glm::vec2 at =
                glm::vec2(static_cast<float>(x), static_cast<float>(z)) / static_cast<float>(cells);
            mesh.positions.emplace_back((at.x - 0.5F) * size_x, 0.0F, (at.y - 0.5F) * size_z);
            mesh.normals.emplace_back(0.0F, 1.0F, 0.0F);
            mesh.texcoords.push_back(at);
        }
    }
    for (std::uint32_t z = 0; z < cells; ++z) {
        for (std::uint32_t x = 0; x < cells; ++x) {
            const std::uint32_t a = z * row + x;
            for (const std::uint32_t i : {a, a + row, a + row + 1, a, a + row + 1, a + 1}) {
                mesh.indices.push_back(i);
            }
        }
    }
    mesh.sub_meshes.push_back({0, static_cast<std::uint32_t>(mesh.indices.size()), material});
    return mesh;
}

}  // namespace gnomon::scene
