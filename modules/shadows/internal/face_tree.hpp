// SPDX-License-Identifier: MIT
//
// FaceTree: the faces of one mesh, to be searched by shadow queries. It lives beside its mesh, so
// that all casters, scenes and threads share one.
#pragma once

#include <array>
#include <mutex>
#include <span>
#include <vector>

#include <gnomon/shadows/shadow_mesh.hpp>

#include "box_tree.hpp"

namespace gnomon::shadows::internal {

/// The tree of whichever mesh of one topology was searched first: those of the others have its
/// shape.
struct FaceTreeShape {
    std::once_flag made;
    BoxTree<float> tree;
};

class FaceTree {
public:
    using Triangle = std::array<glm::vec3, 3>;

    /// Has the shape's tree refitted, which it makes where there is none yet; but where vertices
    /// have moved so far apart that searching would take more than twice as long, a tree of its
    /// own.
    FaceTree(const ShadowMesh& mesh, FaceTreeShape& shape);

    [[nodiscard]] const BoxTree<float>& tree() const { return tree_; }
    /// By places of the tree. Faces with two equal corners, which cast nothing, are left out.
    [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }

private:
    BoxTree<float> tree_;
    std::vector<Triangle> triangles_;
};

/// The mesh's own tree, built by whichever thread asks first. Cost then: O(n log n), linear for
/// deformed meshes one of whose kind was asked about before; and about 60 bytes a triangle for as
/// long as the mesh lives.
const FaceTree& face_tree(const ShadowMesh& mesh);

}  // namespace gnomon::shadows::internal
