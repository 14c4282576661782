// SPDX-License-Identifier: MIT
//
// PlanProjection: which cells of a plan grid the sun reaches, by planar projected shadows (J. F.
// Blinn, 1988) that a device draws. All that casts is flattened onto the plane by an orthographic
// matrix that is sheared along the sun's rays. Vertices are written once; what a step costs is a
// matrix. Eight steps share a stencil buffer, a bit each, and are read back at a time.
//
// It is for one flat receiver. A cell is one pixel, asked about at its centre; the mask is exact
// but for cells that a shadow's edge passes within 1/16 of a cell of the centre, as long as no
// corner that casts, nor its shadow, is farther than 200,000 cells from the middle of the grid:
// vertices and matrices are single precision on a device. Beyond that it grows with the distance;
// PlanScan has no such bound.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/sun_study/plan_grid.hpp>
#include <gnomon/sun_study/plan_mask.hpp>

namespace gnomon::sun_study {

struct PlanProjectionOptions {
    /// Grids that are larger are drawn in tiles; 0: as suits the device.
    std::uint32_t most_cells_a_side = 0;
    shadows::Jobs jobs = {};
};

class PlanProjection {
public:
    /// Drawn before a buffer is read: the bits of its stencil.
    static constexpr std::size_t steps_a_buffer = 8;

    /// As PlanShadows::create() has it.
    [[nodiscard]] static Result<PlanProjection> create(gpu::Device& device,
                                                       std::span<const shadows::Caster> casters,
                                                       const PlanGrid& grid,
                                                       const PlanProjectionOptions& options = {});
    PlanProjection(PlanProjection&&) noexcept;
    PlanProjection& operator=(PlanProjection&&) noexcept;
    ~PlanProjection();

    /// A mask a sun, as PlanShadows::lit() has it. Multiples of twice steps_a_buffer suit it best:
    /// of two buffers one is read while the other is drawn.
    [[nodiscard]] Result<std::vector<PlanMask>> lit(std::span<const glm::dvec3> towards_suns_plan);

private:
    struct State;
    explicit PlanProjection(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace gnomon::sun_study
