// SPDX-License-Identifier: MIT
#include "internal/gltf_skin.hpp"

#include <cmath>

#include <fmt/format.h>

#include "internal/json_place.hpp"
#include "internal/mesh_normals.hpp"
#include "internal/mesh_origin.hpp"

namespace gnomon::scene::internal {
namespace {

glm::dmat4 blend(const Influence& influence, const std::vector<glm::dmat4>& matrices,
                 const GltfModel& model, const std::string& place, std::size_t vertex) {
    glm::dmat4 sum(0.0);
    double weight_sum = 0.0;
    for (std::size_t k = 0; k < influence.joints.size(); ++k) {
        const double weight = influence.weights[k];
        if (weight == 0.0) continue;
        if (influence.joints[k] >= matrices.size()) {
            refuse_input(model.file,
                         fmt::format("{}: vertex {} of its mesh uses joint {}, but the "
                                     "skin has only {}",
                                     place, vertex, influence.joints[k], matrices.size()));
        }
        sum += matrices[influence.joints[k]] * weight;
        weight_sum += weight;
    }
    // Weights are rounded in files and often miss 1 by their last digit.
    return weight_sum > 1e-6 ? sum / weight_sum : matrices.front();
}

}  // namespace

std::vector<glm::dmat4> inverse_bind_matrices(const GltfModel& model, const tinygltf::Skin& skin) {
    std::vector<glm::dmat4> matrices(skin.joints.size(), glm::dmat4(1.0));
    if (skin.inverseBindMatrices < 0) return matrices;
    const AccessorView view(model, skin.inverseBindMatrices);
    for (std::size_t i = 0; i < matrices.size(); ++i) {
        for (std::size_t c = 0; c < 16; ++c) {
            const double value = view.get(i, c);
            if (!std::isfinite(value)) {
                refuse_input(model.file, fmt::format("accessors[{}]: inverse bind matrix {} is not "
                                                     "finite",
                                                     skin.inverseBindMatrices, i));
            }
            matrices[i][static_cast<int>(c / 4)][static_cast<int>(c % 4)] = value;
        }
    }
    return matrices;
}

std::shared_ptr<const Mesh> pose_mesh(const BuiltMesh& built,
                                      const std::vector<glm::dmat4>& joint_matrices,
                                      const GltfModel& model, const std::string& place) {
    Mesh mesh = *built.mesh;
    mesh.origin = glm::dvec3(0.0);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dmat4 matrix = blend(built.influences[i], joint_matrices, model, place, i);
        const glm::dvec3 bound = built.mesh->origin + glm::dvec3(mesh.positions[i]);
        mesh.positions[i] = glm::vec3(glm::dvec3(matrix * glm::dvec4(bound, 1.0)));
        const glm::vec3& p = mesh.positions[i];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
            refuse_input(model.file,
                         fmt::format("{}: its joints move vertex {} to ({}, {}, {}), but it must "
                                     "stay finite",
                                     place, i, p.x, p.y, p.z));
        }
        // The cofactor matrix: the inverse transpose times the determinant, which singular joints
        // have too.
        const glm::dmat3 linear(matrix);
        const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]),
                                   glm::cross(linear[2], linear[0]),
                                   glm::cross(linear[0], linear[1]));
        const glm::dvec3 normal = cofactors * glm::dvec3(mesh.normals[i]);
        const double length = glm::length(normal);
        mesh.normals[i] =
            length > 0.0 && std::isfinite(length) ? glm::vec3(normal / length) : glm::vec3(0.0F);
    }
    repair_normals(mesh);
    rebase_far_mesh(mesh);
    return std::make_shared<const Mesh>(std::move(mesh));
}

}  // namespace gnomon::scene::internal
