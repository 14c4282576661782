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

bool is_same_view(const shadows::View& a, const shadows::View& b) {
    return a.projection == b.projection && a.view_from_world == b.view_from_world &&
           a.clip_from_view == b.clip_from_view;
}

}  // namespace

ShadowPass::State::State(gpu::Device& d, const ShadowPassDesc& description)
    : device(&d),
      desc(description),
      vertices(d, {.label = "shadow volume vertices",
                   .owner = "A shadow mesh",
                   .elements = "vertices",
                   .usage = gpu::BufferUsage::Vertex,
                   .element_bytes = 2 * sizeof(glm::vec3),  // so that far vertices keep odd numbers
                   .chunk_elements = 1U << 17U}),
      // A few hundred thousand triangles' worth of silhouettes.
      indices(d, {.label = "shadow volume indices",
                  .owner = "A shadow volume",
                  .elements = "indices",
                  .usage = gpu::BufferUsage::Index}),
      instances(d) {}

std::vector<gpu::VertexBufferLayout> ShadowPass::State::vertex_layouts() const {
    const bool on_cpu = desc.extrusion == ExtrusionPath::Cpu;
    const gpu::VertexBufferLayout of_vertex{
        .array_stride = on_cpu ? sizeof(glm::vec4) : sizeof(glm::vec3),
        .attributes = {
            {.format = on_cpu ? gpu::VertexFormat::Float32x4 : gpu::VertexFormat::Float32x3}}};
    return {of_vertex, internal::instance_layout()};
}

Status ShadowPass::State::create_shaders() {
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
                auto made = internal::GpuQuads::create(*device);
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
    mesh_vertices.free_unused(vertices, generation, patience);
}

// After a failure nobody knows what is on the GPU.
void ShadowPass::State::forget() {
    vertices.clear();
    indices.clear();
    mesh_vertices.clear();
    mesh_caps.clear();
    volumes.clear();
    instances.forget();
    lights.clear();
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
    // Volumes of no system may share a revision with others.
    if (list.revision == 0) s.lights.clear();
    const bool any_quads = std::any_of(list.draws.begin(), list.draws.end(),
                                       [](const auto& draw) { return draw.quads.has_value(); });
    if (any_quads && (s.desc.extrusion == ExtrusionPath::Cpu || s.desc.expand_quads)) {
        return prepare(internal::without_quads(list), view, target);
    }
    s.stats = {};
    if (!(target == s.target)) s.lights.clear();
    s.target = target;
    if (const Status prepared = s.prepare(list, view, any_quads); !prepared) {
        s.forget();
        return prepared;
    }
    s.prepared_revision = list.revision;
    s.prepared_view = view;
    return {};
}

Status ShadowPass::State::prepare(const shadows::DrawList& list, const shadows::View& view,
                                  bool any_quads) {
    ++generation;
    if (const Status created = create_what_is_new(list, any_quads); !created) return created;
    const gpu::BufferId matrices = instances.buffer();
    if (const Status written = instances.update(list, view, stats.uploaded_bytes); !written) {
        return written;
    }
    const bool finite = view.projection != shadows::ProjectionKind::InfinitePerspective;
    mirrored_view = shadows::is_mirrored(view);
    const bool changed = find_changed_lights(list, finite) || matrices != instances.buffer();
    if (changed || recording_revision == 0) ++recording_revision;
    // What changed frees its old indices first, so that the new ones find the room.
    for (const PreparedLight& light : lights) {
        if (light.known) {
            for (std::uint64_t* used : light.marks) *used = generation;
            continue;
        }
        const std::uint32_t end = light.draws.first + light.draws.count;
        for (std::uint32_t i = light.draws.first; i < end; ++i) {
            const shadows::VolumeDraw& draw = list.draws[i];
            if (const auto found = volumes.find(draw.revision); found != volumes.end()) {
                found->second.used = generation;
            }
            if (quads && draw.quads) quads->keep(draw.revision, generation);
        }
    }
    free_unused();
    if (quads) {
        quads->free_unused(generation);
        const Status written = quads->write_uniforms(list, view, stats.uploaded_bytes);
        if (!written) return written;
    }
    for (PreparedLight& light : lights) {
        if (!light.known) {
            if (const Status made = make_calls(list, light); !made) return made;
        }
        stats.draw_calls += light.draw_calls;
        stats.hidden_draws += light.hidden_draws;
        stats.depth_bounded_draws += light.depth_bounded_draws;
    }
    if (const Status written = vertices.flush(); !written) return written;
    if (const Status written = indices.flush(); !written) return written;
    stats.index_bytes_held = indices.elements_in_use() * sizeof(std::uint32_t);
    return {};
}

Status ShadowPass::State::create_what_is_new(const shadows::DrawList& list, bool any_quads) {
    if (any_quads) {
        if (const Status created = create_quads(list); !created) return created;
    }
    for (const shadows::LightDraws& light : list.lights) {
        if (light.clear_background && !background) {
            if (const Status created = create_background(); !created) return created;
        }
        if (light.batches > 1 && !fold) {
            if (const Status created = create_batching(); !created) return created;
        }
    }
    return {};
}

gpu::ShaderId ShadowPass::vertex_shader() const { return state_->vertex; }
std::vector<gpu::VertexBufferLayout> ShadowPass::vertex_layouts() const {
    return state_->vertex_layouts();
}

std::uint64_t ShadowPass::revision() const { return state_->recording_revision; }
const PassStats& ShadowPass::stats() const { return state_->stats; }

}  // namespace gnomon::shadow_pass
