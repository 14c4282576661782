// SPDX-License-Identifier: MIT
//
// VolumeSlab: a part of a volume that is drawn in place of the whole. After D. B. Lloyd et al., "CC
// Shadow Volumes" (2004).
#pragma once

#include <glm/glm.hpp>

#include <gnomon/shadows/screen_bounds.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// What of a volume lies between two planes across the light's way, or the caster and a plane.
/// Closed like the volume, by the same triangles.
struct VolumeSlab {
    /// Takes the near vertices to the world, homogeneous: the caster's own pose, or onto a plane.
    glm::dmat4 world_from_near{1.0};
    /// VolumeDraw::world_from_far in its place.
    glm::dmat4 world_from_far{1.0};
    bool from_plane = false;  ///< near caps lie on a plane, where no surface is
    bool near_caps = true;    ///< depth-pass: whether near caps must be drawn as well
    bool far_caps = true;     ///< whether far caps must be drawn
    ScreenBounds bounds;      ///< VolumeDraw::bounds in its place; not empty
    bool operator==(const VolumeSlab&) const = default;
};

}  // namespace gnomon::shadows
#pragma GCC visibility pop
