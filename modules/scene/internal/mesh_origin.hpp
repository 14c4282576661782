// SPDX-License-Identifier: MIT
//
// Moves meshes that are modelled far from their own origin to around zero, where that is exact.
#pragma once

#include <gnomon/scene/mesh.hpp>
#include <gnomon/scene/scene.hpp>

namespace gnomon::scene::internal {

/// Sets Mesh::origin and subtracts it from every position, on each axis where the mesh's centre
/// lies more than eight diagonals from zero and no position loses a bit by it. Leaves other meshes
/// as they are.
void rebase_far_mesh(Mesh& mesh);

/// An origin near what lies within these bounds, on each axis where their centre is more than eight
/// diagonals from zero; zero on the others, and where the bounds are not finite. For positions that
/// are still double: nothing is lost whatever it is.
[[nodiscard]] glm::dvec3 near_origin(const Bounds& bounds);

}  // namespace gnomon::scene::internal
