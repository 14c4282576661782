// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::test {

struct Image {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgba;
};

/// An empty image where it is none.
[[nodiscard]] Image decode_png(const std::string& bytes);

struct Difference {
    std::size_t pixels = 0;  ///< that differ by more than a channel's `tolerance`
    int largest = 0;
};
/// Of images of one size; all pixels differ of others.
[[nodiscard]] Difference difference(const Image& a, const Image& b, int tolerance = 0);

}  // namespace gnomon::test
