// SPDX-License-Identifier: MIT
//
// The lights of a scene as a panel has them: a name, whether it shines, whether it casts shadows.
// Switching one changes nothing in the scene; whoever draws leaves out what is off.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/scene/scene.hpp>

namespace gnomon::panel {

struct LightLine {
    scene::Entity entity;
    std::string name;
    bool on = true;
    bool casts = true;
};

/// Suns first, then lamps, then spot lights, each in the order of their creation. What has no name
/// is called "sun" or "lamp", and so is what is called `nameless`; of equal names all but the first
/// get a number.
[[nodiscard]] std::vector<LightLine> lights_of(const scene::Scene& scene,
                                               std::string_view nameless = {});

/// What a frame does with the lights that are not as the scene has them.
struct SwitchedLights {
    std::vector<scene::Entity> off;
    std::vector<scene::Entity> unshadowed;  ///< FrameInput::unshadowed: on, and through everything
    bool operator==(const SwitchedLights&) const = default;
};
[[nodiscard]] SwitchedLights switched(std::span<const LightLine> lights);

[[nodiscard]] bool is_directional(const scene::Registry& registry, scene::Entity light);
/// Linear, as the scene has it.
[[nodiscard]] glm::vec3 color_of_light(const scene::Registry& registry, scene::Entity light);
/// Where it is; of a directional light, a point towards which it stands, outside of `bounds`. Its
/// world transform is up to date.
[[nodiscard]] glm::dvec3 handle_of(const scene::Registry& registry, scene::Entity light,
                                   const scene::Bounds& bounds);

}  // namespace gnomon::panel
