// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vector>

#include <imgui.h>

#include <gnomon/panel/choices.hpp>
#include <gnomon/shadows/detector.hpp>

namespace gnomon::panel {

bool section(const char* name, bool open) {
    ImGui::Spacing();
    return ImGui::CollapsingHeader(name, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

bool choose(const char* label, std::span<const std::string> names, int& chosen) {
    bool changed = false;
    const auto text = [&](int i) { return names[static_cast<std::size_t>(i)].c_str(); };
    ImGui::SetNextItemWidth(-ImGui::CalcTextSize("silhouettes  ").x);
    if (!ImGui::BeginCombo(label, text(chosen), ImGuiComboFlags_HeightLarge)) return false;
    for (int i = 0; i < static_cast<int>(names.size()); ++i) {
        ImGui::PushID(i);  // names may be equal
        if (ImGui::Selectable(text(i), i == chosen) && i != chosen) {
            chosen = i;
            changed = true;
        }
        ImGui::PopID();
    }
    ImGui::EndCombo();
    return changed;
}

std::array<bool*, 6> overlay_switches(render::Overlays& show) {
    return {&show.volumes, &show.silhouettes, &show.caps, &show.wireframe, &show.count, &show.fill};
}

void view_switch(const char* name, bool& on, const char* what) {
    ImGui::TableNextColumn();
    ImGui::Checkbox(name, &on);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", what);
}

void show_views(render::Overlays& overlays, Marks& marks, const char* probe_key,
                const std::function<void()>& more) {
    if (!ImGui::BeginTable("overlays", 2, ImGuiTableFlags_SizingStretchSame)) return;
    view_switch("volumes", overlays.volumes, "The volumes' sides (1)");
    view_switch("silhouettes", overlays.silhouettes, "Silhouette edges (2)");
    view_switch("caps", overlays.caps, "Near caps (3)");
    view_switch("wireframe", overlays.wireframe, "All triangles (4)");
    view_switch("count", overlays.count, "The stencil count as a heat map (5)");
    view_switch("fill", overlays.fill, "Stencil fragments as a heat map of powers of two (6)");
    view_switch("scissors", marks.scissors, "What each volume is cut to");
    view_switch("reasons", marks.reasons, "Why each volume was made or kept, as colours");
    std::string about = "What the shadow queries say of the point under the mouse";
    if (probe_key != nullptr) about += std::string(" (") + probe_key + ")";
    view_switch("probe", marks.probe, about.c_str());
    if (more) more();
    ImGui::EndTable();
}

bool choose_technique(std::optional<shadows::Technique>& technique) {
    static const std::vector<std::string> names{"auto", "depth-pass", "depth-fail"};
    int chosen = technique ? static_cast<int>(*technique) + 1 : 0;
    if (!choose("technique", names, chosen)) return false;
    technique =
        chosen == 0 ? std::nullopt : std::optional(static_cast<shadows::Technique>(chosen - 1));
    return true;
}

bool choose_strategy(std::string& strategy) {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all{std::string(shadows::automatic_strategy().name)};
        for (const auto& s : shadows::silhouette_strategies()) all.emplace_back(s.name);
        return all;
    }();
    const auto found = std::ranges::find(names, strategy);
    int chosen = found == names.end() ? 0 : static_cast<int>(found - names.begin());
    if (!choose("silhouettes", names, chosen)) return false;
    strategy = names[static_cast<std::size_t>(chosen)];
    return true;
}

}  // namespace gnomon::panel
