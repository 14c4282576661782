// SPDX-License-Identifier: MIT
//
// GpuQuads: what drawing shadow volumes from quads on every edge needs on the GPU
// (gnomon/shadows/edge_quads.hpp): the shaders, the mesh as textures that the vertex stage fetches
// from, and one bit a face for each volume. Textures, for that is what vertex stages of all kinds
// can read: WebGPU's compatibility mode and WebGL 2 have no storage buffers there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/shadows/shadow_system.hpp>

namespace gnomon::shadow_pass::internal {

/// The ranges of a Volume that `draw` would have, in vertices; it has no indices.
[[nodiscard]] shadows::Volume ranges_of(const shadows::VolumeDraw& draw);

/// The same list with volumes made by the CPU in the place of quads, for record_part() and hosts
/// whose vertex stage is not theirs. Cost: linear in the meshes, every time.
[[nodiscard]] shadows::DrawList without_quads(const shadows::DrawList& list);

class GpuQuads {
public:
    /// The device must outlive it.
    [[nodiscard]] static Result<GpuQuads> create(gpu::Device& device);

    // For pipelines: groups 0 and 1, the vertex stage. No vertex buffer is read.
    [[nodiscard]] std::vector<gpu::BindGroupLayoutId> layouts() const {
        return {uniform_layout_, texture_layout_};
    }
    [[nodiscard]] gpu::ShaderId vertex_shader(shadows::QuadFacing facing) const;

    // Once a frame, with a number that grows: first keep() what is drawn again, then free the rest.
    void keep(std::uint64_t revision, std::uint64_t frame);
    void free_unused(std::uint64_t frame);
    /// Group 1. Uploads what the GPU does not have and adds its size to `uploaded`.
    [[nodiscard]] Result<gpu::BindGroupId> textures_of(const shadows::VolumeDraw& draw,
                                                       std::uint64_t frame,
                                                       std::uint64_t& uploaded);
    /// What the shaders know of each draw that has quads. Adds its size to `uploaded`.
    [[nodiscard]] Status write_uniforms(const shadows::DrawList& list, const shadows::View& view,
                                        std::uint64_t& uploaded);
    /// Group 0, with uniform_offset() of a draw as its dynamic offset. Changes with
    /// write_uniforms().
    [[nodiscard]] gpu::BindGroupId uniforms() const { return uniform_group_; }
    /// `i`: of list.draws.
    [[nodiscard]] std::uint32_t uniform_offset(std::size_t i) const { return offsets_[i]; }

private:
    // What one volume's faces do.
    struct Facing {
        gpu::Texture texture;
        gpu::BindGroup group;
    };
    struct Mesh {
        gpu::Texture positions = {};
        gpu::Texture edges = {};
        gpu::Texture faces = {};
        Facing planes = {};             // InShader: one for all volumes; empty until asked for
        std::vector<Facing> free = {};  // of volumes that are gone
        std::uint64_t used = 0;
    };
    struct Volume {
        Facing facing;
        std::uint64_t mesh = 0;
        std::uint64_t used = 0;
    };

    explicit GpuQuads(gpu::Device& device) : device_(&device) {}
    Status create_objects();
    Result<gpu::Texture> make_texture(const std::string& label, std::size_t elements,
                                      gpu::Format format);
    Status fill(const gpu::Texture& texture, std::span<const std::byte> bytes,
                std::size_t element_bytes, std::uint64_t& uploaded);
    template <class T>
    Result<gpu::Texture> texture_of(const std::string& label, const std::vector<T>& elements,
                                    std::uint64_t& uploaded);
    Result<Mesh*> mesh_of(const shadows::ShadowMesh& mesh, std::uint64_t frame,
                          std::uint64_t& uploaded);
    Status bind(const Mesh& mesh, Facing& facing);

    gpu::Device* device_;
    gpu::BindGroupLayout uniform_layout_;
    gpu::BindGroupLayout texture_layout_;
    std::array<gpu::Shader, 2> shaders_;
    gpu::Buffer uniform_buffer_;
    std::uint64_t uniform_capacity_ = 0;
    std::vector<std::byte> uniform_bytes_;
    std::vector<std::uint32_t> offsets_;  // by draw
    gpu::BindGroup uniform_group_;
    std::unordered_map<std::uint64_t, Mesh> meshes_;     // by ShadowMesh::id
    std::unordered_map<std::uint64_t, Volume> volumes_;  // by revision
};

}  // namespace gnomon::shadow_pass::internal
