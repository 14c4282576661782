// SPDX-License-Identifier: MIT
//
// Masks as files: NumPy arrays of bytes, eight cells a byte, the first of them in the highest bit,
// each row beginning with a new byte. In NumPy:
//
//     packed = np.load("masks/2026-03-21T0900.npy")
//     mask = np.unpackbits(packed, axis=1, count=columns)  # 1: sun, 0: shadow; row 0 is the
//     uppermost
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/sun_study/plan_mask.hpp>

namespace gnomon::cli {

/// The file's bytes. The mask's are 0 and 1.
[[nodiscard]] std::string packed_mask(const sun_study::PlanMask& mask, std::uint32_t columns,
                                      std::uint32_t rows);

/// A matrix of numbers as a NumPy file, row by row.
[[nodiscard]] std::string number_matrix(std::span<const double> numbers, std::uint32_t columns);
/// Reads one. Fails as read_mask() does.
[[nodiscard]] Result<std::vector<double>> read_numbers(const std::filesystem::path& path,
                                                       std::uint32_t columns, std::uint32_t rows);

/// However many rows it has.
[[nodiscard]] Result<std::vector<double>> read_all_numbers(const std::filesystem::path& path,
                                                           std::uint32_t columns);

/// Fails with ErrorCode::Io where it cannot be read, with InvalidInput where it is no mask of this
/// size.
[[nodiscard]] Result<sun_study::PlanMask> read_mask(const std::filesystem::path& path,
                                                    std::uint32_t columns, std::uint32_t rows);

}  // namespace gnomon::cli
