// SPDX-License-Identifier: MIT
//
// Slabs: which parts of a volume are worth drawing, where along the light's way there are gaps
// without receivers. After D. B. Lloyd et al., "CC Shadow Volumes" (2004).
#pragma once

#include <glm/glm.hpp>

#include <gnomon/shadows/shadow_system.hpp>

#include "reach.hpp"
#include "shadow_hull.hpp"

namespace gnomon::shadows::internal {

/// Writes VolumeDraw::slabs, which is empty before, where they seem to save fragments: the draw is
/// complete otherwise, its far vertices are on the reach's plane, and `light` is in the caster's
/// space. What is saved is taken from the caster's bounds on the picture, as if they cast. Cost:
/// some microseconds.
void slabs_of(VolumeDraw& draw, const ShadowHull& hull, const Reach& reach, const Screen& screen,
              const glm::dvec4& light, bool scissor);

}  // namespace gnomon::shadows::internal
