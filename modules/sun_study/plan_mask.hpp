// SPDX-License-Identifier: MIT
//
// PlanMask: which cells of a plan grid the sun reaches, at one step. It is what every way of
// drawing plans gives: PlanScan, PlanProjection and PlanShadows.
#pragma once

#include <cstdint>
#include <vector>

namespace gnomon::sun_study {

/// By cell, row by row from the uppermost: 1 where the sun arrives, 0 in shadow.
using PlanMask = std::vector<std::uint8_t>;

}  // namespace gnomon::sun_study
