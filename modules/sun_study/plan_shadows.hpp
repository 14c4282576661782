// SPDX-License-Identifier: MIT
//
// PlanShadows: which cells of a plan grid the sun reaches, by shadow volumes drawn from above. It
// is the general way, which PlanScan and PlanProjection are held against. The plane alone receives:
// it is a depth that the depth buffer is cleared to. Casters are not drawn, so that what lies under
// a roof is seen too. A cell is one pixel, asked about at its centre.
//
// The mask is exact but for cells that a shadow's edge passes within 1/16 of a cell of the centre
// (a rasteriser moves vertices by up to 1/512 of a pixel), and for single cells within 1/128 of a
// cell of the line of an upright edge's shadow, where it is not that edge that decides: from
// straight above the side of a volume that begins there is a line as well, and at what depth an eye
// ray meets it is for rounding to say. One cell of 39,936 in the tests, beside a hole in a fence.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/sun_study/plan_grid.hpp>
#include <gnomon/sun_study/plan_mask.hpp>

namespace gnomon::sun_study {

struct PlanShadowsOptions {
    /// How silhouettes are found (shadows::SystemOptions). The sun creeps, which is what
    /// certificates are for.
    std::string_view silhouette = "certificates";
    /// Grids that are larger are drawn in tiles; 0: as suits the device.
    std::uint32_t most_cells_a_side = 0;
    shadows::Jobs jobs = {};
};

class PlanShadows {
public:
    /// `casters` have poses in gnomon's world of the plan's coordinates (plan_grid.hpp), however
    /// far from zero: they are brought to the grid's middle in double precision. Whether they are
    /// in a depth buffer is not asked. The device must outlive it. Fails as the device does.
    [[nodiscard]] static Result<PlanShadows> create(gpu::Device& device,
                                                    std::vector<shadows::Caster> casters,
                                                    const PlanGrid& grid,
                                                    const PlanShadowsOptions& options = {});
    PlanShadows(PlanShadows&&) noexcept;
    PlanShadows& operator=(PlanShadows&&) noexcept;
    ~PlanShadows();

    /// The cells for a sun in this direction (sun::towards_sun(): plan coordinates, z > 0). Towards
    /// the zenith, the cells in shadow are those that something lies straight above. Blocks until
    /// the device has drawn.
    [[nodiscard]] Result<PlanMask> lit(const glm::dvec3& towards_sun_plan);

    /// Of the last lit(), of its last tile.
    [[nodiscard]] const shadows::FrameStats& stats() const;

private:
    struct State;
    explicit PlanShadows(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace gnomon::sun_study
