// SPDX-License-Identifier: MIT
//
// One shader in the two languages the backends take. Both are made at build time from one GLSL
// file.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#pragma GCC visibility push(default)
namespace gnomon::gpu {

/// One shader, twice. Both must say the same.
struct ShaderSource {
    std::span<const std::uint32_t> spirv;  ///< for Vulkan
    std::string_view glsl;  ///< desktop GLSL 4.30 for GL, made from that SPIR-V by SPIRV-Cross
};

}  // namespace gnomon::gpu
#pragma GCC visibility pop
