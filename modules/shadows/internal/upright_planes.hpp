// SPDX-License-Identifier: MIT
//
// A bound of the layers of a volume from one sheaf of planes through the light, in single precision
// and many edges at a time: what coarse_layer_bound() tries first.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <glm/glm.hpp>

#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>

namespace gnomon::shadows::internal {

/// The sides' indices, as Volume has them: `stride` for each, the later near vertex first.
struct SideIndices {
    std::span<const std::uint32_t> indices;
    std::size_t stride = 6;
};

/// No point lies under more layers than this. The planes have one of the space's axes in common, or
/// its direction, so that two coordinates of each vertex say where it is. A plane's picture is a
/// line; one that passes a point which the boundary winds round n times crosses it 2 n times or
/// more. Planes are binned; all that may cross any of a bin counts. Nothing where the light is so
/// near, or the mesh so small from there, that single precision says too little. Cost: some
/// nanoseconds a side.
[[nodiscard]] std::optional<std::uint32_t> bound_by_upright_planes(const ShadowMesh& mesh,
                                                                   LightLocal light,
                                                                   const SideIndices& sides);
/// The same bound one by one: what processors do that cannot gather.
[[nodiscard]] std::optional<std::uint32_t> bound_by_upright_planes_plain(const ShadowMesh& mesh,
                                                                         LightLocal light,
                                                                         const SideIndices& sides);

}  // namespace gnomon::shadows::internal
