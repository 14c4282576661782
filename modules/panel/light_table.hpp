// SPDX-License-Identifier: MIT
//
// The lights of a scene with their switches, as a table. Between ui::Context::begin_frame() and
// end_frame(), within a window of Dear ImGui.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <gnomon/panel/lights.hpp>

namespace gnomon::panel {

/// Those of many scroll. `selected` is lit up. Returns the one
/// whose name was clicked.
std::optional<std::size_t> show_lights(std::span<LightLine> lights,
                                       std::optional<std::size_t> selected = std::nullopt);

}  // namespace gnomon::panel
