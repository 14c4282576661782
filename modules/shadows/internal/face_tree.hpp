// SPDX-License-Identifier: MIT
//
// FaceTree: the faces of one mesh, to be searched by shadow queries. It lives beside its mesh, so
// that all casters, scenes and threads share one.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <gnomon/shadows/shadow_mesh.hpp>

#include "box_tree.hpp"

namespace gnomon::shadows::internal {

class FaceTree {
public:
    using Triangle = std::array<glm::vec3, 3>;

    explicit FaceTree(const ShadowMesh& mesh);

    [[nodiscard]] const BoxTree<float>& tree() const { return tree_; }
    /// By places of the tree. Faces with two equal corners, which cast nothing, are left out.
    [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }

private:
    BoxTree<float> tree_;
    std::vector<Triangle> triangles_;
};

/// The mesh's own tree, built by whichever thread asks first. Cost then: O(n log n), and about 60
/// bytes a triangle for as long as the mesh lives.
const FaceTree& face_tree(const ShadowMesh& mesh);

}  // namespace gnomon::shadows::internal
