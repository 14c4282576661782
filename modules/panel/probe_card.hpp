// SPDX-License-Identifier: MIT
//
// The card beside the mouse that shows what the probe found.
#pragma once

#include <span>

#include <glm/glm.hpp>

#include <gnomon/panel/lights.hpp>
#include <gnomon/panel/probe.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/shadows/view.hpp>

namespace gnomon::panel {

/// What the card is drawn with.
struct ProbeCard {
    const shadows::View& view;
    glm::uvec2 size_px{0};
    glm::dvec2 cursor_px{0.0};
    const scene::Bounds& bounds;  ///< of the scene: how finely places are told
    std::span<const LightLine> lights;
};
/// The card, and lines to the lights in the background. Between ui::Context::begin_frame() and
/// end_frame().
void show_probe(const Probe& probe, const scene::Registry& registry, const ProbeCard& card);

}  // namespace gnomon::panel
