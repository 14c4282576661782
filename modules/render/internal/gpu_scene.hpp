// SPDX-License-Identifier: MIT
//
// What of a scene lives on the GPU: vertex and index buffers per mesh, vertex buffers of its own
// for each deformed instance, one bind group per material.
#pragma once

#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include <gnomon/gpu/device.hpp>
#include <gnomon/scene/scene.hpp>

namespace gnomon::render::internal {

struct GpuVertices {
    gpu::Buffer positions;   // 3 floats, slot 0: a stream of their own, so that depth-only passes
                             // read nothing else
    gpu::Buffer attributes;  // normal and texcoord, 5 floats, slot 1
};

struct GpuMesh {
    std::shared_ptr<const scene::Mesh> mesh;
    std::optional<GpuVertices> vertices;  // made when an instance that is not deformed is drawn
    gpu::Buffer indices;
    gpu::Buffer line_indices;  // two per triangle side, made when first asked for
};

class GpuScene {
public:
    explicit GpuScene(gpu::Device& device) : device_(&device) {}

    Status create();
    /// Uploads meshes and materials that are not there yet; forgets those that left the scene.
    Status upload(const scene::Scene& scene);
    Status ensure_lines(GpuMesh& mesh);
    /// The vertices of an instance of `mesh`, uploaded where they are not there as they are now.
    /// The pointer is good until the next upload().
    Result<const GpuVertices*> vertices_of(scene::Entity entity, GpuMesh& mesh,
                                           const scene::Geometry& geometry);

    [[nodiscard]] GpuMesh* find(const scene::Mesh* mesh);
    [[nodiscard]] gpu::BindGroupLayoutId material_layout() const { return material_layout_; }
    [[nodiscard]] gpu::BindGroupId material(std::size_t index) const { return materials_[index]; }
    /// Whether a fragment of the material may be left out.
    [[nodiscard]] bool has_holes(std::size_t index) const { return has_holes_[index]; }

private:
    Result<gpu::Buffer> create_buffer(const char* label, std::span<const std::byte> bytes,
                                      gpu::BufferUsage usage);
    Status upload_mesh(const std::shared_ptr<const scene::Mesh>& mesh);
    Status write_vertices(GpuVertices& vertices, const scene::Mesh& mesh,
                          const scene::Geometry& geometry);
    Status upload_materials(const std::vector<scene::Material>& materials);
    Result<gpu::TextureId> texture_of(const std::shared_ptr<const scene::Image>& image);

    gpu::Device* device_;
    gpu::BindGroupLayout material_layout_;
    gpu::Sampler sampler_;
    gpu::Texture white_;
    gpu::Buffer material_uniforms_;
    std::vector<gpu::BindGroup> materials_;
    std::vector<bool> has_holes_;  // by material
    std::unordered_map<const scene::Image*, gpu::Texture> textures_;
    std::unordered_map<const scene::Mesh*, GpuMesh> meshes_;
    struct DeformedVertices {
        GpuVertices vertices;
        std::uint64_t revision = 0;
        const scene::Mesh* mesh = nullptr;
    };
    std::unordered_map<std::uint64_t, DeformedVertices> deformed_;  // by entity
};

}  // namespace gnomon::render::internal
