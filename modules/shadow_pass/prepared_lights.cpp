// SPDX-License-Identifier: MIT
//
// What ShadowPass::prepare() makes of each light: which have changed, what they need on the GPU,
// their draw calls.
#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "internal/pass_state.hpp"
#include "internal/scissor_choice.hpp"

namespace gnomon::shadow_pass {

namespace {

using internal::DrawKey;

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

bool is_alike(const shadows::LightDraws& a, const shadows::LightDraws& b) {
    return a.light == b.light && a.first == b.first && a.count == b.count &&
           a.batches == b.batches && a.bounds == b.bounds &&
           a.clear_background == b.clear_background;
}

}  // namespace

// Into `keys`, one for each slab of a draw that has some. `before`: what the light was, or null.
void ShadowPass::State::make_keys(const shadows::DrawList& list, const shadows::LightDraws& light,
                                  const PreparedLight* before) {
    keys.clear();
    for (std::uint32_t i = light.first; i < light.first + light.count; ++i) {
        const shadows::VolumeDraw& draw = list.draws[i];
        if (draw.slabs.empty()) add_key(draw, nullptr, i, before);
        for (std::uint32_t k = 0; k < draw.slabs.size(); ++k) {
            add_key(draw, &draw.slabs[k], instances.first_slab(i) + k, before);
        }
    }
}

void ShadowPass::State::add_key(const shadows::VolumeDraw& draw, const shadows::VolumeSlab* slab,
                                std::uint32_t instance, const PreparedLight* before) {
    const shadows::ScreenBounds& bounds = slab != nullptr ? slab->bounds : draw.bounds;
    DrawKey key{.revision = draw.revision,
                .mesh = draw.mesh->id(),
                .instance = instance,
                .wanted = scissor_of(bounds),
                .scissor = {},
                .depth = depth_of(draw),
                .batch = draw.batch,
                .technique = draw.technique,
                .ends = internal::ends_of(draw, slab, desc),
                .mirrored = draw.mirrored != mirrored_view,
                .hidden = bounds.empty()};
    key.scissor = key.wanted;
    const bool cut = target.width > 0 && target.height > 0;
    if (cut && !key.hidden && !(key.wanted == everything())) {
        const std::size_t place = keys.size();
        const DrawKey* known =
            before != nullptr && place < before->keys.size() ? &before->keys[place] : nullptr;
        if (known != nullptr && known->mesh == key.mesh && known->instance == instance &&
            known->wanted == key.wanted && !instances.changed(instance)) {
            key.scissor = known->scissor;
        } else if (!internal::scissor_pays(
                       internal::covered_pixels(*draw.mesh, instances[instance], target),
                       key.wanted)) {
            key.scissor = everything();
        }
    }
    keys.push_back(key);
}

// Those that are `known` keep their calls.
bool ShadowPass::State::find_changed_lights(const shadows::DrawList& list, bool finite) {
    bool any = recorded_lights != list.lights.size();
    recorded_lights = list.lights.size();
    lights.resize(recorded_lights);
    for (std::size_t l = 0; l < lights.size(); ++l) {
        PreparedLight& light = lights[l];
        const shadows::LightDraws& draws = list.lights[l];
        const bool same_light =
            light.known && light.finite == finite && is_alike(light.draws, draws);
        make_keys(list, draws, same_light ? &light : nullptr);
        const auto of_light = std::span(list.draws).subspan(draws.first, draws.count);
        // Where vertices come from the CPU they are new each time; what quads need is not tracked.
        light.known = same_light && desc.extrusion == ExtrusionPath::VertexShader &&
                      keys == light.keys &&
                      std::none_of(of_light.begin(), of_light.end(),
                                   [](const auto& draw) { return draw.quads.has_value(); });
        light.draws = draws;
        light.finite = finite;
        if (!light.known) std::swap(light.keys, keys);
        any = any || !light.known;
    }
    return any;
}

Status ShadowPass::State::make_calls(const shadows::DrawList& list, PreparedLight& light) {
    light.marks.clear();
    light.calls.clear();
    light.parts.clear();
    light.hidden_draws = light.depth_bounded_draws = 0;
    std::span<const DrawKey> left = light.keys;
    for (std::uint32_t i = light.draws.first; i < light.draws.first + light.draws.count; ++i) {
        const shadows::VolumeDraw& draw = list.draws[i];
        const auto of_draw = left.first(std::max<std::size_t>(1, draw.slabs.size()));
        left = left.subspan(of_draw.size());
        if (draw.bounds.empty()) {
            ++light.hidden_draws;
            continue;
        }
        if (!of_draw[0].depth.everything()) ++light.depth_bounded_draws;
        if (light.finite && !unclipped(light) && draw.technique == Technique::DepthFail) {
            return fail(ErrorCode::Unsupported,
                        "Caster " + std::to_string(draw.caster) + " needs depth-fail for light " +
                            std::to_string(draw.light) +
                            " under a projection with a far plane, which would cut its volume off: "
                            "the adapter " +
                            device->caps().adapter +
                            " lacks unclipped depth. Use an infinite perspective.");
        }
        const Status added = draw.quads ? add_quad_calls(list, i, of_draw[0], light)
                                        : add_calls(list, i, of_draw, light);
        if (!added) return added;
    }
    internal::sort_calls(light.calls, everything());
    light.draw_calls = light.calls.size() + (light.draws.clear_background ? 1 : 0);
    if (light.draws.batches > 1) {
        light.draw_calls += 2;  // the last fold and the finish
        for (std::size_t c = 1; c < light.calls.size(); ++c) {
            if (light.calls[c].batch != light.calls[c - 1].batch) ++light.draw_calls;
        }
    }
    light.known = list.revision != 0;
    return {};
}

Status ShadowPass::State::add_quad_calls(const shadows::DrawList& list, std::uint32_t i,
                                         const DrawKey& key, PreparedLight& light) {
    const shadows::VolumeDraw& draw = list.draws[i];
    const auto textures = quads->textures_of(draw, generation, stats.uploaded_bytes);
    if (!textures) return forward_error(textures);
    runs.clear();
    internal::append_runs(internal::ranges_of(draw), key.ends, runs);
    for (const Run& run : runs) {
        light.calls.push_back(
            {.vertices = {},
             .indices = {},
             .textures = *textures,
             .scissor = key.scissor,
             .depth = key.depth,
             .first = run.first,
             .count = run.count,
             .instance = quads->uniform_offset(i),
             .batch = draw.batch,
             .pipeline = static_cast<std::uint8_t>(internal::pipeline_index(
                 draw.technique, key.mirrored != run.exchanged, unclipped(light), run.role)),
             .quads = draw.quads->facing});
    }
    return {};
}

Status ShadowPass::State::add_calls(const shadows::DrawList& list, std::uint32_t i,
                                    std::span<const DrawKey> of_draw, PreparedLight& light) {
    const shadows::VolumeDraw& draw = list.draws[i];
    const auto from = vertices_of(draw, i, light);
    if (!from) return forward_error(from);
    runs.clear();
    run_ends.clear();
    for (const DrawKey& key : of_draw) {
        internal::append_runs(*draw.volume, key.ends, runs);
        run_ends.push_back(runs.size());
    }
    const auto volume = indices_of(draw);
    if (!volume) return forward_error(volume);
    light.marks.push_back(&(*volume)->used);
    ArenaRun caps;
    const bool needs_mesh_caps =
        (desc.cap_parts && !draw.volume->ranges.empty()) ||
        std::any_of(runs.begin(), runs.end(), [](const Run& r) { return r.of_mesh; });
    if (needs_mesh_caps) {
        const auto got = mesh_caps.get(indices, *draw.mesh, generation, stats.uploaded_bytes);
        if (!got) return forward_error(got);
        light.marks.push_back(&(*got)->used);
        caps = (*got)->run;
    }
    const VolumeRun& at = **volume;
    const DrawKey* key = of_draw.data();
    for (std::size_t r = 0; r < runs.size(); ++r) {
        while (r == run_ends[static_cast<std::size_t>(key - of_draw.data())]) ++key;
        const Run& run = runs[r];
        const ArenaRun& where = run.of_mesh ? caps : at.run;
        light.calls.push_back(
            {.vertices = from->buffer,
             .indices = indices.buffer(where.chunk),
             .textures = {},
             .scissor = key->scissor,
             .depth = key->depth,
             .first = where.first + (run.of_mesh ? run.first : run.first - at.begin),
             .count = run.count,
             .base_vertex = from->base_vertex + run.base_vertex,
             .instance = key->instance,
             .batch = draw.batch,
             .pipeline = static_cast<std::uint8_t>(internal::pipeline_index(
                 draw.technique, key->mirrored != run.exchanged, unclipped(light), run.role))});
    }
    light.parts.push_back({.instance = i,
                           .vertices = from->buffer,
                           .base_vertex = from->base_vertex,
                           .indices = at.run,
                           .indices_begin = at.begin,
                           .mesh_caps = caps,
                           .volume = draw.volume,
                           .near_caps = desc.cap_parts
                                            ? internal::near_caps_of(*draw.mesh, *draw.volume)
                                            : std::vector<Run>{}});
    return {};
}

Result<ShadowPass::State::Vertices> ShadowPass::State::vertices_of(const shadows::VolumeDraw& draw,
                                                                   std::uint32_t i,
                                                                   PreparedLight& light) {
    if (desc.extrusion == ExtrusionPath::Cpu) {
        const auto buffer = extruded_vertices_of(i, draw);
        if (!buffer) return forward_error(buffer);
        return Vertices{*buffer, 0};
    }
    const auto kept = mesh_vertices.get(vertices, *draw.mesh, generation, stats.uploaded_bytes);
    if (!kept) return forward_error(kept);
    light.marks.push_back(&(*kept)->used);
    const ArenaRun& run = (*kept)->run;
    return Vertices{run.count > 0 ? vertices.buffer(run.chunk) : gpu::BufferId{},
                    static_cast<std::int32_t>(2 * run.first)};
}

Result<gpu::BufferId> ShadowPass::State::extruded_vertices_of(std::size_t index,
                                                              const shadows::VolumeDraw& draw) {
    std::vector<glm::vec4> far_vertices;
    shadows::extrude(draw.mesh->positions(), draw.extrusion, far_vertices);
    std::vector<glm::vec4> interleaved;
    interleaved.reserve(far_vertices.size() * 2);
    for (std::size_t v = 0; v < far_vertices.size(); ++v) {
        interleaved.emplace_back(draw.mesh->positions()[v], 1.0F);
        interleaved.push_back(far_vertices[v]);
    }
    const auto bytes = std::as_bytes(std::span(interleaved));
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

// Where `runs` need the volume alone, the span of its indices that they take; where a debug view
// may come, all of them.
Result<ShadowPass::State::VolumeRun*> ShadowPass::State::indices_of(
    const shadows::VolumeDraw& draw) {
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
            return &known;
        }
        // Another technique than before wants more.
        begin = std::min(begin, known.begin);
        end = std::max(end, known.end);
        indices.free(known.run);
        volumes.erase(found);
    }
    begin = std::min(begin, end);
    std::vector<std::uint32_t> with_lines;
    if (desc.silhouette_lines) with_lines = with_silhouette_lines(*draw.volume);
    const auto wanted = desc.silhouette_lines
                            ? std::span<const std::uint32_t>(with_lines)
                            : std::span(draw.volume->indices).subspan(begin, end - begin);
    const auto run = indices.upload(std::as_bytes(wanted));
    if (!run) return forward_error(run);
    stats.uploaded_bytes += std::uint64_t{run->count} * sizeof(std::uint32_t);
    return &volumes.emplace(draw.revision, VolumeRun{*run, begin, end, generation}).first->second;
}

}  // namespace gnomon::shadow_pass
