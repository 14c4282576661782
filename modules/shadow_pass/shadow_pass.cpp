// SPDX-License-Identifier: MIT
#include <gnomon/shadow_pass/shadow_pass.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include <gnomon/core/expects.hpp>
#include <gnomon_shaders/shadow_pass.hpp>

#include "internal/pass_state.hpp"

namespace gnomon::shadow_pass {

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
    const Status made = pipelines->ensure(shadows::QuadFacing::None, volume_stage(), true);
    if (!made) return made;
    auto made_fold = internal::StencilFold::create(*device, desc);
    if (!made_fold) return forward_error(made_fold);
    fold.emplace(std::move(*made_fold));
    return {};
}

Status ShadowPass::State::create_background() {
    auto made = internal::BackgroundClear::create(*device, desc);
    if (!made) return forward_error(made);
    background.emplace(std::move(*made));
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
                quads.emplace(std::move(*made));
            }
            const shadows::QuadFacing facing = draw.quads->facing;
            const Status made = pipelines->ensure(
                facing, {quads->layouts(), quads->vertex_shader(facing), {}}, light.batches > 1);
            if (!made) return made;
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
    state->pipelines.emplace(device, desc, state->fragment);
    const Status made =
        state->pipelines->ensure(shadows::QuadFacing::None, state->volume_stage(), false);
    if (!made) return forward_error(made);
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
        if (s.quads && draw.quads) s.quads->keep(draw.revision, s.generation);
    }
    s.free_unused();
    if (s.quads) s.quads->free_unused(s.generation);
    if (const Status created = s.create_quads(list); !created) return created;
    for (const shadows::LightDraws& light : list.lights) {
        if (light.clear_background) {
            if (!s.background) {
                if (const Status created = s.create_background(); !created) return created;
            }
            ++s.stats.draw_calls;
        }
        if (light.batches <= 1) continue;
        if (!s.fold) {
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
            auto textures = s.quads->textures_of(draw, s.generation, s.stats.uploaded_bytes);
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
        auto uniforms = s.quads->uniforms_in(s.uniforms);
        if (!uniforms) return forward_error(uniforms);
        s.quad_uniforms = *uniforms;
    }
    s.stats.index_bytes_held = s.indices.indices_in_use() * sizeof(std::uint32_t);
    s.prepared_revision = list.revision;
    s.prepared_view = view;
    return {};
}

gpu::BindGroupLayoutId ShadowPass::bind_group_layout() const { return state_->layout; }
gpu::ShaderId ShadowPass::vertex_shader() const { return state_->vertex; }
gpu::VertexBufferLayout ShadowPass::vertex_layout() const { return state_->vertex_layout(); }

const PassStats& ShadowPass::stats() const { return state_->stats; }

}  // namespace gnomon::shadow_pass
