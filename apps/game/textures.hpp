// SPDX-License-Identifier: MIT
//
// Textures, made by the program, the same in every run: the ground's flagstones, and grains that
// make surfaces of one colour look like brick, wood or sheet metal.
#pragma once

#include <cstdint>
#include <memory>

#include <gnomon/scene/mesh.hpp>

#include "level.hpp"

namespace gnomon::game {

/// Of a ground that is larger than the level's by `border_m` on each side: flagstones where the
/// level is, the mood's `outside` around it.
[[nodiscard]] std::shared_ptr<const scene::Image> make_ground_image(const Level& level,
                                                                    double border_m);

enum class Grain : std::uint8_t { Bricks, Planks, Ribs };

/// Grey; a tile of `grain_tile_m` a side that continues on all sides.
[[nodiscard]] std::shared_ptr<const scene::Image> make_grain_image(Grain grain);

inline constexpr double grain_tile_m = 2.0;

/// Gives a mesh texture coordinates by its vertices' places, in tiles, each from the side that its
/// normal looks to most.
void lay_tiles(scene::Mesh& mesh);

}  // namespace gnomon::game
