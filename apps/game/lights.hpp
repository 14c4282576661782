// SPDX-License-Identifier: MIT
//
// How bright a point is under a light of the scene, by the renderer's own law of attenuation: what
// is dark in the picture is dark for the meter. Shadows are asked for elsewhere (exposure.hpp).
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include <gnomon/scene/scene.hpp>
#include <gnomon/shadows/light.hpp>

namespace gnomon::game {

/// A light as the meter asks about it: as it stands now.
struct MeterLight {
    shadows::Light shadow;
    double intensity = 0.0;           ///< candela, or lux of a directional one
    glm::dvec3 axis{0.0, -1.0, 0.0};  ///< unit; the way a spot looks
    double cos_inner = -1.0;
    double cos_outer = -2.0;  ///< below -1: no spot
};

/// Every light of the scene, in the order of creation within its kind. World transforms are up to
/// date.
[[nodiscard]] std::vector<MeterLight> meter_lights(const scene::Scene& scene);

/// Lux on a surface at `point` that faces the light, as if nothing stood between.
[[nodiscard]] double illuminance(const MeterLight& light, const glm::dvec3& point);

}  // namespace gnomon::game
