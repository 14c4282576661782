// SPDX-License-Identifier: MIT
//
// What a panel lets one choose about how shadows are made and what is drawn of that. Each between
// ui::Context::begin_frame() and end_frame(), within a window of Dear ImGui.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include <gnomon/render/renderer.hpp>
#include <gnomon/shadows/shadow_system.hpp>

namespace gnomon::panel {

/// A part that can be shut; true where it is open.
[[nodiscard]] bool section(const char* name, bool open = true);

/// One of some names; true where `chosen` changed.
bool choose(const char* label, std::span<const std::string> names, int& chosen);

/// The debug views of keys 1 to 6, in their order.
[[nodiscard]] std::array<bool*, 6> overlay_switches(render::Overlays& overlays);

/// What is drawn over the picture, which the renderer knows nothing of.
struct Marks {
    bool scissors = false;  ///< what each volume is cut to
    bool reasons = false;   ///< why each volume was made or kept
    bool probe = true;      ///< what the queries say of the point under the mouse
};
/// A switch among those of show_views(), with what it does.
void view_switch(const char* name, bool& on, const char* what);
/// A table of all of them; `more` adds switches of the program's own. `probe_key`: where
/// there is one.
void show_views(render::Overlays& overlays, Marks& marks, const char* probe_key,
                const std::function<void()>& more = {});

/// None: whichever is cheaper. True where it changed.
bool choose_technique(std::optional<shadows::Technique>& technique);
/// A name from shadows::silhouette_strategies(), or "auto"; true where it changed.
bool choose_strategy(std::string& strategy);

}  // namespace gnomon::panel
