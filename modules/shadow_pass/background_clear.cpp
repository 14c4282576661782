// SPDX-License-Identifier: MIT
#include "internal/background_clear.hpp"

#include <utility>

#include <gnomon_shaders/shadow_pass.hpp>

namespace gnomon::shadow_pass::internal {

Result<BackgroundClear> BackgroundClear::create(gpu::Device& device, const ShadowPassDesc& desc) {
    auto vertex = device.create_shader({.label = "background",
                                        .stage = gpu::ShaderStage::Vertex,
                                        .source = shaders::background_vert});
    if (!vertex) return forward_error(vertex);
    auto fragment = device.create_shader({.label = "background fragments",
                                          .stage = gpu::ShaderStage::Fragment,
                                          .source = shaders::volume_frag});
    if (!fragment) return forward_error(fragment);
    const gpu::StencilFaceState zero{.compare = gpu::Compare::Always,
                                     .pass_op = gpu::StencilOp::Zero};
    gpu::RenderPipelineDesc pipeline{
        .label = "background clear",
        .vertex = *vertex,
        .fragment = *fragment,
        .depth_stencil = gpu::DepthStencilState{.format = desc.depth_stencil_format,
                                                .depth_compare = gpu::Compare::Equal,
                                                .stencil_front = zero,
                                                .stencil_back = zero},
        .sample_count = desc.sample_count};
    for (const gpu::Format format : desc.color_formats) {
        pipeline.targets.push_back({.format = format, .write_mask = gpu::ColorWrite::None});
    }
    auto made = device.create_render_pipeline(pipeline);
    if (!made) return forward_error(made);
    BackgroundClear result;
    result.pipeline_ = std::move(*made);
    // Where what is near has the lesser depth, what is farthest has 1.
    const bool forward =
        desc.depth_compare == gpu::Compare::Less || desc.depth_compare == gpu::Compare::LessEqual;
    result.first_vertex_ = forward ? 3 : desc.clip_from_minus_one ? 6 : 0;
    return result;
}

void BackgroundClear::record(gpu::RenderPassEncoder& encoder) const {
    encoder.set_pipeline(pipeline_);
    encoder.draw(3, 1, first_vertex_);
}

}  // namespace gnomon::shadow_pass::internal
