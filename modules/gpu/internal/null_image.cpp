// SPDX-License-Identifier: MIT
#include "internal/null_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <glm/gtc/packing.hpp>

namespace gnomon::gpu {

namespace {

constexpr double depth24_steps = (1 << 24) - 1;

double srgb_from_linear(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

std::uint8_t unorm8(double value) {
    // The comparison is false for NaN, which a GPU stores as 0.
    return value > 0.0 ? static_cast<std::uint8_t>(std::lround(std::min(value, 1.0) * 255.0))
                       : std::uint8_t{0};
}

using Texel = std::array<std::byte, 16>;

template <class T, std::size_t N>
Texel pack(const std::array<T, N>& channels) {
    static_assert(sizeof(T) * N <= sizeof(Texel));
    Texel texel{};
    std::memcpy(texel.data(), channels.data(), sizeof(T) * N);
    return texel;
}

Texel encode(Format format, const Color& c) {
    const auto half = [](double value) { return glm::packHalf1x16(static_cast<float>(value)); };
    const auto srgb = [](double value) {
        return unorm8(srgb_from_linear(std::clamp(value, 0.0, 1.0)));
    };
    switch (format) {
        case Format::R8Unorm: return pack(std::array{unorm8(c.r)});
        case Format::R8Uint: return pack(std::array{static_cast<std::uint8_t>(c.r)});
        case Format::R32Uint: return pack(std::array{static_cast<std::uint32_t>(c.r)});
        case Format::R32Float: return pack(std::array{static_cast<float>(c.r)});
        case Format::Rgba8Unorm:
            return pack(std::array{unorm8(c.r), unorm8(c.g), unorm8(c.b), unorm8(c.a)});
        case Format::Rgba8UnormSrgb:
            return pack(std::array{srgb(c.r), srgb(c.g), srgb(c.b), unorm8(c.a)});
        case Format::Rgba16Float:
            return pack(std::array{half(c.r), half(c.g), half(c.b), half(c.a)});
        case Format::Rgba32Float:
            return pack(std::array{static_cast<float>(c.r), static_cast<float>(c.g),
                                   static_cast<float>(c.b), static_cast<float>(c.a)});
        case Format::Rgba32Uint:
            return pack(std::array{static_cast<std::uint32_t>(c.r), static_cast<std::uint32_t>(c.g),
                                   static_cast<std::uint32_t>(c.b),
                                   static_cast<std::uint32_t>(c.a)});
        default: return {};
    }
}

}  // namespace

NullImage::NullImage(const TextureDesc& desc) : format_(desc.format) {
    const std::size_t pixels = std::size_t{desc.width} * desc.height;
    if (has_color(format_)) {
        color_mips_.resize(desc.mip_level_count);
        for (std::uint32_t mip = 0; mip < desc.mip_level_count; ++mip) {
            const std::size_t width = std::max(desc.width >> mip, 1U);
            const std::size_t height = std::max(desc.height >> mip, 1U);
            color_mips_[mip].resize(width * height * texel_bytes(format_));
        }
    }
    if (has_depth(format_)) depth_.resize(pixels);
    if (has_stencil(format_)) stencil_.resize(pixels);
}

void NullImage::write(std::uint32_t mip_level, std::span<const std::byte> data) {
    std::ranges::copy(data, color_mips_[mip_level].begin());
}

void NullImage::read(Aspect aspect, std::span<std::byte> data) const {
    switch (aspect) {
        case Aspect::Color: std::ranges::copy(color_mips_.front(), data.begin()); return;
        case Aspect::DepthOnly: std::memcpy(data.data(), depth_.data(), data.size()); return;
        case Aspect::StencilOnly: std::ranges::copy(stencil_, data.begin()); return;
    }
}

void NullImage::clear_color(const Color& color) {
    const Texel texel = encode(format_, color);
    const std::uint32_t bytes = texel_bytes(format_);
    std::vector<std::byte>& pixels = color_mips_.front();
    for (std::size_t i = 0; i < pixels.size(); i += bytes) {
        std::copy_n(texel.begin(), bytes, pixels.begin() + static_cast<std::ptrdiff_t>(i));
    }
}

void NullImage::clear_depth(float depth) {
    if (format_ == Format::Depth24UnormStencil8) {
        depth = static_cast<float>(std::round(depth * depth24_steps) / depth24_steps);
    }
    std::ranges::fill(depth_, depth);
}

void NullImage::clear_stencil(std::uint32_t stencil) {
    std::ranges::fill(stencil_, static_cast<std::byte>(stencil));
}

void NullImage::copy_color_from(const NullImage& source) {
    color_mips_.front() = source.color_mips_.front();
}

}  // namespace gnomon::gpu
