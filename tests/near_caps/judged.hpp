// SPDX-License-Identifier: MIT
//
// The truth of a setting, light by light, traced once and held against many masks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <gnomon/truth/truth.hpp>

#include "tests/rows/rows.hpp"

namespace gnomon::test {

/// One picture a light, in the order of the lights' keys, which is a draw list's as well.
[[nodiscard]] std::vector<truth::Picture> trace_lights(const Setting& setting);

/// Sums over the lights. `masks`: by light.
[[nodiscard]] truth::Judgement judge_lights(std::span<const truth::Picture> truth,
                                            std::span<const std::vector<std::uint8_t>> masks);

/// The setting without the casters that two-sided casting is for: open and inconsistent meshes, and
/// poses that flatten. They are still drawn.
[[nodiscard]] Setting only_solids_cast(Setting setting);

}  // namespace gnomon::test
