// SPDX-License-Identifier: MIT
//
// The truth of a setting, traced once and held against many masks.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <gnomon/truth/truth.hpp>

#include "tests/rows/rows.hpp"

namespace gnomon::test {

/// By light, in the order of the lights' keys, which is a draw list's as well; then by sample.
using Traced = std::vector<std::vector<truth::Picture>>;

/// `options.sample_position` is for one sample; four have the standard places, about which WebGPU
/// and Vulkan agree.
[[nodiscard]] Traced trace_lights(const Setting& setting,
                                  const truth::Options& options = {.width = row_width,
                                                                   .height = row_height},
                                  std::uint32_t samples = 1,
                                  truth::TreeBuilder builder = truth::TreeBuilder::Best);

/// Sums over lights and samples. `masks`: as Picture::masks (tests/rows/picture.hpp).
[[nodiscard]] truth::Judgement judge_lights(
    const Traced& traced, std::span<const std::vector<std::vector<std::uint8_t>>> masks);

/// The same for masks of one sample, by light.
[[nodiscard]] truth::Judgement judge_lights(const Traced& traced,
                                            std::span<const std::vector<std::uint8_t>> masks);

/// Where the first wrong pixels are, for a failure's message.
[[nodiscard]] std::string wrong_places(const truth::Judgement& judgement, std::uint32_t width);

}  // namespace gnomon::test
