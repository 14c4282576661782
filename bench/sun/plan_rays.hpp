// SPDX-License-Identifier: MIT
//
// The other way to ask which cells of a plan the sun reaches: one ray a cell, by Embree, in packets
// of 16 on several threads. It is what the stencil path is held against.
#pragma once

#include <span>

#include <gnomon/sun_study/plan_shadows.hpp>

namespace gnomon::bench {

class PlanRays {
public:
    /// All casters in one scene, about the grid's middle in single precision.
    PlanRays(std::span<const shadows::Caster> casters, const sun_study::PlanGrid& grid,
             unsigned threads);
    ~PlanRays();
    PlanRays(const PlanRays&) = delete;
    PlanRays& operator=(const PlanRays&) = delete;

    /// As PlanShadows::lit().
    [[nodiscard]] sun_study::PlanMask lit(const glm::dvec3& towards_sun_plan);

private:
    struct State;
    State* state_;
};

}  // namespace gnomon::bench
