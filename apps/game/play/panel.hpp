// SPDX-License-Identifier: MIT
//
// The panel: how the game's shadows are made, and what that costs, while it is played.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gnomon/panel/choices.hpp>
#include <gnomon/panel/lights.hpp>
#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/ui/chart.hpp>

#include "drawing.hpp"

namespace gnomon::game {

struct PanelState {
    bool shown = false;
    /// Overlays, technique and strategy are the panel's, and so is which lights are off.
    DrawingOptions drawing;
    panel::Marks marks;
    std::vector<panel::LightLine> lights;  ///< of the level that is drawn
    bool wants_other_backend = false;
    std::string backend;
    std::string adapter;

    ui::ChartHistory shadow_times{3, 120};  ///< detecting, building, recording
    ui::ChartHistory cpu_times{4, 120};     ///< rules, shadows, drawing, showing
    ui::ChartHistory frame_lengths{1, 120};
    shadows::FrameStats shadows;
    std::uint64_t uploaded_bytes = 0;
    std::uint64_t draw_calls = 0;

    /// Of the frame that was drawn last.
    void add_figures(const Drawing& drawn);
    /// Of a frame, in milliseconds: the rules' ticks, silhouettes and volumes, the rest of what is
    /// recorded and submitted, and waiting until it is shown.
    void add_times(const std::array<float, 4>& cpu_ms, float frame_ms);
    /// What was measured belongs to another device.
    void forget_times();
};

/// Between ui::Context::begin_frame() and end_frame(); nothing where it is not shown.
void show_panel(PanelState& state, float unit);

}  // namespace gnomon::game
