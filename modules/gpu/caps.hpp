// SPDX-License-Identifier: MIT
//
// What an adapter can do. Chosen once, when the device is made; nothing asks the driver again.
#pragma once

#include <cstdint>
#include <string>

namespace gnomon::gpu {

struct Features {
    bool unclipped_depth =
        false;                  ///< depth clamping instead of clipping (WebGPU: depth-clip-control)
    bool depth_bounds = false;  ///< DepthStencilState::depth_bounds_test (not in WebGPU)
    bool timestamp_query = false;
    bool occlusion_query = false;  ///< exact sample counts
    bool depth24unorm_stencil8 = false;
    bool depth32float_stencil8 = false;
    bool multisample_4 = false;  ///< four samples, per-sample fetch of colour and stencil included
    bool sampled_stencil = false;  ///< a shader may read the stencil aspect
    bool exact_clip_space =
        false;  ///< z in 0..1 and row 0 on top without any flip: masks can be byte-equal
};

/// WebGPU's names and units.
struct Limits {
    std::uint32_t max_texture_dimension_2d = 0;
    std::uint32_t max_color_attachments = 0;
    std::uint32_t max_vertex_buffers = 0;
    std::uint32_t max_vertex_attributes = 0;
    std::uint64_t max_buffer_size = 0;
    std::uint64_t max_uniform_buffer_binding_size = 0;
    std::uint32_t min_uniform_buffer_offset_alignment = 256;
};

struct Caps {
    std::string backend;  ///< "gl", "vk" or "null"
    std::string adapter;  ///< the driver's own name for itself and its version
    std::string
        stencil_path;  ///< GL: "two-side", "separate" or "two-pass"; Vulkan and null: "native"
    Features features;
    Limits limits;
};

}  // namespace gnomon::gpu
