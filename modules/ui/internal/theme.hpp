// SPDX-License-Identifier: MIT
#pragma once

namespace gnomon::ui::internal {

/// Colours, rounding and spacing of the current Dear ImGui context, for a font of this size.
void apply_theme(float font_px);

}  // namespace gnomon::ui::internal
