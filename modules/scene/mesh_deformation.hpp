// SPDX-License-Identifier: MIT
//
// How a mesh may deform: which joints move its vertices, and its morph targets. Data of the mesh,
// shared by all instances; where the joints stand and how much of each target is blended in are
// components of an instance (components.hpp), and deform.hpp puts the two together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>

#pragma GCC visibility push(default)
namespace gnomon::scene {

struct Mesh;

/// A joint (its place in Skin::joints) that moves a vertex.
struct Influence {
    std::uint32_t joint = 0;  ///< which one
    double weight = 0.0;      ///< 0 .. 1

    bool operator==(const Influence&) const = default;
};

/// What is added to every vertex, times the target's weight.
struct MorphTarget {
    std::vector<glm::vec3> positions;  ///< one a vertex, or none: nothing moves
    std::vector<glm::vec3> normals;    ///< one a vertex, or none
};

/// Vertices [first, first + count).
struct VertexRange {
    std::uint32_t first = 0;  ///< the first one
    std::uint32_t count = 0;  ///< how many
};

/// Immutable once a mesh has it. Made by make_mesh_deformation().
struct MeshDeformation {
    /// Vertex v is moved by influences[first_influence[v]] up to, not including,
    /// influences[first_influence[v + 1]]. Both are empty where nothing is skinned. A vertex has at
    /// least one influence, no joint twice, joints in increasing order, and weights that add up to
    /// 1.
    std::vector<std::uint32_t> first_influence;
    std::vector<Influence> influences;    ///< vertex by vertex
    std::uint32_t joint_count = 0;        ///< no influence names a joint from here on
    std::vector<MorphTarget> targets;     ///< in the file's order
    std::vector<double> default_weights;  ///< one a target
    /// Vertices that belong to one face each, whose normals are always the face's.
    std::vector<VertexRange> flat;
    /// One number a vertex, equal exactly where position, influences and all deltas are equal: such
    /// vertices are at one place in every pose, bit for bit. For MeshView::identities.
    std::vector<std::uint32_t> identities;

    /// Whether joints move it.
    [[nodiscard]] bool is_skinned() const { return !influences.empty(); }
};

/// What a file or a program has of it.
struct MeshDeformationSource {
    std::size_t influences_per_vertex = 0;  ///< 0 where nothing is skinned
    std::vector<std::uint32_t> joints;      ///< influences_per_vertex a vertex
    std::vector<float> weights;             ///< as many; a joint of weight 0 does not count
    std::vector<MorphTarget> targets;       ///< as MeshDeformation's
    std::vector<double> default_weights;    ///< one a target, or none: all zero
    std::vector<VertexRange> flat;          ///< as MeshDeformation's
};

/// Brings influences into their one form: zero weights dropped, a joint named twice merged, weights
/// divided by their sum. A vertex whose weights are all zero follows the first joint. Fails with
/// ErrorCode::InvalidInput: arrays of the wrong length, weights that are negative or not finite,
/// deltas that are not finite. Cost: linear, one hash a vertex.
[[nodiscard]] Result<std::shared_ptr<const MeshDeformation>> make_mesh_deformation(
    const Mesh& mesh, MeshDeformationSource source);

}  // namespace gnomon::scene
#pragma GCC visibility pop
