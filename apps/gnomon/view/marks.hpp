// SPDX-License-Identifier: MIT
//
// What the viewer draws over the scene itself: handles of lights, what is selected, what the probe
// found, scissors and reasons.
#pragma once

#include <glm/glm.hpp>

#include "view/view_state.hpp"

namespace gnomon::cli {

/// Between ui::Context::begin_frame() and end_frame(), behind the panel.
void show_marks(const ViewState& state, const Stage& stage, const shadows::View& view,
                const glm::uvec2& size_px);

}  // namespace gnomon::cli
