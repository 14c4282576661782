// SPDX-License-Identifier: MIT
//
// What of a scene lives on the GPU: vertex and index buffers per mesh, one bind group per material.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include <gnomon/gpu/device.hpp>
#include <gnomon/scene/scene.hpp>

namespace gnomon::render::internal {

struct GpuMesh {
    std::shared_ptr<const scene::Mesh> mesh;
    gpu::Buffer positions;   // 3 floats, slot 0: a stream of their own, so that depth-only passes
                             // read nothing else
    gpu::Buffer attributes;  // normal and texcoord, 5 floats, slot 1
    gpu::Buffer indices;
    gpu::Buffer line_indices;  // two per triangle side, made when first asked for
    glm::dvec3 center{0.0};
    double radius = 0.0;
};

class GpuScene {
public:
    explicit GpuScene(gpu::Device& device) : device_(&device) {}

    Status create();
    /// Uploads meshes and materials that are not there yet; forgets those that left the scene.
    Status upload(const scene::Scene& scene);
    Status ensure_lines(GpuMesh& mesh);

    [[nodiscard]] GpuMesh* find(const scene::Mesh* mesh);
    [[nodiscard]] gpu::BindGroupLayoutId material_layout() const { return material_layout_; }
    [[nodiscard]] gpu::BindGroupId material(std::size_t index) const { return materials_[index]; }

private:
    Result<gpu::Buffer> create_buffer(const char* label, std::span<const std::byte> bytes,
                                      gpu::BufferUsage usage);
    Status upload_mesh(const std::shared_ptr<const scene::Mesh>& mesh);
    Status upload_materials(const std::vector<scene::Material>& materials);
    Result<gpu::TextureId> texture_of(const std::shared_ptr<const scene::Image>& image);

    gpu::Device* device_;
    gpu::BindGroupLayout material_layout_;
    gpu::Sampler sampler_;
    gpu::Texture white_;
    gpu::Buffer material_uniforms_;
    std::vector<gpu::BindGroup> materials_;
    std::unordered_map<const scene::Image*, gpu::Texture> textures_;
    std::unordered_map<const scene::Mesh*, GpuMesh> meshes_;
};

}  // namespace gnomon::render::internal
