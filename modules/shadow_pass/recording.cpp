// SPDX-License-Identifier: MIT
//
// ShadowPass::record() and its kin: what was prepared becomes commands.
#include <optional>
#include <span>

#include <gnomon/core/expects.hpp>

#include "internal/pass_state.hpp"

namespace gnomon::shadow_pass {

using internal::pipeline_index;
using internal::Pipelines;

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
    state_->record(encoder, light, std::nullopt);
}

void ShadowPass::record_fill(gpu::RenderPassEncoder& encoder, std::size_t light, Fill fill) const {
    GNOMON_EXPECTS(state_->desc.meter);
    state_->record(encoder, light, fill);
}

// Metered or not, the very same draws.
void ShadowPass::State::record(gpu::RenderPassEncoder& encoder, std::size_t light,
                               std::optional<Fill> metered) const {
    const State& s = *this;
    const shadows::LightDraws& of_light = s.lights[light];
    encoder.push_debug_group(metered ? "shadow volumes, metered" : "shadow volumes");
    const bool batched = of_light.batches > 1 && !metered;
    const gpu::RenderPipeline* current = nullptr;
    shadows::PixelRect scissor = s.everything();
    std::optional<std::uint32_t> indices;
    for (std::uint32_t i = of_light.first; i < of_light.first + of_light.count; ++i) {
        const State::Recorded& volume = s.recorded[i];
        if (batched && i > of_light.first && volume.batch != s.recorded[i - 1].batch) {
            State::set_scissor(encoder, s.everything(), scissor);
            s.fold->fold(encoder);
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
        const Pipelines& of_stage = s.pipelines->get(volume.quads, batched, metered);
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
        s.fold->fold(encoder);
        s.fold->finish(encoder);
    }
    if (of_light.clear_background && !metered) {
        State::set_scissor(encoder, s.scissor_of(of_light.bounds), scissor);
        s.background->record(encoder);
        State::set_scissor(encoder, s.everything(), scissor);
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

}  // namespace gnomon::shadow_pass
