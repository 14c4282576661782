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

// What depth_compare lets fail.
gpu::Compare opposite(gpu::Compare compare) {
    using gpu::Compare;
    switch (compare) {
        case Compare::Less: return Compare::GreaterEqual;
        case Compare::LessEqual: return Compare::Greater;
        case Compare::Greater: return Compare::LessEqual;
        case Compare::GreaterEqual: return Compare::Less;
        case Compare::Equal: return Compare::NotEqual;
        case Compare::NotEqual: return Compare::Equal;
        case Compare::Always: return Compare::Never;
        case Compare::Never: return Compare::Always;
        case Compare::Undefined: break;
    }
    return Compare::Undefined;
}

// Front and back are named from outside the volume. Depth-fail counts faces behind the surface
// (equality included: comparison is strict, and caps lie on surfaces), depth-pass those in front.
gpu::DepthStencilState state_of(const ShadowPassDesc& desc, Technique technique, bool exchanged,
                                Role role, const Counting& counting) {
    gpu::DepthStencilState state{.format = desc.depth_stencil_format,
                                 .depth_compare = desc.depth_compare,
                                 .stencil_write_mask = counting.mask};
    if (role == Role::OpenCap) state.depth_compare = or_equal(desc.depth_compare);
    if (role != Role::Volume) {
        const int nearer = is_reversed(desc.depth_compare) ? 1 : -1;
        const int sign = role == Role::OpenCap ? nearer : -nearer;
        state.depth_bias = sign * desc.cap_bias.constant;
        state.depth_bias_slope_scale = static_cast<float>(sign) * desc.cap_bias.slope_scale;
    }
    if (counting.fill) {
        if (*counting.fill != Fill::Counted) {
            state.depth_compare = gpu::Compare::Always;
        } else if (technique == Technique::DepthFail) {
            state.depth_compare = opposite(state.depth_compare);
        }
        if (*counting.fill == Fill::PerPixel) {
            state.stencil_front.pass_op = gpu::StencilOp::IncrementClamp;
            state.stencil_back.pass_op = gpu::StencilOp::IncrementClamp;
        }
        return state;
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

bool has_depth_bounds(const gpu::Device& device, const ShadowPassDesc& desc) {
    return device.caps().features.depth_bounds && is_reversed(desc.depth_compare);
}

Result<Pipelines> create_volume_pipelines(gpu::Device& device, const ShadowPassDesc& desc,
                                          const VertexStage& stage, gpu::ShaderId fragment,
                                          const Counting& counting) {
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
                        (role == Role::OpenCap ? ", open caps" : "") +
                        (counting.fill ? ", metered" : "");
                    pipeline.primitive.unclipped_depth = unclipped;
                    pipeline.depth_stencil = state_of(desc, technique, exchanged, role, counting);
                    pipeline.depth_stencil->depth_bounds_test = has_depth_bounds(device, desc);
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
