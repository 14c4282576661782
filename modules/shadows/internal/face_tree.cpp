// SPDX-License-Identifier: MIT
#include "face_tree.hpp"

#include <memory>

namespace gnomon::shadows::internal {

namespace {

/// What a search costs, up to a factor, whatever the size of it all.
double search_cost(const BoxTree<float>& tree) {
    const glm::dvec3 size = 2.0 * tree.bounds().half();
    const double around = size.x * size.y + size.y * size.z + size.z * size.x;
    return around > 0.0 ? tree.area() / around : 0.0;
}

}  // namespace

FaceTree::FaceTree(const ShadowMesh& mesh, FaceTreeShape& shape) {
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
    // The same faces, in the same order, in every pose.
    std::call_once(shape.made, [&] { shape.tree = BoxTree<float>(boxes, 4); });
    tree_ = shape.tree;
    if (!tree_.empty()) {
        tree_.refit(boxes);
        if (search_cost(tree_) > 2.0 * search_cost(shape.tree)) tree_ = BoxTree<float>(boxes, 4);
    }
    triangles_.reserve(triangles.size());
    for (const std::uint32_t i : tree_.order()) triangles_.push_back(triangles[i]);
}

const FaceTree& face_tree(const ShadowMesh& mesh) {
    std::call_once(mesh.face_tree_once_, [&] {
        mesh.face_tree_ = std::make_shared<const FaceTree>(mesh, *mesh.face_tree_shape_);
    });
    return *mesh.face_tree_;
}

}  // namespace gnomon::shadows::internal
