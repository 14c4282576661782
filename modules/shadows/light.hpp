// SPDX-License-Identifier: MIT
//
// Lights as shadows see them: a point, or a direction. A spot light is a point light here: its cone
// dims light, it moves no shadow.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/glm.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// A light of the scene, in world space.
struct Light {
    std::uint64_t key = 0;  ///< the host's name for it; unique among lights
    /// (x, y, z, 1): a point in metres. (x, y, z, 0): a direction *towards* an infinitely distant
    /// light, any length.
    glm::dvec4 position_world{0.0, 1.0, 0.0, 0.0};
    std::optional<double> range_m =
        std::nullopt;  ///< it lights nothing beyond; casters beyond it are left out
};

/// A light in a caster's own space, rounded once to single precision: the value that the shader
/// receives. Facing, extrusion and queries all use it, so that they cannot disagree. w is 1 or 0 as
/// above.
struct LightLocal {
    glm::vec4 position{0.0F, 1.0F, 0.0F, 0.0F};  ///< (x, y, z, 1) or (x, y, z, 0)

    /// Whether it is infinitely far away.
    [[nodiscard]] bool is_directional() const { return position.w == 0.0F; }
    bool operator==(const LightLocal&) const = default;
};

}  // namespace gnomon::shadows
#pragma GCC visibility pop
