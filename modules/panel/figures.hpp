// SPDX-License-Identifier: MIT
//
// What a frame's shadows were, and cost: counters, charts, and the reasons for which volumes were
// made, as colours. Each between ui::Context::begin_frame() and end_frame().
#pragma once

#include <cstdint>
#include <string>

#include <glm/glm.hpp>

#include <gnomon/panel/choices.hpp>
#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/ui/chart.hpp>

namespace gnomon::panel {

/// Of one frame.
struct Counters {
    const shadows::FrameStats& shadows;
    std::uint64_t upload_bytes = 0;
    std::uint64_t draw_calls = 0;
};
/// A table; below it the reasons of this frame's volumes, in their colours, where they are asked
/// for or anything was found anew.
void show_counters(const Counters& counters, bool reasons);

/// Detecting, building and recording a frame's shadows, as a history of three series has it.
void show_shadow_times(const ui::ChartHistory& history, float height_px);

/// A pair's reason as a colour: nothing to do is green, work is warm, no volume is grey.
[[nodiscard]] glm::vec4 color_of(shadows::Reason reason);

/// In the background: what each volume of the list is cut to, in its reason's colour where reasons
/// are wanted.
void show_bounds(const Marks& marks, const shadows::DrawList& list, const glm::uvec2& size_px);

/// 1,234,567
[[nodiscard]] std::string with_thousands(std::uint64_t number);

}  // namespace gnomon::panel
