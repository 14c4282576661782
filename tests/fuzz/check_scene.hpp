// SPDX-License-Identifier: MIT
//
// What a reader of scenes promises about whatever it accepts.
#pragma once

#include <cmath>

#include <gnomon/scene/components.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/shadows/shadow_system.hpp>

#include "fuzz_input.hpp"

namespace gnomon::test {

inline void require_good_mesh(const scene::Scene& scene, const scene::Mesh& mesh) {
    require(mesh.normals.size() == mesh.positions.size(), "every position has a normal");
    for (const glm::vec3& normal : mesh.normals) {
        require(std::abs(glm::length(normal) - 1.0F) < 1e-4F, "normals are unit vectors");
    }
    require(mesh.texcoords.empty() || mesh.texcoords.size() == mesh.positions.size(),
            "every position has a texture coordinate, or none has");
    std::size_t covered = 0;
    for (const scene::SubMesh& part : mesh.sub_meshes) {
        require(part.first_index == covered, "sub-meshes follow each other");
        require(part.material < scene.materials.size(), "a sub-mesh's material is in the scene");
        covered += part.index_count;
    }
    require(covered == mesh.indices.size(), "sub-meshes cover all indices");
}

inline void require_good_scene(const scene::Scene& scene) {
    scene.registry.each<scene::MeshInstance>(
        [&](scene::Entity, const scene::MeshInstance& instance) {
            require(instance.mesh != nullptr, "an instance has a mesh");
            require_good_mesh(scene, *instance.mesh);
        });
    scene.registry.each<scene::Deformed>([&](scene::Entity, const scene::Deformed& deformed) {
        require(deformed.positions.size() == deformed.mesh->positions.size() &&
                    deformed.normals.size() == deformed.positions.size(),
                "a deformed instance has the vertices of its mesh");
        for (const glm::vec3& normal : deformed.normals) {
            require(std::abs(glm::length(normal) - 1.0F) < 1e-4F, "deformed normals are unit");
        }
    });
    auto system = shadows::ShadowSystem::create();
    auto frame = system->begin_frame();
    scene::ShadowAdapter adapter;
    const Status submitted = adapter.submit(scene, frame);
    require(submitted.has_value(), "what a reader accepts can cast shadows");
}

}  // namespace gnomon::test
