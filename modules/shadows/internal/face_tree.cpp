// SPDX-License-Identifier: MIT
#include "face_tree.hpp"

#include <memory>

namespace gnomon::shadows::internal {

FaceTree::FaceTree(const ShadowMesh& mesh) {
    std::vector<Triangle> triangles;
    std::vector<Box<float>> boxes;
    for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
        const auto& [a, b, c] = mesh.faces()[f];
        if (a == b || b == c || c == a) continue;
        const auto positions = mesh.positions();
        const Triangle triangle{positions[a], positions[b], positions[c]};
        Box<float> box;
        for (const glm::vec3& corner : triangle) box.add(corner);
        triangles.push_back(triangle);
        boxes.push_back(box);
    }
    tree_ = BoxTree<float>(boxes, 4);
    triangles_.reserve(triangles.size());
    for (const std::uint32_t i : tree_.order()) triangles_.push_back(triangles[i]);
}

const FaceTree& face_tree(const ShadowMesh& mesh) {
    std::call_once(mesh.face_tree_once_,
                   [&] { mesh.face_tree_ = std::make_shared<const FaceTree>(mesh); });
    return *mesh.face_tree_;
}

}  // namespace gnomon::shadows::internal
