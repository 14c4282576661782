// SPDX-License-Identifier: MIT
#include "internal/targets.hpp"

namespace gnomon::render::internal {

Result<Targets> create_targets(gpu::Device& device, const RendererDesc& desc) {
    using gpu::TextureUsage;
    const bool multisampled = desc.sample_count > 1;
    Targets targets;
    Status status;
    const auto create = [&](const char* label, gpu::Format format, std::uint32_t samples,
                            TextureUsage usage, gpu::Texture& texture) {
        if (!status) return;
        auto made = device.create_texture({.label = label,
                                           .width = desc.width,
                                           .height = desc.height,
                                           .format = format,
                                           .usage = usage | TextureUsage::RenderAttachment,
                                           .sample_count = samples});
        if (made) {
            texture = std::move(*made);
        } else {
            status = forward_error(made);
        }
    };
    create("radiance", radiance_format, desc.sample_count,
           multisampled ? TextureUsage::None : TextureUsage::TextureBinding, targets.radiance);
    if (multisampled) {
        create("resolved radiance", radiance_format, 1, TextureUsage::TextureBinding,
               targets.resolved);
    }
    // A multisampled stencil can only be read by a shader, a single-sampled one only by a copy.
    create("depth-stencil", desc.depth_stencil_format, desc.sample_count,
           multisampled ? TextureUsage::TextureBinding : TextureUsage::CopySrc,
           targets.depth_stencil);
    if (multisampled) {
        create("fragment depth", fragment_depth_format, desc.sample_count,
               TextureUsage::TextureBinding, targets.fragment_depth);
    }
    create("light mask", mask_format, desc.sample_count, TextureUsage::TextureBinding,
           targets.mask);
    create("picture", picture_format, 1, TextureUsage::CopySrc, targets.picture);
    if (!status) return forward_error(status);
    return targets;
}

}  // namespace gnomon::render::internal
