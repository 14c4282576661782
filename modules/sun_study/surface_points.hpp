// SPDX-License-Identifier: MIT
//
// Surface points: places on façades and roofs at which a sun study asks by shadow queries, where a
// plan asks its cells. Each stands for a patch, a piece of a face.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/shadows/shadow_query.hpp>
#include <gnomon/shadows/shadow_system.hpp>

namespace gnomon::sun_study {

struct SurfacePoint {
    glm::dvec3 at_plan{0.0};  ///< the patch's middle, in plan coordinates (plan_grid.hpp)
    glm::dvec3 normal_plan{
        0.0};  ///< unit: the side from which the mesh's face is counter-clockwise
    double area_m2 = 0.0;
    std::array<glm::dvec3, 3> corners_plan{};  ///< of the patch
};

/// Patches of the faces of `receivers`, each face halved along its longest side until none is
/// longer than `spacing_m`. Left out are faces without area and those that look straight down, to
/// 2.6 degrees, which only a sun as low could reach. Mirrored poses keep what is outside. Fails
/// with ErrorCode::InvalidInput for more than `most_points`. Cost: linear in the points.
[[nodiscard]] Result<std::vector<SurfacePoint>> sample_surfaces(
    std::span<const shadows::Caster> receivers, double spacing_m, std::size_t most_points);

/// By point: 1 where the sun arrives, 0 where the surface is turned away from it or in shadow.
/// `towards_sun_plan` as PlanShadows::lit() has it. Points are lifted off their surface by a
/// millimetre. Cost: a query a point that is turned to the sun, shared out by `jobs`.
[[nodiscard]] std::vector<std::uint8_t> lit_points(const shadows::ShadowQueries& queries,
                                                   std::span<const SurfacePoint> points,
                                                   const glm::dvec3& towards_sun_plan,
                                                   const shadows::Jobs& jobs = {});

}  // namespace gnomon::sun_study
