// SPDX-License-Identifier: MIT
#include "tests/view/png.hpp"

#include <algorithm>
#include <cstdlib>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb/stb_image.h>

namespace gnomon::test {

Image decode_png(const std::string& bytes) {
    int width = 0;
    int height = 0;
    int channels = 0;
    stbi_uc* pixels =
        stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),
                              static_cast<int>(bytes.size()), &width, &height, &channels, 4);
    if (pixels == nullptr) return {};
    Image image{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
    image.rgba.assign(pixels, pixels + std::size_t{4} * image.width * image.height);
    stbi_image_free(pixels);
    return image;
}

Difference difference(const Image& a, const Image& b, int tolerance) {
    if (a.width != b.width || a.height != b.height || a.rgba.empty()) {
        return {std::max<std::size_t>({a.rgba.size(), b.rgba.size(), 4}) / 4, 255};
    }
    Difference result;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        int largest = 0;
        for (std::size_t c = i; c < i + 4; ++c) {
            largest = std::max(largest, std::abs(a.rgba[c] - b.rgba[c]));
        }
        result.largest = std::max(result.largest, largest);
        result.pixels += largest > tolerance ? 1 : 0;
    }
    return result;
}

}  // namespace gnomon::test
