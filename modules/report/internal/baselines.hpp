// SPDX-License-Identifier: MIT
//
// Baselines: what people use instead of shadow volumes, as it is usually explained. They are here
// to be compared with and nowhere else.
#pragma once

#include "technique.hpp"

namespace gnomon::report::internal {

enum class MapFilter : std::uint8_t {
    Plain,   ///< a constant bias
    Sloped,  ///< a bias that grows with the surface's slope
    Pcf,     ///< the same, and the majority of 3x3 texels
};

/// After L. Williams, "Casting Curved Shadows on Curved Surfaces" (1978); the filter after
/// W. T. Reeves et al., "Rendering Antialiased Shadows with Depth Maps" (1987), cut at one half.
/// Maps are fitted to what is seen (light_projector.hpp): a directional light gets an orthographic
/// one, a point light one in perspective or else a cube of those of six that are seen, each of
/// `size` texels a side. Casters outside of a map are left out.
[[nodiscard]] Result<std::unique_ptr<Technique>> create_shadow_map(const Setup& setup,
                                                                   std::uint32_t size,
                                                                   MapFilter filter);

/// Casters flattened onto the plane that most receiving area lies in, after J. Blinn, "Me and My
/// (Fake) Shadow" (1988). Nothing else receives shadow.
[[nodiscard]] Result<std::unique_ptr<Technique>> create_planar(const Setup& setup);

/// Two rays a pixel, one to what is seen and one from there to each light, by Embree, on all cores.
/// Search trees are built once: geometry stands still here.
[[nodiscard]] Result<std::unique_ptr<Technique>> create_rays(const Setup& setup);

/// normal.xyz, offset: the plane that holds the largest area of receivers, its normal up or else
/// towards the eye. Empty where there are no receivers.
[[nodiscard]] std::optional<glm::dvec4> main_plane(const scene::Scene& scene,
                                                   const glm::dvec3& eye);

}  // namespace gnomon::report::internal
