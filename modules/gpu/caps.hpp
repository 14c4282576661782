// SPDX-License-Identifier: MIT
//
// What an adapter can do. Chosen once, when the device is made; nothing asks the driver again.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#pragma GCC visibility push(default)
namespace gnomon::gpu {

/// What is there. What is not is refused when it is asked for, with ErrorCode::Validation.
struct Features {
    bool unclipped_depth =
        false;                  ///< depth clamping instead of clipping (WebGPU: depth-clip-control)
    bool depth_bounds = false;  ///< DepthStencilState::depth_bounds_test (not in WebGPU)
    bool timestamp_query = false;        ///< TimestampWrites
    bool occlusion_query = false;        ///< exact sample counts
    bool depth24unorm_stencil8 = false;  ///< Format::Depth24UnormStencil8
    bool depth32float_stencil8 = false;  ///< Format::Depth32FloatStencil8
    bool multisample_4 = false;  ///< four samples, per-sample fetch of colour and stencil included
    /// R32Uint, Rgba32Uint and Rgba32Float may have four samples as well (not in WebGPU).
    bool multisample_32bit = false;
    bool sample_shading = false;   ///< a shader may run once a sample (gl_SampleID)
    bool sampled_stencil = false;  ///< a shader may read the stencil aspect
    bool exact_clip_space =
        false;  ///< z in 0..1 and row 0 on top without any flip: masks can be byte-equal
};

/// WebGPU's names and units.
struct Limits {
    std::uint32_t max_texture_dimension_2d = 0;         ///< texels a side
    std::uint32_t max_color_attachments = 0;            ///< of one pass
    std::uint32_t max_vertex_buffers = 0;               ///< of one pipeline
    std::uint32_t max_vertex_attributes = 0;            ///< of one pipeline
    std::uint64_t max_buffer_size = 0;                  ///< bytes
    std::uint64_t max_uniform_buffer_binding_size = 0;  ///< bytes of one binding
    std::uint32_t min_uniform_buffer_offset_alignment =
        256;  ///< bytes; of offsets of uniform bindings
    /// Where there are several samples, only scissors that begin at multiples of it, from the left
    /// and from the top, cut exactly (not in WebGPU). 1 but for Mesa's software rasterisers, which
    /// draw samples up to half a pixel outside of others.
    std::uint32_t multisample_scissor_alignment = 1;
};

/// Limits::multisample_scissor_alignment of an adapter: llvmpipe and lavapipe (seen in Mesa 22.3.6)
/// draw by tiles of 64 pixels, and at the border of one nothing gets across.
[[nodiscard]] inline std::uint32_t multisample_scissor_alignment_of(std::string_view adapter) {
    return adapter.find("llvmpipe") != std::string_view::npos ? 64 : 1;
}

/// An adapter: who it is, what it has, how much of it.
struct Caps {
    std::string backend;       ///< "gl", "vk", "webgpu" or "null"
    std::string adapter;       ///< the driver's own name for itself and its version
    std::string stencil_path;  ///< GL: "two-side", "separate" or "two-pass"; all others: "native"
    Features features;         ///< what it has
    Limits limits;             ///< how much of it
};

}  // namespace gnomon::gpu
#pragma GCC visibility pop
