// SPDX-License-Identifier: MIT
#include "internal/stencil_fold.hpp"

#include <utility>

#include <gnomon_shaders/shadow_pass.hpp>

namespace gnomon::shadow_pass::internal {

namespace {

constexpr std::uint32_t sticky_bit = 0x80;
constexpr std::uint32_t shadowed = 0xFF;

// Replaces the stencil by the reference where the bits of `read_mask` compare so.
gpu::DepthStencilState replacing(const ShadowPassDesc& desc, gpu::Compare compare,
                                 std::uint32_t read_mask) {
    const gpu::StencilFaceState face{.compare = compare, .pass_op = gpu::StencilOp::Replace};
    return {.format = desc.depth_stencil_format,
            .depth_compare = gpu::Compare::Always,
            .stencil_front = face,
            .stencil_back = face,
            .stencil_read_mask = read_mask};
}

}  // namespace

Result<StencilFold> StencilFold::create(gpu::Device& device, const ShadowPassDesc& desc) {
    auto vertex = device.create_shader({.label = "full screen",
                                        .stage = gpu::ShaderStage::Vertex,
                                        .source = shaders::full_screen_vert});
    if (!vertex) return forward_error(vertex);
    auto fragment = device.create_shader({.label = "stencil fold fragments",
                                          .stage = gpu::ShaderStage::Fragment,
                                          .source = shaders::volume_frag});
    if (!fragment) return forward_error(fragment);
    gpu::RenderPipelineDesc pipeline{.vertex = *vertex, .fragment = *fragment};
    for (const gpu::Format format : desc.color_formats) {
        pipeline.targets.push_back({.format = format, .write_mask = gpu::ColorWrite::None});
    }
    pipeline.sample_count = desc.sample_count;

    StencilFold result;
    // The reference is the sticky bit alone, so under the mask it compares as 0.
    pipeline.label = "stencil fold";
    pipeline.depth_stencil = replacing(desc, gpu::Compare::NotEqual, count_mask);
    auto fold = device.create_render_pipeline(pipeline);
    if (!fold) return forward_error(fold);
    result.fold_ = std::move(*fold);
    pipeline.label = "stencil fold, finish";
    pipeline.depth_stencil = replacing(desc, gpu::Compare::Equal, sticky_bit);
    auto finish = device.create_render_pipeline(pipeline);
    if (!finish) return forward_error(finish);
    result.finish_ = std::move(*finish);
    return result;
}

void StencilFold::fold(gpu::RenderPassEncoder& encoder) const {
    encoder.set_pipeline(fold_);
    encoder.set_stencil_reference(sticky_bit);
    encoder.draw(3);
}

void StencilFold::finish(gpu::RenderPassEncoder& encoder) const {
    encoder.set_pipeline(finish_);
    encoder.set_stencil_reference(shadowed);
    encoder.draw(3);
}

}  // namespace gnomon::shadow_pass::internal
