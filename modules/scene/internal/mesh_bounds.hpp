// SPDX-License-Identifier: MIT
#pragma once

#include <gnomon/scene/scene.hpp>

namespace gnomon::scene::internal {

/// Widens `bounds` by every vertex in world space.
void include_positions(Bounds& bounds, const Geometry& geometry);

}  // namespace gnomon::scene::internal
