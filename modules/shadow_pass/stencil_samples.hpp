// SPDX-License-Identifier: MIT
//
// Reads one sample of a multisampled stencil buffer back, for tests and tools: no API copies one
// directly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadow_pass {

/// `texture`: four samples, TextureUsage::TextureBinding, width x height. One byte a pixel, row 0
/// on top. Needs Features::sampled_stencil. Makes what it needs and frees it again: slow.
[[nodiscard]] Result<std::vector<std::byte>> read_stencil_sample(gpu::Device& device,
                                                                 gpu::TextureId texture,
                                                                 std::uint32_t width,
                                                                 std::uint32_t height,
                                                                 std::uint32_t sample);

}  // namespace gnomon::shadow_pass
#pragma GCC visibility pop
