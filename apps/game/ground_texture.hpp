// SPDX-License-Identifier: MIT
//
// The ground's picture: flagstones where the level is, bare earth around it. Made by the program,
// the same in every run.
#pragma once

#include <memory>

#include <gnomon/scene/mesh.hpp>

#include "level.hpp"

namespace gnomon::game {

/// Of a ground that is larger than the level's by `border_m` on each side.
[[nodiscard]] std::shared_ptr<const scene::Image> make_ground_image(const Level& level,
                                                                    double border_m);

}  // namespace gnomon::game
