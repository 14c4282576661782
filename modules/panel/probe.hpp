// SPDX-License-Identifier: MIT
//
// The probe: what the shadow queries say of the point under the mouse, light by light.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/panel/lights.hpp>
#include <gnomon/panel/picker.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/shadows/shadow_query.hpp>

namespace gnomon::panel {

struct Probe {
    Hit hit;
    struct Answer {
        std::size_t light = 0;  ///< place among the lights that were asked about
        shadows::Exposure exposure = shadows::Exposure::Lit;
        bool faces_away = false;     ///< the surface is turned away: no direct light in any case
        std::uint32_t surfaces = 0;  ///< between the point and the light
    };
    std::vector<Answer> answers;
};

/// Of the lights that are on. One that casts no shadow, by itself or because `unshadowed` has it,
/// lights whatever it reaches. Asked on the side of the surface that is seen, a millionth of
/// `size_m` above it: more than rounding does to a point of the picture's. The queries hold the
/// casters as they stand, and world transforms are up to date.
[[nodiscard]] Probe probe_at(const Hit& hit, const scene::Registry& registry,
                             const shadows::ShadowQueries& queries,
                             std::span<const LightLine> lights,
                             std::span<const scene::Entity> unshadowed, double size_m);

}  // namespace gnomon::panel
