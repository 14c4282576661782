// SPDX-License-Identifier: MIT
//
// A texture of the null backend: texels in memory. All samples of a multisampled texture are kept
// as one, since without drawing they never differ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <gnomon/gpu/descriptors.hpp>

namespace gnomon::gpu {

class NullImage {
public:
    explicit NullImage(const TextureDesc& desc);  ///< contents start as zero

    void write(std::uint32_t mip_level, std::span<const std::byte> data);
    void read(Aspect aspect, std::span<std::byte> data) const;

    // Mip level 0, converted to the format as a GPU converts it.
    void clear_color(const Color& color);
    void clear_depth(float depth);
    void clear_stencil(std::uint32_t stencil);
    /// Mip level 0 of an image with the same size and format.
    void copy_color_from(const NullImage& source);

private:
    Format format_;
    std::vector<std::vector<std::byte>> color_mips_;
    std::vector<float> depth_;
    std::vector<std::byte> stencil_;
};

}  // namespace gnomon::gpu
