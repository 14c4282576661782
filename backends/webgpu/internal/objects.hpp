// SPDX-License-Identifier: MIT
//
// Descriptors written down: each is the dictionary that WebGPU wants, in JSON, in which objects are
// their ids' indices (bridge.js puts the objects in their places).
#pragma once

#include <cstdint>
#include <string>

#include <gnomon/gpu/descriptors.hpp>

namespace gnomon::webgpu {

/// A texture and its sampler are one binding of gnomon's and two of WebGPU's: the sampler has the
/// texture's number and this.
inline constexpr std::uint32_t sampler_binding_offset = 100;

/// Whether a binding has a sampler beside its texture: integers, depth and samples are fetched.
[[nodiscard]] bool has_sampler(const gpu::BindGroupLayoutEntry& entry);

[[nodiscard]] std::string describe(const gpu::BufferDesc& desc);
[[nodiscard]] std::string describe(const gpu::TextureDesc& desc);
/// `adopted`: a host's, by the number that HostTexture has.
[[nodiscard]] std::string describe(const gpu::TextureDesc& desc, std::uint32_t adopted);
[[nodiscard]] std::string describe(const gpu::SamplerDesc& desc);
[[nodiscard]] std::string describe(const gpu::ShaderDesc& desc);
[[nodiscard]] std::string describe(const gpu::BindGroupLayoutDesc& desc);
/// `layout` is what the group was laid out by.
[[nodiscard]] std::string describe(const gpu::BindGroupDesc& desc,
                                   const gpu::BindGroupLayoutDesc& layout);
[[nodiscard]] std::string describe(const gpu::RenderPipelineDesc& desc);
[[nodiscard]] std::string describe(const gpu::QuerySetDesc& desc);

}  // namespace gnomon::webgpu
