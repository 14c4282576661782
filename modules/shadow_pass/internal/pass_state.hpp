// SPDX-License-Identifier: MIT
//
// What a ShadowPass holds: what prepare() (shadow_pass.cpp, prepared_lights.cpp) uploads, and what
// record() (recording.cpp) draws of it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include <gnomon/shadow_pass/shadow_pass.hpp>

#include "background_clear.hpp"
#include "buffer_arena.hpp"
#include "gpu_quads.hpp"
#include "mesh_runs.hpp"
#include "pipeline_sets.hpp"
#include "prepared_light.hpp"
#include "stencil_fold.hpp"
#include "volume_draws.hpp"
#include "volume_instances.hpp"
#include "volume_pipelines.hpp"

namespace gnomon::shadow_pass {

using internal::ArenaRun;
using internal::Call;
using internal::PreparedLight;
using internal::Run;
using internal::VertexStage;
using shadows::Technique;

struct ShadowPass::State {
    gpu::Device* device = nullptr;
    ShadowPassDesc desc;
    gpu::Shader vertex;
    gpu::Shader fragment;
    std::optional<internal::PipelineSets> pipelines;
    // What lights that are split into batches need more, made when the first one comes.
    std::optional<internal::StencilFold> fold;
    // What lights whose background is cleared need more, made when the first one comes.
    std::optional<internal::BackgroundClear> background;
    // What volumes from quads on every edge need, made when the first one comes.
    std::optional<internal::GpuQuads> quads;

    struct VolumeRun {
        ArenaRun run;
        // What is there: [begin, end) of Volume::indices.
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
        std::uint64_t used = 0;
    };
    struct Vertices {
        gpu::BufferId buffer;
        std::int32_t base_vertex = 0;
    };
    internal::BufferArena vertices;
    internal::BufferArena indices;
    internal::MeshRuns mesh_vertices{internal::append_doubled_positions};
    internal::MeshRuns mesh_caps{internal::append_near_caps};
    std::unordered_map<std::uint64_t, VolumeRun> volumes;  // by revision
    std::vector<gpu::Buffer> extruded;                     // by draw, on the CPU path
    std::vector<std::uint64_t> extruded_sizes;
    internal::VolumeInstances instances;
    std::uint64_t generation = 0;
    // What was prepared last; 0 for a list of no system, or after a failure.
    std::uint64_t prepared_revision = 0;
    shadows::View prepared_view;
    bool mirrored_view = false;  // front and back exchange in all that it shows
    TargetSize target;  // zero: not known
    std::vector<PreparedLight> lights;
    std::uint64_t recording_revision = 0;  // of what record() records
    std::size_t recorded_lights = 0;
    PassStats stats;
    // Between two lights' worth of work, for their memory alone.
    std::vector<Run> runs;
    std::vector<std::size_t> run_ends;  // of each key
    std::vector<internal::DrawKey> keys;

    State(gpu::Device& d, const ShadowPassDesc& description);

    // Once (shadow_pass.cpp).
    Status create_shaders();
    [[nodiscard]] VertexStage volume_stage() const { return {{}, vertex, vertex_layouts()}; }
    Status create_quads(const shadows::DrawList& list);
    Status create_batching();
    Status create_background();
    [[nodiscard]] std::vector<gpu::VertexBufferLayout> vertex_layouts() const;

    // Each time something changed.
    Status prepare(const shadows::DrawList& list, const shadows::View& view, bool any_quads);
    Status create_what_is_new(const shadows::DrawList& list, bool any_quads);
    void free_unused();
    void forget();

    // Light by light (prepared_lights.cpp).
    /// False where all are as they were.
    bool find_changed_lights(const shadows::DrawList& list, bool finite);
    void make_keys(const shadows::DrawList& list, const shadows::LightDraws& light,
                   const PreparedLight* before);
    void add_key(const shadows::VolumeDraw& draw, const shadows::VolumeSlab* slab,
                 std::uint32_t instance, const PreparedLight* before);
    Status make_calls(const shadows::DrawList& list, PreparedLight& light);
    /// `of_draw`: its slabs' keys, or its own.
    Status add_calls(const shadows::DrawList& list, std::uint32_t i,
                     std::span<const internal::DrawKey> of_draw, PreparedLight& light);
    Status add_quad_calls(const shadows::DrawList& list, std::uint32_t i,
                          const internal::DrawKey& key, PreparedLight& light);
    [[nodiscard]] bool unclipped(const PreparedLight& light) const {
        return light.finite && device->caps().features.unclipped_depth;
    }
    Result<Vertices> vertices_of(const shadows::VolumeDraw& draw, std::uint32_t i,
                                 PreparedLight& light);
    Result<gpu::BufferId> extruded_vertices_of(std::size_t index, const shadows::VolumeDraw& draw);
    Result<VolumeRun*> indices_of(const shadows::VolumeDraw& draw);

    // At least what `bounds` cover: begun where the adapter cuts exactly.
    [[nodiscard]] shadows::PixelRect scissor_of(const shadows::ScreenBounds& bounds) const {
        shadows::PixelRect rect = shadows::pixels_of(bounds, target.width, target.height);
        if (desc.sample_count == 1) return rect;
        const std::uint32_t grid = device->caps().limits.multisample_scissor_alignment;
        rect.width += rect.x % grid;
        rect.height += rect.y % grid;
        rect.x -= rect.x % grid;
        rect.y -= rect.y % grid;
        return rect;
    }
    [[nodiscard]] shadows::PixelRect everything() const {
        return {0, 0, target.width, target.height};
    }
    // Not by depth-fail: SwiftShader counts what is outside of the bounds as depth that fails.
    [[nodiscard]] shadows::DepthBounds depth_of(const shadows::VolumeDraw& draw) const {
        const bool bounded =
            draw.technique == Technique::DepthPass && internal::has_depth_bounds(*device, desc);
        return bounded ? draw.depth : shadows::DepthBounds{};
    }

    // recording.cpp
    void record(gpu::RenderPassEncoder& encoder, std::size_t light,
                std::optional<Fill> metered) const;
};

}  // namespace gnomon::shadow_pass
