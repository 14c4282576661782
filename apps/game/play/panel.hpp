// SPDX-License-Identifier: MIT
//
// The panel: how the game's shadows are made, and what that costs, while it is played.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include <gnomon/render/renderer.hpp>
#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/ui/chart.hpp>

#include "drawing.hpp"

namespace gnomon::game {

struct PanelState {
    bool shown = false;
    DrawingOptions drawing;  ///< overlays and technique are the panel's
    bool wants_other_backend = false;
    std::string backend;
    std::string adapter;

    ui::ChartHistory cpu_times{4, 120};  ///< rules, shadows, drawing, showing
    ui::ChartHistory frame_lengths{1, 120};
    shadows::FrameStats shadows;

    /// Of a frame, in milliseconds: the rules' ticks, silhouettes and volumes, the rest of what is
    /// recorded and submitted, and waiting until it is shown.
    void add_times(const std::array<float, 4>& cpu_ms, float frame_ms);
};

/// Between ui::Context::begin_frame() and end_frame(); nothing where it is not shown.
void show_panel(PanelState& state, float unit);

/// The views of keys 1 to 6, in their order.
[[nodiscard]] std::array<bool*, 6> overlay_switches(render::Overlays& overlays);

}  // namespace gnomon::game
