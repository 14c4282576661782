// SPDX-License-Identifier: MIT
#include <gnomon/shadow_pass/shadow_pass.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include <gnomon_shaders/shadow_pass.hpp>

#include "internal/gpu_quads.hpp"
#include "internal/index_arena.hpp"
#include "internal/mesh_caps.hpp"
#include "internal/stencil_fold.hpp"
#include "internal/volume_draws.hpp"
#include "internal/volume_pipelines.hpp"

namespace gnomon::shadow_pass {

using internal::pipeline_index;
using internal::Pipelines;
using internal::Run;
using internal::VertexStage;
using shadows::Technique;

namespace {

// As the shaders have it (std140).
struct VolumeUniforms {
    glm::mat4 clip_from_local;
    glm::mat4 clip_from_far;
    glm::vec4 far_offset;
    glm::vec4 far_scale;
};

constexpr std::uint32_t quad_uniform_bytes =
    sizeof(VolumeUniforms) + sizeof(internal::QuadUniforms);

// Of a table by QuadFacing, without None.
std::size_t place_of(shadows::QuadFacing facing) {
    return facing == shadows::QuadFacing::Uploaded ? 0 : 1;
}

bool is_same_view(const shadows::View& a, const shadows::View& b) {
    return a.projection == b.projection && a.view_from_world == b.view_from_world &&
           a.clip_from_view == b.clip_from_view;
}

// The volume's indices, and behind them one line per side: the near edge that it stands on.
std::vector<std::uint32_t> with_silhouette_lines(const shadows::Volume& volume) {
    std::vector<std::uint32_t> result = volume.indices;
    const shadows::IndexRange& sides = volume.sides;
    for (std::uint32_t i = sides.first; i < sides.first + sides.count; i += 3) {
        const bool starts_a_side = volume.indices[i] % 2 == 0 && volume.indices[i + 1] % 2 == 0;
        if (starts_a_side) result.insert(result.end(), {volume.indices[i], volume.indices[i + 1]});
    }
    return result;
}

}  // namespace

struct ShadowPass::State {
    gpu::Device* device = nullptr;
    ShadowPassDesc desc;
    gpu::BindGroupLayout layout;
    gpu::Shader vertex;
    gpu::Shader fragment;
    Pipelines pipelines;
    // What lights that are split into batches need more, made when the first one comes.
    struct Batching {
        internal::StencilFold fold;
        Pipelines pipelines;
    };
    std::optional<Batching> batching;
    // What volumes from quads on every edge need, made when the first one comes: pipelines by how
    // facing is found, and the same for batches.
    struct Quads {
        internal::GpuQuads gpu;
        std::array<std::optional<Pipelines>, 2> pipelines = {};
        std::array<std::optional<Pipelines>, 2> batched = {};
    };
    std::optional<Quads> quads;
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
    Result<Pipelines> create_pipelines(const VertexStage& stage, std::uint32_t count_mask) {
        return internal::create_volume_pipelines(*device, desc, stage, fragment, count_mask);
    }
    Status create_quads(const shadows::DrawList& list);
    [[nodiscard]] const Pipelines& quad_pipelines(shadows::QuadFacing facing, bool batched) const {
        return *(batched ? quads->batched : quads->pipelines)[place_of(facing)];
    }
    Status create_batching();
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
    // `bound`: the chunk of indices that is, if any.
    void draw(gpu::RenderPassEncoder& encoder, const Recorded& volume, const Run& run,
              std::optional<std::uint32_t>& bound) const;
};

gpu::VertexBufferLayout ShadowPass::State::vertex_layout() const {
    const bool on_cpu = desc.extrusion == ExtrusionPath::Cpu;
    return {.array_stride = on_cpu ? sizeof(glm::vec4) : sizeof(glm::vec3),
            .attributes = {
                {.format = on_cpu ? gpu::VertexFormat::Float32x4 : gpu::VertexFormat::Float32x3}}};
}

Status ShadowPass::State::create_shaders() {
    auto made_layout = device->create_bind_group_layout(
        {.label = "shadow volume",
         .entries = {{.binding = 0,
                      .visibility = gpu::ShaderStage::Vertex,
                      .has_dynamic_offset = true,
                      .min_binding_size = sizeof(VolumeUniforms)}}});
    if (!made_layout) return forward_error(made_layout);
    layout = std::move(*made_layout);

    const bool on_cpu = desc.extrusion == ExtrusionPath::Cpu;
    auto made_vertex = device->create_shader(
        {.label = "shadow volume vertices",
         .stage = gpu::ShaderStage::Vertex,
         .source = on_cpu ? shaders::volume_extruded_vert : shaders::volume_vert});
    if (!made_vertex) return forward_error(made_vertex);
    vertex = std::move(*made_vertex);
    auto made_fragment = device->create_shader({.label = "shadow volume fragments",
                                                .stage = gpu::ShaderStage::Fragment,
                                                .source = shaders::volume_frag});
    if (!made_fragment) return forward_error(made_fragment);
    fragment = std::move(*made_fragment);
    return {};
}

Status ShadowPass::State::create_batching() {
    auto fold = internal::StencilFold::create(*device, desc);
    if (!fold) return forward_error(fold);
    auto made = create_pipelines(volume_stage(), internal::StencilFold::count_mask);
    if (!made) return forward_error(made);
    batching.emplace(Batching{std::move(*fold), std::move(*made)});
    return {};
}

// What the quads of this list need and was not needed before.
Status ShadowPass::State::create_quads(const shadows::DrawList& list) {
    for (const shadows::LightDraws& light : list.lights) {
        for (std::uint32_t i = light.first; i < light.first + light.count; ++i) {
            const auto& draw = list.draws[i];
            if (!draw.quads) continue;
            if (!quads) {
                auto made = internal::GpuQuads::create(*device, quad_uniform_bytes);
                if (!made) return forward_error(made);
                quads.emplace(Quads{std::move(*made)});
            }
            const bool batched = light.batches > 1;
            auto& pipelines_of =
                (batched ? quads->batched : quads->pipelines)[place_of(draw.quads->facing)];
            if (pipelines_of) continue;
            auto made = create_pipelines(
                {quads->gpu.layouts(), quads->gpu.vertex_shader(draw.quads->facing), {}},
                batched ? internal::StencilFold::count_mask : 0xFF);
            if (!made) return forward_error(made);
            pipelines_of = std::move(*made);
        }
    }
    return {};
}

Status ShadowPass::State::write_uniforms(const shadows::DrawList& list, const shadows::View& view) {
    if (list.draws.empty()) return {};
    const std::uint64_t needed = list.draws.size() * std::uint64_t{uniform_stride};
    if (needed > uniforms_size) {
        const std::uint64_t size = needed + needed / 2 / uniform_stride * uniform_stride;
        bind_group.reset();
        auto buffer =
            device->create_buffer({.label = "shadow volume matrices",
                                   .size = size,
                                   .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst});
        if (!buffer) return forward_error(buffer);
        uniforms = std::move(*buffer);
        uniforms_size = size;
        auto group = device->create_bind_group(
            {.label = "shadow volume matrices",
             .layout = layout,
             .entries = {{.binding = 0, .buffer = uniforms, .size = sizeof(VolumeUniforms)}}});
        if (!group) return forward_error(group);
        bind_group = std::move(*group);
    }
    std::vector<std::byte> bytes(needed);
    const glm::dmat4 clip_from_world = view.clip_from_world();
    for (std::size_t i = 0; i < list.draws.size(); ++i) {
        const shadows::VolumeDraw& draw = list.draws[i];
        // Products in double, rounded once: the scene must be drawn with these very bits.
        const VolumeUniforms u{glm::mat4(clip_from_world * draw.world_from_local),
                               glm::mat4(clip_from_world * draw.world_from_far),
                               draw.extrusion.offset,
                               glm::vec4(draw.extrusion.scale, 0.0F, 0.0F, 0.0F)};
        std::memcpy(bytes.data() + i * uniform_stride, &u, sizeof u);
        if (!draw.quads) continue;
        const internal::QuadUniforms more = internal::uniforms_of(draw);
        std::memcpy(bytes.data() + i * uniform_stride + sizeof u, &more, sizeof more);
    }
    stats.uploaded_bytes += needed;
    return device->write_buffer(uniforms, 0, bytes);
}

Result<gpu::BufferId> ShadowPass::State::vertices_of(const shadows::ShadowMesh& mesh) {
    const auto found = meshes.find(mesh.id());
    if (found != meshes.end()) {
        found->second.used = generation;
        return found->second.buffer.id();
    }
    std::vector<glm::vec3> doubled;
    doubled.reserve(mesh.positions().size() * 2);
    for (const glm::vec3& p : mesh.positions()) doubled.insert(doubled.end(), 2, p);
    const auto bytes = std::as_bytes(std::span(doubled));
    auto buffer =
        device->create_buffer({.label = "shadow volume vertices",
                               .size = bytes.size(),
                               .usage = gpu::BufferUsage::Vertex | gpu::BufferUsage::CopyDst});
    if (!buffer) return forward_error(buffer);
    if (const Status written = device->write_buffer(*buffer, 0, bytes); !written)
        return forward_error(written);
    stats.uploaded_bytes += bytes.size();
    const gpu::BufferId id = buffer->id();
    meshes.emplace(mesh.id(), MeshVertices{std::move(*buffer), generation});
    return id;
}

Result<gpu::BufferId> ShadowPass::State::extruded_vertices_of(std::size_t index,
                                                              const shadows::VolumeDraw& draw) {
    std::vector<glm::vec4> far_vertices;
    shadows::extrude(draw.mesh->positions(), draw.extrusion, far_vertices);
    std::vector<glm::vec4> vertices;
    vertices.reserve(far_vertices.size() * 2);
    for (std::size_t v = 0; v < far_vertices.size(); ++v) {
        vertices.emplace_back(draw.mesh->positions()[v], 1.0F);
        vertices.push_back(far_vertices[v]);
    }
    const auto bytes = std::as_bytes(std::span(vertices));
    if (extruded.size() <= index) {
        extruded.resize(index + 1);
        extruded_sizes.resize(index + 1, 0);
    }
    if (extruded_sizes[index] < bytes.size()) {
        auto buffer =
            device->create_buffer({.label = "extruded shadow volume vertices",
                                   .size = bytes.size(),
                                   .usage = gpu::BufferUsage::Vertex | gpu::BufferUsage::CopyDst});
        if (!buffer) return forward_error(buffer);
        extruded[index] = std::move(*buffer);
        extruded_sizes[index] = bytes.size();
    }
    if (const Status written = device->write_buffer(extruded[index], 0, bytes); !written) {
        return forward_error(written);
    }
    stats.uploaded_bytes += bytes.size();
    return extruded[index].id();
}

// Where draws need `volume` alone, the span of its indices that they take; where a debug view may
// come, all of them.
Result<ShadowPass::State::VolumeRun> ShadowPass::State::indices_of(const shadows::VolumeDraw& draw,
                                                                   std::span<const Run> runs) {
    const bool all = desc.silhouette_lines || desc.cap_parts;
    auto begin = static_cast<std::uint32_t>(all ? 0 : draw.volume->indices.size());
    auto end = static_cast<std::uint32_t>(all ? draw.volume->indices.size() : 0);
    for (const Run& run : runs) {
        if (run.of_mesh) continue;
        begin = std::min(begin, run.first);
        end = std::max(end, run.first + run.count);
    }
    if (const auto found = volumes.find(draw.revision); found != volumes.end()) {
        VolumeRun& known = found->second;
        if (begin >= end || (known.begin <= begin && end <= known.end)) {
            known.used = generation;
            return known;
        }
        // Another technique than before wants more.
        begin = std::min(begin, known.begin);
        end = std::max(end, known.end);
        indices.free(known.run);
        volumes.erase(found);
    }
    begin = std::min(begin, end);
    auto run = desc.silhouette_lines
                   ? indices.upload(with_silhouette_lines(*draw.volume))
                   : indices.upload(std::span(draw.volume->indices).subspan(begin, end - begin));
    if (!run) return forward_error(run);
    stats.uploaded_bytes += std::uint64_t{run->count} * sizeof(std::uint32_t);
    return volumes.emplace(draw.revision, VolumeRun{*run, begin, end, generation}).first->second;
}

void ShadowPass::State::free_unused() {
    std::erase_if(volumes, [&](const auto& entry) {
        const bool unused = entry.second.used != generation;
        if (unused) indices.free(entry.second.run);
        return unused;
    });
    // A mesh may be out of range for a while and come back; what is the same for all its volumes is
    // kept for a few seconds of frames.
    constexpr std::uint64_t patience = 300;
    mesh_caps.free_unused(indices, generation, patience);
    std::erase_if(meshes,
                  [&](const auto& entry) { return entry.second.used + patience < generation; });
}

Result<ShadowPass> ShadowPass::create(gpu::Device& device, const ShadowPassDesc& desc) {
    if (desc.cap_bias.constant < 0 || !(desc.cap_bias.slope_scale >= 0.0F)) {
        return fail(ErrorCode::InvalidInput,
                    "The cap bias of a shadow pass (constant " +
                        std::to_string(desc.cap_bias.constant) + ", slope scale " +
                        std::to_string(desc.cap_bias.slope_scale) +
                        ") is below 0: it would move caps in front of lit surfaces.");
    }
    auto state = std::make_unique<State>(device, desc);
    const std::uint32_t alignment = device.caps().limits.min_uniform_buffer_offset_alignment;
    const std::uint32_t size = quad_uniform_bytes;
    state->uniform_stride = (size + alignment - 1) / alignment * alignment;
    if (const Status created = state->create_shaders(); !created) return forward_error(created);
    auto pipelines = state->create_pipelines(state->volume_stage(), 0xFF);
    if (!pipelines) return forward_error(pipelines);
    state->pipelines = std::move(*pipelines);
    return ShadowPass(std::move(state));
}

ShadowPass::ShadowPass(std::unique_ptr<State> state) : state_(std::move(state)) {}
ShadowPass::ShadowPass(ShadowPass&&) noexcept = default;
ShadowPass& ShadowPass::operator=(ShadowPass&&) noexcept = default;
ShadowPass::~ShadowPass() = default;

Status ShadowPass::prepare(const shadows::DrawList& list, const shadows::View& view,
                           TargetSize target) {
    State& s = *state_;
    if (list.revision != 0 && list.revision == s.prepared_revision && target == s.target &&
        is_same_view(view, s.prepared_view)) {
        s.stats.uploaded_bytes = 0;
        return {};
    }
    s.prepared_revision = 0;
    const bool any_quads = std::any_of(list.draws.begin(), list.draws.end(),
                                       [](const auto& draw) { return draw.quads.has_value(); });
    if (any_quads && (s.desc.extrusion == ExtrusionPath::Cpu || s.desc.expand_quads)) {
        return prepare(internal::without_quads(list), view, target);
    }
    ++s.generation;
    s.target = target;
    s.stats = {};
    s.recorded.clear();
    s.lights = list.lights;
    // What changed frees its old indices first, so that the new ones find the room.
    for (const shadows::VolumeDraw& draw : list.draws) {
        if (const auto found = s.volumes.find(draw.revision); found != s.volumes.end()) {
            found->second.used = s.generation;
        }
        if (s.quads && draw.quads) s.quads->gpu.keep(draw.revision, s.generation);
    }
    s.free_unused();
    if (s.quads) s.quads->gpu.free_unused(s.generation);
    if (const Status created = s.create_quads(list); !created) return created;
    for (const shadows::LightDraws& light : list.lights) {
        if (light.batches <= 1) continue;
        if (!s.batching) {
            if (const Status created = s.create_batching(); !created) return created;
        }
        s.stats.draw_calls += light.batches + 1;
    }
    const bool finite = view.projection != shadows::ProjectionKind::InfinitePerspective;
    const bool unclipped = finite && s.device->caps().features.unclipped_depth;
    for (std::size_t i = 0; i < list.draws.size(); ++i) {
        const shadows::VolumeDraw& draw = list.draws[i];
        if (draw.bounds.empty()) {
            s.recorded.emplace_back();
            s.recorded.back().batch = draw.batch;
            ++s.stats.hidden_draws;
            continue;
        }
        if (finite && !unclipped && draw.technique == Technique::DepthFail) {
            return fail(ErrorCode::Unsupported,
                        "Caster " + std::to_string(draw.caster) + " needs depth-fail for light " +
                            std::to_string(draw.light) +
                            " under a projection with a far plane, which would cut its volume off: "
                            "the adapter " +
                            s.device->caps().adapter +
                            " lacks unclipped depth. Use an infinite perspective.");
        }
        if (draw.quads) {
            auto textures = s.quads->gpu.textures_of(draw, s.generation, s.stats.uploaded_bytes);
            if (!textures) return forward_error(textures);
            s.recorded.push_back(
                {.vertices = {},
                 .indices = {},
                 .mesh_caps = {},
                 .exchanged = draw.mirrored,
                 .unclipped = unclipped,
                 .technique = draw.technique,
                 .runs = internal::runs_of(draw, internal::ranges_of(draw), s.desc),
                 .batch = draw.batch,
                 .volume = draw.volume,
                 .near_caps = {},
                 .quads = draw.quads->facing,
                 .quad_textures = *textures,
                 .scissor = s.scissor_of(draw.bounds)});
            s.stats.draw_calls += s.recorded.back().runs.size();
            continue;
        }
        auto vertices = s.desc.extrusion == ExtrusionPath::Cpu ? s.extruded_vertices_of(i, draw)
                                                               : s.vertices_of(*draw.mesh);
        if (!vertices) return forward_error(vertices);
        auto runs = internal::runs_of(draw, s.desc);
        auto indices = s.indices_of(draw, runs);
        if (!indices) return forward_error(indices);
        internal::IndexRun mesh_caps;
        const bool needs_mesh_caps =
            (s.desc.cap_parts && !draw.volume->ranges.empty()) ||
            std::any_of(runs.begin(), runs.end(), [](const Run& r) { return r.of_mesh; });
        if (needs_mesh_caps) {
            auto got = s.mesh_caps.get(s.indices, *draw.mesh, s.generation, s.stats.uploaded_bytes);
            if (!got) return forward_error(got);
            mesh_caps = *got;
        }
        s.recorded.push_back({*vertices, *indices, mesh_caps, draw.mirrored, unclipped,
                              draw.technique, std::move(runs), draw.batch, draw.volume,
                              s.desc.cap_parts ? internal::near_caps_of(*draw.mesh, *draw.volume)
                                               : std::vector<Run>{}});
        s.recorded.back().scissor = s.scissor_of(draw.bounds);
        s.stats.draw_calls += s.recorded.back().runs.size();
    }
    if (const Status written = s.write_uniforms(list, view); !written) return written;
    if (any_quads) {
        auto uniforms = s.quads->gpu.uniforms_in(s.uniforms);
        if (!uniforms) return forward_error(uniforms);
        s.quad_uniforms = *uniforms;
    }
    s.stats.index_bytes_held = s.indices.indices_in_use() * sizeof(std::uint32_t);
    s.prepared_revision = list.revision;
    s.prepared_view = view;
    return {};
}

void ShadowPass::State::draw(gpu::RenderPassEncoder& encoder, const Recorded& volume,
                             const Run& run, std::optional<std::uint32_t>& bound) const {
    const internal::IndexRun& where = run.of_mesh ? volume.mesh_caps : volume.indices.run;
    const std::uint32_t first = run.of_mesh ? run.first : run.first - volume.indices.begin;
    if (bound != where.chunk) {
        encoder.set_index_buffer(indices.buffer(where.chunk), gpu::IndexFormat::Uint32);
        bound = where.chunk;
    }
    encoder.draw_indexed(run.count, 1, where.first + first, run.base_vertex);
}

void ShadowPass::State::set_scissor(gpu::RenderPassEncoder& encoder,
                                    const shadows::PixelRect& wanted, shadows::PixelRect& current) {
    if (wanted == current) return;
    encoder.set_scissor_rect(wanted.x, wanted.y, wanted.width, wanted.height);
    current = wanted;
}

void ShadowPass::record(gpu::RenderPassEncoder& encoder, std::size_t light) const {
    const State& s = *state_;
    const shadows::LightDraws& of_light = s.lights[light];
    encoder.push_debug_group("shadow volumes");
    const bool batched = of_light.batches > 1;
    const Pipelines& pipelines = batched ? s.batching->pipelines : s.pipelines;
    const gpu::RenderPipeline* current = nullptr;
    shadows::PixelRect scissor = s.everything();
    std::optional<std::uint32_t> indices;
    for (std::uint32_t i = of_light.first; i < of_light.first + of_light.count; ++i) {
        const State::Recorded& volume = s.recorded[i];
        if (batched && i > of_light.first && volume.batch != s.recorded[i - 1].batch) {
            State::set_scissor(encoder, s.everything(), scissor);
            s.batching->fold.fold(encoder);
            current = nullptr;
        }
        if (volume.runs.empty()) continue;
        State::set_scissor(encoder, volume.scissor, scissor);
        const std::uint32_t offset = i * s.uniform_stride;
        const bool quads = volume.quads != shadows::QuadFacing::None;
        if (quads) {
            encoder.set_bind_group(0, s.quad_uniforms, std::span(&offset, 1));
            encoder.set_bind_group(1, volume.quad_textures);
        } else {
            encoder.set_bind_group(0, s.bind_group, std::span(&offset, 1));
            encoder.set_vertex_buffer(0, volume.vertices);
        }
        const Pipelines& of_stage = quads ? s.quad_pipelines(volume.quads, batched) : pipelines;
        for (const Run& run : volume.runs) {
            const auto& pipeline = of_stage[pipeline_index(
                volume.technique, volume.exchanged != run.exchanged, volume.unclipped, run.role)];
            if (&pipeline != current) encoder.set_pipeline(pipeline);
            current = &pipeline;
            if (quads) {
                encoder.draw(run.count, 1, run.first);
            } else {
                s.draw(encoder, volume, run, indices);
            }
        }
    }
    State::set_scissor(encoder, s.everything(), scissor);
    if (batched) {
        s.batching->fold.fold(encoder);
        s.batching->fold.finish(encoder);
    }
    encoder.pop_debug_group();
}

void ShadowPass::record_part(gpu::RenderPassEncoder& encoder, std::size_t light, Part part,
                             gpu::RenderPipelineId pipeline) const {
    const State& s = *state_;
    const shadows::LightDraws& of_light = s.lights[light];
    encoder.set_pipeline(pipeline);
    std::optional<std::uint32_t> indices;
    for (std::uint32_t i = of_light.first; i < of_light.first + of_light.count; ++i) {
        const State::Recorded& recorded = s.recorded[i];
        if (recorded.runs.empty() || recorded.quads != shadows::QuadFacing::None) continue;
        const shadows::Volume& volume = *recorded.volume;
        const std::uint32_t offset = i * s.uniform_stride;
        encoder.set_bind_group(0, s.bind_group, std::span(&offset, 1));
        encoder.set_vertex_buffer(0, recorded.vertices);
        const auto draw = [&](std::uint32_t first, std::uint32_t count) {
            if (count > 0) s.draw(encoder, recorded, {.first = first, .count = count}, indices);
        };
        if (part == Part::Sides) draw(volume.sides.first, volume.sides.count);
        if (part == Part::Caps) {
            for (const Run& run : recorded.near_caps) s.draw(encoder, recorded, run, indices);
        }
        if (part == Part::Silhouettes) {
            const auto lines = static_cast<std::uint32_t>(volume.indices.size());
            draw(lines, recorded.indices.run.count - lines);
        }
    }
}

gpu::BindGroupLayoutId ShadowPass::bind_group_layout() const { return state_->layout; }
gpu::ShaderId ShadowPass::vertex_shader() const { return state_->vertex; }
gpu::VertexBufferLayout ShadowPass::vertex_layout() const { return state_->vertex_layout(); }

const PassStats& ShadowPass::stats() const { return state_->stats; }

}  // namespace gnomon::shadow_pass
