// SPDX-License-Identifier: MIT
//
// How a light moves about a mesh from frame to frame, in the mesh's own space.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/light.hpp>

namespace gnomon::bench {

struct Motion {
    enum class Kind : std::uint8_t {
        Static,  ///< nothing moves
        Orbit,   ///< the light goes round the mesh, at three times its radius
        Turn,    ///< the mesh turns and the light stays: the same, but with a pose inverted a frame
        Jump,    ///< the light is somewhere else each frame
    };
    std::string name;  ///< such as "0.01 deg"
    Kind kind = Kind::Static;
    double degrees = 0.0;  ///< a frame
    bool directional = false;
};

/// All that are run: static, five speeds, a turning mesh and jumps, for both kinds of light.
/// `quick`: three of them.
[[nodiscard]] std::vector<Motion> motions(bool quick);

struct Sphere {
    glm::dvec3 center{0.0};
    double radius = 1.0;
};

/// The same arguments, the same light.
[[nodiscard]] shadows::LightLocal light_of(const Motion& motion, const Sphere& about,
                                           std::uint64_t frame);

}  // namespace gnomon::bench
