// SPDX-License-Identifier: MIT
//
// The textures that a frame is drawn into.
#pragma once

#include <gnomon/gpu/device.hpp>
#include <gnomon/render/renderer.hpp>

namespace gnomon::render::internal {

inline constexpr gpu::Format radiance_format = gpu::Format::Rgba16Float;
/// Of the light mask: a bit a light, set where the light does not arrive.
inline constexpr gpu::Format mask_format = gpu::Format::R8Unorm;
inline constexpr gpu::Format fragment_depth_format = gpu::Format::R32Float;
inline constexpr gpu::Format picture_format = gpu::Format::Rgba8Unorm;

struct Targets {
    gpu::Texture radiance;  ///< multisampled where the renderer is
    gpu::Texture resolved;  ///< only then
    gpu::Texture depth_stencil;
    gpu::Texture mask;            ///< as many samples as radiance
    gpu::Texture fragment_depth;  ///< whose each sample is; where there are several
    gpu::Texture picture;

    [[nodiscard]] gpu::TextureId single_sampled_radiance() const {
        return resolved ? resolved.id() : radiance.id();
    }
};

[[nodiscard]] Result<Targets> create_targets(gpu::Device& device, const RendererDesc& desc);

}  // namespace gnomon::render::internal
