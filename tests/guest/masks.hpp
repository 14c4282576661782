// SPDX-License-Identifier: MIT
//
// What every guest's masks are held against: the traced truth, and the masks of gnomon's own
// renderer. Each is made once for a row and kept.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gnomon/shadow_pass/guest_pass.hpp>
#include <gnomon/shadows/shadow_system.hpp>

#include "tests/rows/rows.hpp"

namespace gnomon::test {

struct MaskOptions {
    std::optional<shadows::Technique> technique = std::nullopt;
    shadows::Receivers receivers = shadows::Receivers::Submitted;
    std::string silhouette = "auto";
};

[[nodiscard]] const Setting& setting_of(const std::string& row);

/// The volumes of the row as its host's camera sees them.
[[nodiscard]] shadows::DrawList list_of(const std::string& row, const MaskOptions& options,
                                        const shadows::View& view);

/// By light; one byte a pixel, row 0 on top. Fails the test where a mask is wrong outside the band
/// round true edges, or its counts are not those of gnomon's own renderer there, in more than one
/// pixel of 500.
void expect_true(const std::string& row, const MaskOptions& options,
                 const std::vector<std::vector<std::uint8_t>>& masks);

/// The shadows of four samples alone, each where it lies: [light][sample]. `mirrored`: the places
/// are upside down as the picture is seen, since row 0 of what was drawn is at the bottom.
void expect_true_samples(const std::string& row,
                         const std::vector<std::vector<std::vector<std::uint8_t>>>& masks,
                         bool mirrored);

/// The shadows of a light mask's bits alone, of one sample.
void expect_true_bits(const std::string& row, const std::vector<std::uint32_t>& bits);

/// How many bits are not what the stencils, [light], say: set where they are not 0.
[[nodiscard]] std::size_t wrong_bits(const std::vector<std::uint32_t>& bits,
                                     const std::vector<std::vector<std::uint8_t>>& stencils);

}  // namespace gnomon::test
