// SPDX-License-Identifier: MIT
//
// The exact predicate under everything: on which side of a triangle's plane does a light lie?
//
// Source: J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
// Predicates", Discrete & Computational Geometry 18 (1997): expansions (section 2), orient3d
// (section 4.3).
#pragma once

#include <glm/glm.hpp>

#include <gnomon/shadows/light.hpp>

namespace gnomon::shadows {

/// The sign (-1, 0, +1) of normal(a, b, c) . (light - a), or of normal . direction for a
/// directional light, exactly. +1: the triangle's counter-clockwise side faces the light. 0: its
/// plane contains the light, or it has no area. Cost: expansions of up to some hundred terms; for
/// the few faces that the filters of facing.hpp leave undecided.
[[nodiscard]] int exact_facing(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                               LightLocal light);

/// True when the three points lie on one line, exactly.
[[nodiscard]] bool exactly_collinear(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

}  // namespace gnomon::shadows
