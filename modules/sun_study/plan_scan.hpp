// SPDX-License-Identifier: MIT
//
// PlanScan: which cells of a plan grid the sun reaches, by scan conversion on the processor. All
// that casts is flattened onto the plane along the sun's rays (planar projected shadows: J. F.
// Blinn, 1988); of the flattened faces only those edges are scanned whose faces do not cancel,
// which are the shadows' borders: a silhouette, and what is cut or open. It needs no device, and
// its masks are the same bytes on every machine that computes in IEEE doubles.
//
// It is for one flat receiver. A cell is asked about at its centre; the mask is exact but for cells
// whose centre a shadow's edge passes within some 1e-9 of a cell, and for what is thinner than ten
// times that.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/sun_study/plan_grid.hpp>
#include <gnomon/sun_study/plan_mask.hpp>

namespace gnomon::sun_study {

class PlanScan {
public:
    /// As PlanShadows::create() has it, without its limits: grids may be of any size. `jobs` runs
    /// suns side by side. Cost: linear in the triangles.
    PlanScan(std::span<const shadows::Caster> casters, const PlanGrid& grid,
             shadows::Jobs jobs = {});
    PlanScan(PlanScan&&) noexcept;
    PlanScan& operator=(PlanScan&&) noexcept;
    ~PlanScan();

    /// A mask a sun, as PlanShadows::lit() has it. Cost of each: a look at each face and edge, one
    /// at each cell, and one for each row of cells that a piece of border crosses.
    [[nodiscard]] std::vector<PlanMask> lit(std::span<const glm::dvec3> towards_suns_plan);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace gnomon::sun_study
