// SPDX-License-Identifier: MIT
//
// A site to study: a house with a gable, a porch roof, a fence with holes and a few things more.
#pragma once

#include <vector>

#include <gnomon/scene/mesh.hpp>
#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/sun_study/plan_grid.hpp>

namespace gnomon::sun_study::test {

/// A mesh at a place of the plan.
[[nodiscard]] shadows::Caster caster_of(std::uint64_t key, const scene::Mesh& mesh,
                                        const glm::dvec3& at_plan);

/// All casters of the site, moved by `shift_plan`. Some 30 m wide and 9 m high, about the origin,
/// on the height 0 of the plan.
[[nodiscard]] std::vector<shadows::Caster> site(const glm::dvec3& shift_plan = glm::dvec3(0.0));

/// A fence: an upright sheet along x with holes in it, open everywhere.
[[nodiscard]] scene::Mesh fence(double length_m, double height_m, std::uint32_t cells);

/// A closed house: walls and a gable along x.
[[nodiscard]] scene::Mesh house(double width_m, double depth_m, double eaves_m, double ridge_m);

/// Cells that two ways of drawing must agree about, by the way that is exact: those with one answer
/// in nine places within 1/16 of a cell of their centres.
[[nodiscard]] std::vector<bool> cells_off_edges(std::span<const shadows::Caster> casters,
                                                const PlanGrid& grid, const glm::dvec3& sun);

/// Of the site, of 0.25 m cells.
[[nodiscard]] PlanGrid site_grid(const glm::dvec3& shift_plan = glm::dvec3(0.0));

}  // namespace gnomon::sun_study::test
