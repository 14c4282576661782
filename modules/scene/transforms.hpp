// SPDX-License-Identifier: MIT
#pragma once

#include <gnomon/scene/scene.hpp>

#pragma GCC visibility push(default)
namespace gnomon::scene {

/// Writes WorldTransform of every entity that has a LocalTransform: parents first, whatever the
/// order of creation. A parent that is gone or has no LocalTransform counts as the world. A cycle
/// of parents is a caller's bug (readers refuse one). Cost: linear in the number of nodes.
void update_world_transforms(Registry& registry);

}  // namespace gnomon::scene
#pragma GCC visibility pop
