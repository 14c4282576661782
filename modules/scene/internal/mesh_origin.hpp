// SPDX-License-Identifier: MIT
//
// Moves meshes that are modelled far from their own origin to around zero, where that is exact.
#pragma once

#include <gnomon/scene/mesh.hpp>

namespace gnomon::scene::internal {

/// Sets Mesh::origin and subtracts it from every position, on each axis where the mesh's centre
/// lies more than eight diagonals from zero and no position loses a bit by it. Leaves other meshes
/// as they are.
void rebase_far_mesh(Mesh& mesh);

}  // namespace gnomon::scene::internal
