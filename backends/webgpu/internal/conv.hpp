// SPDX-License-Identifier: MIT
//
// Each enumeration in WebGPU's own words.
#pragma once

#include <cstdint>

#include <gnomon/gpu/types.hpp>

namespace gnomon::webgpu {

// Where WebGPU has no such value ("depth24unorm-stencil8"), the front lets none through, because
// the feature is off; then the text is empty.
[[nodiscard]] const char* to_webgpu(gpu::Format format);
[[nodiscard]] const char* to_webgpu(gpu::VertexFormat format);
[[nodiscard]] const char* to_webgpu(gpu::Aspect aspect);
[[nodiscard]] const char* to_webgpu(gpu::Compare compare);
[[nodiscard]] const char* to_webgpu(gpu::StencilOp op);
[[nodiscard]] const char* to_webgpu(gpu::PrimitiveTopology topology);
[[nodiscard]] const char* to_webgpu(gpu::FrontFace face);
[[nodiscard]] const char* to_webgpu(gpu::CullMode mode);
[[nodiscard]] const char* to_webgpu(gpu::VertexStepMode mode);
[[nodiscard]] const char* to_webgpu(gpu::BlendFactor factor);
[[nodiscard]] const char* to_webgpu(gpu::BlendOperation operation);
[[nodiscard]] const char* to_webgpu(gpu::AddressMode mode);
[[nodiscard]] const char* to_webgpu(gpu::FilterMode mode);
[[nodiscard]] const char* to_webgpu(gpu::QueryType type);

// Bit sets, as numbers.
[[nodiscard]] std::uint32_t to_webgpu(gpu::BufferUsage usage);
[[nodiscard]] std::uint32_t to_webgpu(gpu::TextureUsage usage);
[[nodiscard]] std::uint32_t to_webgpu(gpu::ShaderStage stages);
[[nodiscard]] std::uint32_t to_webgpu(gpu::ColorWrite mask);

}  // namespace gnomon::webgpu
