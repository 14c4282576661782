// SPDX-License-Identifier: MIT
//
// Settings that the rows do not have: a smooth sphere of few triangles, an eye within a solid, a
// caster close above its receiver, solids alone.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "tests/rows/rows.hpp"

namespace gnomon::test {

/// A unit sphere at the origin, alone, under `sun_travel`; seen from +Z.
[[nodiscard]] Setting sphere_in_the_sun(std::uint32_t slices, std::uint32_t stacks,
                                        const glm::dvec3& sun_travel);

/// A closed sphere about everything, the eye included; a floor and a box in it; the sun outside.
[[nodiscard]] Setting eye_in_a_solid(bool solid_is_drawn);

/// An undrawn open sheet, `gap_m` above a floor, seen straight from above, 5 m away, with a near
/// plane at 0.01 m.
[[nodiscard]] Setting undrawn_sheet_above_a_floor(double gap_m);

/// The setting without the casters that two-sided casting is for: open and inconsistent meshes, and
/// poses that flatten. They are still drawn.
[[nodiscard]] Setting only_solids_cast(Setting setting);

}  // namespace gnomon::test
