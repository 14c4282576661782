// SPDX-License-Identifier: MIT
//
// PlanTriangles: of all casters, what is above a plan's plane and may cast onto it, as triangles.
// Flattened onto the plane along the sun's rays, their union is the shadow (J. F. Blinn, "Me and My
// (Fake) Shadow", IEEE Computer Graphics and Applications 8(1), 1988).
//
// A ray that begins outside of a closed solid and meets it leaves it for good through a face that
// faces the sun; so of closed components above the plane those faces suffice. Of all others every
// face casts: of open ones, and of those that the plane cuts, in which a ray may begin. What is
// below the plane is cut off here, once, since where a face meets the plane does not depend on the
// sun.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/sun_study/plan_grid.hpp>

namespace gnomon::sun_study::internal {

struct PlanTriangles {
    /// In plan coordinates about the grid's middle: metres, z the height above the plane, never
    /// below 0. Faces that share an edge of the mesh share its vertices, where it was cut as well.
    std::vector<glm::dvec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> faces;
    /// So many faces, the first, cast only where they are counter-clockwise as the sun sees them.
    std::size_t one_sided = 0;
};

/// Poses are in gnomon's world of the plan's coordinates and brought to the grid's middle in double
/// precision. Faces without area, in the plane or below it are left out. Cost: O(n log n).
[[nodiscard]] PlanTriangles plan_triangles(std::span<const shadows::Caster> casters,
                                           const PlanGrid& grid);

/// Where on the plane the shadow of a point at height 1 falls, from the point's foot. A sun nearer
/// to the horizon than 1e-9 radians counts as that near.
[[nodiscard]] inline glm::dvec2 shadow_of_height_1(const glm::dvec3& towards_sun_plan) {
    return glm::dvec2(towards_sun_plan) / -std::max(towards_sun_plan.z, 1e-9);
}

}  // namespace gnomon::sun_study::internal
