// SPDX-License-Identifier: MIT
//
// Which lights of a scene cast shadows, where a host will not afford all of them: the few that
// matter most to what is seen. The rest shines without shadow. It judges lights, not their casters.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <gnomon/scene/scene.hpp>
#include <gnomon/shadows/view.hpp>

#pragma GCC visibility push(default)
namespace gnomon::render {

/// The lights of a scene, each in one of two lists, in the order in which ShadowAdapter submits
/// them; those that are off in none.
struct LightChoice {
    std::vector<scene::Entity> shadowed;    ///< those that cast shadows
    std::vector<scene::Entity> unshadowed;  ///< the rest
};

/// At most `most` shadowed lights: those that bring most to where one looks, as H. Y. Kwoon advises
/// ("The Theory of Stencil Shadow Volumes", 2002). Of a light counts the largest illuminance, in
/// lux, luminance of its colour and its range included, at any point of the view's axis within
/// `bounds`, or at the middle of the bounds where the axis misses them; no cone of a spot light. Of
/// equals the earlier one. World transforms are up to date. Cost: linear in the lights.
[[nodiscard]] LightChoice choose_shadowed_lights(const scene::Scene& scene,
                                                 const scene::Bounds& bounds,
                                                 const shadows::View& view, std::size_t most,
                                                 std::span<const scene::Entity> off = {});

}  // namespace gnomon::render
#pragma GCC visibility pop
