// SPDX-License-Identifier: MIT
//
// What a ShadowPass holds: what prepare() (shadow_pass.cpp) uploads, and what record()
// (recording.cpp) draws of it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include <gnomon/shadow_pass/shadow_pass.hpp>

#include "background_clear.hpp"
#include "gpu_quads.hpp"
#include "index_arena.hpp"
#include "mesh_caps.hpp"
#include "pipeline_sets.hpp"
#include "stencil_fold.hpp"
#include "volume_draws.hpp"
#include "volume_pipelines.hpp"

namespace gnomon::shadow_pass {

using internal::Run;
using internal::VertexStage;
using shadows::Technique;

struct ShadowPass::State {
    gpu::Device* device = nullptr;
    ShadowPassDesc desc;
    gpu::BindGroupLayout layout;
    gpu::Shader vertex;
    gpu::Shader fragment;
    std::optional<internal::PipelineSets> pipelines;
    // What lights that are split into batches need more, made when the first one comes.
    std::optional<internal::StencilFold> fold;
    // What lights whose background is cleared need more, made when the first one comes.
    std::optional<internal::BackgroundClear> background;
    // What volumes from quads on every edge need, made when the first one comes.
    std::optional<internal::GpuQuads> quads;
    std::uint32_t uniform_stride = 256;
    gpu::Buffer uniforms;
    std::uint64_t uniforms_size = 0;
    gpu::BindGroup bind_group;
    gpu::BindGroupId quad_uniforms;

    struct MeshVertices {
        gpu::Buffer buffer;
        std::uint64_t used = 0;
    };
    struct VolumeRun {
        internal::IndexRun run;
        // What is there: [begin, end) of Volume::indices.
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
        std::uint64_t used = 0;
    };
    std::unordered_map<std::uint64_t, MeshVertices> meshes;  // by ShadowMesh::id
    std::unordered_map<std::uint64_t, VolumeRun> volumes;    // by revision
    std::vector<gpu::Buffer> extruded;                       // by draw, on the CPU path
    std::vector<std::uint64_t> extruded_sizes;
    internal::IndexArena indices;
    internal::MeshCaps mesh_caps;
    std::uint64_t generation = 0;
    // What was prepared last; 0 for a list of no system, or after a failure.
    std::uint64_t prepared_revision = 0;
    shadows::View prepared_view;
    TargetSize target;  // zero: not known

    struct Recorded {
        gpu::BufferId vertices;
        VolumeRun indices;
        internal::IndexRun mesh_caps;  // where a run is of them
        bool exchanged = false;
        bool unclipped = false;
        Technique technique = Technique::DepthFail;
        std::vector<Run> runs;
        std::uint32_t batch = 0;
        std::shared_ptr<const shadows::Volume> volume;
        std::vector<Run> near_caps;  // for Part::Caps, where it may be asked for
        shadows::QuadFacing quads = shadows::QuadFacing::None;
        gpu::BindGroupId quad_textures = {};
        shadows::PixelRect scissor = {};  // of State::target, if that is known
    };
    std::vector<Recorded> recorded;
    std::vector<shadows::LightDraws> lights;
    PassStats stats;

    State(gpu::Device& d, const ShadowPassDesc& description)
        : device(&d), desc(description), indices(d) {}

    Status create_shaders();
    [[nodiscard]] VertexStage volume_stage() const { return {{layout}, vertex, {vertex_layout()}}; }
    Status create_quads(const shadows::DrawList& list);
    Status create_batching();
    Status create_background();
    [[nodiscard]] gpu::VertexBufferLayout vertex_layout() const;
    Status write_uniforms(const shadows::DrawList& list, const shadows::View& view);
    Result<gpu::BufferId> vertices_of(const shadows::ShadowMesh& mesh);
    Result<gpu::BufferId> extruded_vertices_of(std::size_t index, const shadows::VolumeDraw& draw);
    Result<VolumeRun> indices_of(const shadows::VolumeDraw& draw, std::span<const Run> runs);
    void free_unused();
    [[nodiscard]] shadows::PixelRect scissor_of(const shadows::ScreenBounds& bounds) const {
        return shadows::pixels_of(bounds, target.width, target.height);
    }
    [[nodiscard]] shadows::PixelRect everything() const {
        return {0, 0, target.width, target.height};
    }
    // `current`: what is set.
    static void set_scissor(gpu::RenderPassEncoder& encoder, const shadows::PixelRect& wanted,
                            shadows::PixelRect& current);
    void record(gpu::RenderPassEncoder& encoder, std::size_t light,
                std::optional<Fill> metered) const;
    // `bound`: the chunk of indices that is, if any.
    void draw(gpu::RenderPassEncoder& encoder, const Recorded& volume, const Run& run,
              std::optional<std::uint32_t>& bound) const;
};

}  // namespace gnomon::shadow_pass
