// SPDX-License-Identifier: MIT
//
// The backend that draws nothing: it accepts everything, keeps buffers and textures as plain memory
// (so that writes can be read back), executes clears of render passes and counts. Validation tests,
// CPU benchmarks and fuzzing run on it.
#pragma once

#include <memory>

#include <gnomon/gpu/backend.hpp>

#pragma GCC visibility push(default)
namespace gnomon::gpu {

/// What the null device says of itself.
struct NullBackendOptions {
    /// All there are.
    Features features = {.unclipped_depth = true,
                         .depth_bounds = true,
                         .timestamp_query = true,
                         .occlusion_query = true,
                         .depth24unorm_stencil8 = true,
                         .depth32float_stencil8 = true,
                         .multisample_4 = true,
                         .multisample_32bit = true,
                         .sample_shading = true,
                         .sampled_stencil = true,
                         .exact_clip_space = true};
};

/// Never fails. Cost: nothing; textures and buffers are memory of the process.
[[nodiscard]] std::unique_ptr<Backend> create_null_backend(const NullBackendOptions& options = {});

}  // namespace gnomon::gpu
#pragma GCC visibility pop
