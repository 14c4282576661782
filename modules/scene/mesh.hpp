// SPDX-License-Identifier: MIT
//
// Mesh, material, image: what a scene is drawn with, as plain arrays. Nothing here knows of a GPU
// or of shadows.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/scene/mesh_deformation.hpp>

#pragma GCC visibility push(default)
namespace gnomon::scene {

/// A picture in memory.
struct Image {
    std::string name;                ///< as the file has it
    std::uint32_t width = 0;         ///< pixels
    std::uint32_t height = 0;        ///< pixels
    std::vector<std::uint8_t> rgba;  ///< 4 bytes a pixel, sRGB-encoded, row 0 on top
};

/// What a material's alpha means, as glTF has it.
enum class AlphaMode : std::uint8_t {
    Opaque,  ///< nothing
    Mask,    ///< what is less than Material::alpha_cutoff is not drawn; shadows are those of whole
             ///< triangles
    Blend,   ///< transparency; shadows are those of whole triangles
};

/// How a surface looks.
struct Material {
    std::string name;                               ///< as the file has it
    glm::vec4 base_color{1.0F};                     ///< linear
    float metallic = 0.0F;                          ///< 0 .. 1
    float roughness = 0.8F;                         ///< 0 .. 1
    glm::vec3 emissive{0.0F};                       ///< linear
    std::shared_ptr<const Image> base_color_image;  ///< may be null
    AlphaMode alpha_mode = AlphaMode::Opaque;       ///< what alpha means
    float alpha_cutoff = 0.5F;                      ///< for AlphaMode::Mask
    bool double_sided =
        false;  ///< for shading alone: both sides are in the depth buffer in any case
};

/// A run of triangles that share a material.
struct SubMesh {
    std::uint32_t first_index = 0;  ///< into Mesh::indices
    std::uint32_t index_count = 0;  ///< a multiple of three
    std::uint32_t material = 0;     ///< index into Scene::materials
};

/// Triangles of one mesh, all its primitives together. Immutable once it is in a scene; nodes share
/// it.
struct Mesh {
    std::string name;  ///< as the file has it
    /// Where the origin of `positions` lies in the mesh's own space: true position = origin +
    /// position, exactly. Not zero only for meshes modelled far from their origin, whose
    /// coordinates would cancel badly in single precision.
    glm::dvec3 origin{0.0};
    std::vector<glm::vec3> positions;  ///< metres, relative to `origin`
    std::vector<glm::vec3>
        normals;  ///< unit; one per position (made from the faces where a file has none)
    std::vector<glm::vec2> texcoords;    ///< one per position; empty when no primitive has any
    std::vector<std::uint32_t> indices;  ///< three a triangle, counter-clockwise from outside
    std::vector<SubMesh> sub_meshes;     ///< cover `indices` without gap or overlap, in order
    /// Joints' weights and morph targets; null for most meshes. What is above is then the pose that
    /// it was bound in.
    std::shared_ptr<const MeshDeformation> deformation = nullptr;

    /// Of all sub-meshes.
    [[nodiscard]] std::size_t triangle_count() const { return indices.size() / 3; }
};

}  // namespace gnomon::scene
#pragma GCC visibility pop
