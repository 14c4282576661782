// SPDX-License-Identifier: MIT
//
// The other way to ask which cells of a plan the sun reaches: one ray a cell, by Embree, packed in
// any way that Embree has, all steps and rows on several threads. It is what the rest is held
// against, so it gets its best.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/sun_study/plan_grid.hpp>
#include <gnomon/sun_study/plan_mask.hpp>

namespace gnomon::bench {

enum class RayPacking {
    Rows16,     ///< rtcOccluded16: sixteen cells of a row
    Squares16,  ///< rtcOccluded16: four by four cells
    Rows8,      ///< rtcOccluded8: eight cells of a row
    Squares8,   ///< rtcOccluded8: four by two cells
    Stream,     ///< rtcOccluded1M: 16 by 16 cells as a stream
    Single,     ///< rtcOccluded1
};

class PlanRays {
public:
    /// All casters in one scene, about the grid's middle in single precision, built at high
    /// quality.
    PlanRays(std::span<const shadows::Caster> casters, const sun_study::PlanGrid& grid,
             shadows::Jobs jobs);
    ~PlanRays();
    PlanRays(const PlanRays&) = delete;
    PlanRays& operator=(const PlanRays&) = delete;

    /// As PlanScan::lit().
    [[nodiscard]] std::vector<sun_study::PlanMask> lit(std::span<const glm::dvec3> towards_suns,
                                                       RayPacking packing);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace gnomon::bench
