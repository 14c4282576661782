// SPDX-License-Identifier: MIT
//
// ShadowPass::record() and its kin: what was prepared becomes commands.
#include <span>

#include <gnomon/core/expects.hpp>

#include "internal/pass_state.hpp"

namespace gnomon::shadow_pass {

namespace {

// Remembers what is set, so that a call that would change nothing is not recorded.
class Recorder {
public:
    Recorder(gpu::RenderPassEncoder& encoder, const shadows::PixelRect& everything)
        : encoder_(encoder), scissor_(everything) {}

    void set_scissor(const shadows::PixelRect& wanted) {
        if (wanted == scissor_) return;
        encoder_.set_scissor_rect(wanted.x, wanted.y, wanted.width, wanted.height);
        scissor_ = wanted;
    }
    void set_depth_bounds(const shadows::DepthBounds& wanted) {
        if (change(depth_, wanted)) encoder_.set_depth_bounds(wanted.min, wanted.max);
    }
    void set_pipeline(gpu::RenderPipelineId pipeline) {
        if (change(pipeline_, pipeline)) encoder_.set_pipeline(pipeline);
    }
    void forget_pipeline() { pipeline_ = {}; }
    void set_vertices(gpu::BufferId vertices, gpu::BufferId instances) {
        if (change(vertices_, vertices)) encoder_.set_vertex_buffer(0, vertices);
        if (change(instances_, instances)) encoder_.set_vertex_buffer(1, instances);
    }
    void set_indices(gpu::BufferId indices) {
        if (change(indices_, indices)) {
            encoder_.set_index_buffer(indices, gpu::IndexFormat::Uint32);
        }
    }

private:
    template <class T>
    static bool change(T& current, T wanted) {
        if (current == wanted) return false;
        current = wanted;
        return true;
    }

    gpu::RenderPassEncoder& encoder_;
    shadows::PixelRect scissor_;
    shadows::DepthBounds depth_;
    gpu::RenderPipelineId pipeline_;
    gpu::BufferId vertices_;
    gpu::BufferId instances_;
    gpu::BufferId indices_;
};

}  // namespace

void ShadowPass::record(gpu::RenderPassEncoder& encoder, std::size_t light) const {
    state_->record(encoder, light, std::nullopt);
}

void ShadowPass::record_fill(gpu::RenderPassEncoder& encoder, std::size_t light, Fill fill) const {
    GNOMON_EXPECTS(state_->desc.meter);
    state_->record(encoder, light, fill);
}

// Metered or not, the very same draws.
void ShadowPass::State::record(gpu::RenderPassEncoder& encoder, std::size_t l,
                               std::optional<Fill> metered) const {
    const PreparedLight& light = lights[l];
    encoder.push_debug_group(metered ? "shadow volumes, metered" : "shadow volumes");
    const bool batched = light.draws.batches > 1 && !metered;
    Recorder recorder(encoder, everything());
    const Call* previous = nullptr;
    for (const Call& call : light.calls) {
        if (batched && previous != nullptr && call.batch != previous->batch) {
            recorder.set_scissor(everything());
            fold->fold(encoder);
            recorder.forget_pipeline();
        }
        previous = &call;
        recorder.set_scissor(call.scissor);
        recorder.set_depth_bounds(call.depth);
        recorder.set_pipeline(pipelines->get(call.quads, batched, metered)[call.pipeline]);
        if (call.quads != shadows::QuadFacing::None) {
            encoder.set_bind_group(0, quads->uniforms(), std::span(&call.instance, 1));
            encoder.set_bind_group(1, call.textures);
            encoder.draw(call.count, 1, call.first);
        } else {
            recorder.set_vertices(call.vertices, instances.buffer());
            recorder.set_indices(call.indices);
            encoder.draw_indexed(call.count, 1, call.first, call.base_vertex, call.instance);
        }
    }
    recorder.set_scissor(everything());
    recorder.set_depth_bounds({});
    if (batched) {
        fold->fold(encoder);
        fold->finish(encoder);
    }
    if (light.draws.clear_background && !metered) {
        recorder.set_scissor(scissor_of(light.draws.bounds));
        background->record(encoder);
        recorder.set_scissor(everything());
    }
    encoder.pop_debug_group();
}

void ShadowPass::record_part(gpu::RenderPassEncoder& encoder, std::size_t light, Part part,
                             gpu::RenderPipelineId pipeline) const {
    const State& s = *state_;
    encoder.set_pipeline(pipeline);
    Recorder recorder(encoder, s.everything());
    for (const internal::VolumeParts& of_volume : s.lights[light].parts) {
        const shadows::Volume& volume = *of_volume.volume;
        const auto draw = [&](const Run& run) {
            if (run.count == 0) return;
            const ArenaRun& where = run.of_mesh ? of_volume.mesh_caps : of_volume.indices;
            recorder.set_vertices(of_volume.vertices, s.instances.buffer());
            recorder.set_indices(s.indices.buffer(where.chunk));
            encoder.draw_indexed(
                run.count, 1,
                where.first + (run.of_mesh ? run.first : run.first - of_volume.indices_begin),
                of_volume.base_vertex + run.base_vertex, of_volume.instance);
        };
        if (part == Part::Sides) draw({.first = volume.sides.first, .count = volume.sides.count});
        if (part == Part::Caps) {
            for (const Run& run : of_volume.near_caps) draw(run);
        }
        if (part == Part::Silhouettes) {
            const auto lines = static_cast<std::uint32_t>(volume.indices.size());
            draw({.first = lines, .count = of_volume.indices.count - lines});
        }
    }
}

}  // namespace gnomon::shadow_pass
