// SPDX-License-Identifier: MIT
#pragma once

#include <gnomon/scene/scene.hpp>

namespace gnomon::scene::internal {

/// Widens `bounds` by every vertex of the mesh in world space.
void include_mesh(Bounds& bounds, const WorldTransform& world, const Mesh& mesh);

}  // namespace gnomon::scene::internal
