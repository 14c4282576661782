// SPDX-License-Identifier: MIT
//
// Every pipeline of the renderer, made once. Bind groups: 0 the draw (or the volume), 1 the round
// of lights or the overlay colour, 2 the material, 3 the light mask.
#pragma once

#include <array>

#include <gnomon/gpu/device.hpp>
#include <gnomon/render/renderer.hpp>
#include <gnomon/shadow_pass/shadow_pass.hpp>

namespace gnomon::render::internal {

/// Band k of the fill overlay: stencil values from 2^k on, below 2^(k+1).
inline constexpr std::uint32_t fill_bands = 8;

/// Which triangles a geometry pipeline leaves out. A mirrored instance turns its winding over.
enum class Culling : std::uint8_t { None, Back, BackMirrored };

/// A pipeline that draws the scene, in each way it may have to. Under a projection with a far plane
/// volumes are drawn without clipping; caps lie on surfaces bit for bit only if the scene is drawn
/// the same way.
struct GeometryPipelines {
    std::array<gpu::RenderPipeline, 3> clipped;    // by Culling
    std::array<gpu::RenderPipeline, 3> unclipped;  // where the adapter can

    [[nodiscard]] gpu::RenderPipelineId get(Culling culling, bool is_unclipped) const {
        return (is_unclipped ? unclipped : clipped)[static_cast<std::size_t>(culling)];
    }
};

struct Pipelines {
    gpu::BindGroupLayout draw_layout;     // binding 1, dynamic
    gpu::BindGroupLayout round_layout;    // binding 0, dynamic
    gpu::BindGroupLayout empty_layout;    // group 0 of shaders that read group 1 alone
    gpu::BindGroupLayout overlay_layout;  // binding 4, dynamic
    gpu::BindGroupLayout mask_layout;     // binding 5; with several samples 6, whose each is
    gpu::BindGroupLayout tone_map_layout;
    GeometryPipelines depth;                   // of what has holes, and where nothing is clipped
    GeometryPipelines depth_of_opaque;         // reads positions alone
    std::array<GeometryPipelines, 2> forward;  // the first round of lights, and later ones, added
    gpu::RenderPipeline mask;                  // stencil to mask; the stencil is 0 afterwards
    gpu::RenderPipeline mask_kept;             // the same, and the stencil stays
    gpu::RenderPipeline tone_map;
    gpu::RenderPipeline wireframe;
    gpu::RenderPipeline volume_triangles;
    gpu::RenderPipeline volume_lines;
    gpu::RenderPipeline count;
    std::array<gpu::RenderPipeline, fill_bands> fill;
};

[[nodiscard]] Result<Pipelines> create_pipelines(gpu::Device& device, const RendererDesc& desc,
                                                 gpu::BindGroupLayoutId material_layout,
                                                 const shadow_pass::ShadowPass& shadows);

}  // namespace gnomon::render::internal
