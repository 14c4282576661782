// SPDX-License-Identifier: MIT
#include "internal/volume_pipelines.hpp"

#include <string>
#include <utility>

namespace gnomon::shadow_pass::internal {

using shadows::Technique;

namespace {

bool is_reversed(gpu::Compare compare) {
    return compare == gpu::Compare::Greater || compare == gpu::Compare::GreaterEqual;
}

// "In front of", equality included.
gpu::Compare or_equal(gpu::Compare compare) {
    return is_reversed(compare) ? gpu::Compare::GreaterEqual : gpu::Compare::LessEqual;
}

// Front and back are named from outside the volume. Depth-fail counts faces behind the surface
// (equality included: comparison is strict, and caps lie on surfaces), depth-pass those in front.
gpu::DepthStencilState counting(const ShadowPassDesc& desc, Technique technique, bool exchanged,
                                Role role, std::uint32_t count_mask) {
    gpu::DepthStencilState state{.format = desc.depth_stencil_format,
                                 .depth_compare = desc.depth_compare,
                                 .stencil_write_mask = count_mask};
    if (role == Role::OpenCap) state.depth_compare = or_equal(desc.depth_compare);
    if (role != Role::Volume) {
        const int nearer = is_reversed(desc.depth_compare) ? 1 : -1;
        const int sign = role == Role::OpenCap ? nearer : -nearer;
        state.depth_bias = sign * desc.cap_bias.constant;
        state.depth_bias_slope_scale = static_cast<float>(sign) * desc.cap_bias.slope_scale;
    }
    gpu::StencilFaceState up;
    gpu::StencilFaceState down;
    if (technique == Technique::DepthFail) {
        up.depth_fail_op = gpu::StencilOp::IncrementWrap;
        down.depth_fail_op = gpu::StencilOp::DecrementWrap;
        state.stencil_front = down;
        state.stencil_back = up;
    } else {
        up.pass_op = gpu::StencilOp::IncrementWrap;
        down.pass_op = gpu::StencilOp::DecrementWrap;
        state.stencil_front = up;
        state.stencil_back = down;
    }
    if (exchanged) std::swap(state.stencil_front, state.stencil_back);
    return state;
}

}  // namespace

Result<Pipelines> create_volume_pipelines(gpu::Device& device, const ShadowPassDesc& desc,
                                          const VertexStage& stage, gpu::ShaderId fragment,
                                          std::uint32_t count_mask) {
    Pipelines result;
    gpu::RenderPipelineDesc pipeline;
    pipeline.bind_group_layouts = stage.layouts;
    pipeline.vertex = stage.shader;
    pipeline.fragment = fragment;
    pipeline.vertex_buffers = stage.buffers;
    for (const gpu::Format format : desc.color_formats) {
        pipeline.targets.push_back({.format = format, .write_mask = gpu::ColorWrite::None});
    }
    pipeline.sample_count = desc.sample_count;
    std::vector<Role> roles{Role::Volume};
    if (!desc.cap_bias.none()) roles.push_back(Role::Cap);
    if (desc.averted_faces == AvertedFaces::LeftToShading) roles.push_back(Role::OpenCap);
    for (const bool unclipped : {false, true}) {
        if (unclipped && !device.caps().features.unclipped_depth) continue;
        for (const bool exchanged : {false, true}) {
            for (const Technique technique : {Technique::DepthPass, Technique::DepthFail}) {
                for (const Role role : roles) {
                    pipeline.label =
                        std::string("shadow volume, ") +
                        (technique == Technique::DepthPass ? "depth-pass" : "depth-fail") +
                        (exchanged ? ", exchanged" : "") + (unclipped ? ", unclipped" : "") +
                        (role == Role::Cap ? ", biased caps" : "") +
                        (role == Role::OpenCap ? ", open caps" : "");
                    pipeline.primitive.unclipped_depth = unclipped;
                    pipeline.depth_stencil = counting(desc, technique, exchanged, role, count_mask);
                    auto made = device.create_render_pipeline(pipeline);
                    if (!made) return forward_error(made);
                    result[pipeline_index(technique, exchanged, unclipped, role)] =
                        std::move(*made);
                }
            }
        }
    }
    return result;
}

}  // namespace gnomon::shadow_pass::internal
