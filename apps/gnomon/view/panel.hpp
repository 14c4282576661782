// SPDX-License-Identifier: MIT
//
// The viewer's panel, made of Dear ImGui's widgets.
#pragma once

#include <gnomon/core/result.hpp>

#include "view/view_state.hpp"

namespace gnomon::cli {

/// Pixels that the panel takes from the left, its margin included; 0 where it is hidden.
[[nodiscard]] double panel_width_px(const ViewState& state);

/// Between ui::Context::begin_frame() and end_frame(). Changes the stage and the state as its user
/// wants. Fails where an animation cannot be played at a time.
[[nodiscard]] Status show_panel(ViewState& state, Stage& stage);

}  // namespace gnomon::cli
