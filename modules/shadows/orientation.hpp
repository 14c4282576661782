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

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// The sign (-1, 0, +1) of normal(a, b, c) . (light - a), or of normal . direction for a
/// directional light, exactly. +1: the triangle's counter-clockwise side faces the light. 0: its
/// plane contains the light, or it has no area. Cost: expansions of up to some hundred terms; for
/// the few faces that the filters of facing.hpp leave undecided.
[[nodiscard]] int exact_facing(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                               LightLocal light);

/// The same for points in double precision; `light` is (x, y, z, 1), or (x, y, z, 0) for a
/// direction. Coordinates must be multiples of 2^-300 below 2^300, so that no product leaves the
/// range of double.
[[nodiscard]] int exact_orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                    const glm::dvec4& light);

/// On which side of the plane through the light and the line from p to q is x? The sign of
/// det(p - x, q - x, light - x), or of det(p - x, q - x, direction), exactly. A point on the plane
/// counts as moved by (t, t^2, t^3) with t infinitely small: every plane gets the same answer about
/// one x, and 0 is left for a light on the line pq alone. After H. Edelsbrunner and E. P. Mücke,
/// "Simulation of Simplicity" (1990).
[[nodiscard]] int exact_side(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec4& light,
                             const glm::dvec3& x);

/// True when the three points lie on one line, exactly.
[[nodiscard]] bool exactly_collinear(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

}  // namespace gnomon::shadows
#pragma GCC visibility pop
