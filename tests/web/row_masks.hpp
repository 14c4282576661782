// SPDX-License-Identifier: MIT
//
// Masks and depth of the rows as one device draws them, and how they get from a browser into a file
// and out of it; with the scene to the bit, since what a C library makes of sines and tangents
// differs in last bits, and masks with it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>

#include "tests/rows/rows.hpp"

namespace gnomon::test {

struct RowMasks {
    std::string row;
    std::vector<double> poses;  ///< all world transforms and the view, column by column
    std::vector<std::vector<glm::vec3>> vertices;  ///< positions and normals, mesh by mesh
    std::uint32_t samples = 1;
    std::vector<std::vector<std::vector<std::uint8_t>>> masks;  ///< as Picture::masks
    std::vector<std::uint8_t> depth;                            ///< as Picture::depth
};

/// The same scene as `drawn` was made from, bit by bit.
[[nodiscard]] Setting setting_as_drawn(const Row& row, const RowMasks& drawn);
[[nodiscard]] Result<RowMasks> draw_setting(gpu::Device& device, const Row& row, Setting setting,
                                            std::uint32_t samples);

[[nodiscard]] Status write_masks(const std::filesystem::path& path,
                                 const std::vector<RowMasks>& all);
[[nodiscard]] Result<std::vector<RowMasks>> read_masks(const std::filesystem::path& path);

}  // namespace gnomon::test
