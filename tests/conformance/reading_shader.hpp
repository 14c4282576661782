// SPDX-License-Identifier: MIT
//
// What a fragment shader reads: a full-screen pass with textures at bindings 1, 2, … and one
// uniform vector at binding 0, and the picture it leaves.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include <gnomon/gpu/device.hpp>

namespace gnomon::conformance {

struct ReadTexture {
    gpu::TextureId texture = {};
    gpu::SamplerId sampler = {};
    gpu::Aspect aspect = gpu::Aspect::Color;
    gpu::SampleType sample_type = gpu::SampleType::Float;
    bool multisampled = false;
};

struct ReadingDesc {
    gpu::ShaderSource fragment = {};
    std::vector<ReadTexture> textures = {};
    /// Sixteen bytes for binding 0: floats or integers, as the shader declares it; or no binding.
    std::optional<std::variant<std::array<float, 4>, std::array<std::int32_t, 4>>> block =
        std::nullopt;
    gpu::Format target_format = gpu::Format::Rgba32Float;
    std::uint32_t width = 1;
    std::uint32_t height = 1;
};

/// The target's texels, row 0 on top.
[[nodiscard]] std::vector<std::byte> read_by_shader(gpu::Device& device, const ReadingDesc& desc);

template <class T>
[[nodiscard]] std::vector<T> texels_as(const std::vector<std::byte>& bytes);

/// One sample of every pixel of a multisampled texture.
[[nodiscard]] std::vector<std::array<float, 4>> fetch_color_samples(gpu::Device& device,
                                                                    gpu::TextureId texture,
                                                                    std::uint32_t width,
                                                                    std::uint32_t height,
                                                                    std::int32_t sample);
[[nodiscard]] std::vector<std::uint8_t> fetch_stencil_samples(gpu::Device& device,
                                                              gpu::TextureId texture,
                                                              std::uint32_t width,
                                                              std::uint32_t height,
                                                              std::int32_t sample);

}  // namespace gnomon::conformance
