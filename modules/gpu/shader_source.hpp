// SPDX-License-Identifier: MIT
//
// One shader in the languages that the backends take; a build fills in those of its backends.
// SPIR-V and GLSL are made from one GLSL file, WGSL is written beside it.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#pragma GCC visibility push(default)
namespace gnomon::gpu {

/// One shader, once in each. All must say the same.
struct ShaderSource {
    std::span<const std::uint32_t> spirv = {};  ///< for Vulkan
    std::string_view glsl = {};  ///< desktop GLSL 4.30 for GL, made from that SPIR-V by SPIRV-Cross
    std::string_view wgsl = {};  ///< for WebGPU (docs/backends.md says how bindings are numbered)
};

}  // namespace gnomon::gpu
#pragma GCC visibility pop
