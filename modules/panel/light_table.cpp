// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <gnomon/panel/light_table.hpp>
#include <gnomon/ui/context.hpp>

namespace gnomon::panel {

std::optional<std::size_t> show_lights(std::span<LightLine> lights,
                                       std::optional<std::size_t> selected) {
    constexpr std::size_t most_rows = 8;
    const bool scrolls = lights.size() > most_rows;
    const float height =
        scrolls ? static_cast<float>(most_rows) * ImGui::GetFrameHeightWithSpacing() : 0.0F;
    const ImGuiTableFlags flags =
        ImGuiTableFlags_SizingFixedFit | (scrolls ? ImGuiTableFlags_ScrollY : 0);
    std::optional<std::size_t> clicked;
    if (!ImGui::BeginTable("lights", 3, flags, {0.0F, height})) return clicked;
    const glm::vec4 accent = ui::palette().accent;
    ImGui::PushStyleColor(ImGuiCol_Header, {accent.r, accent.g, accent.b, 0.30F});
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        LightLine& light = lights[i];
        ImGui::PushID(static_cast<int>(i));
        ImGui::TableNextColumn();
        ImGui::AlignTextToFramePadding();
        if (ImGui::Selectable(light.name.c_str(), selected == i)) clicked = i;
        ImGui::TableNextColumn();
        ImGui::Checkbox("on", &light.on);
        ImGui::TableNextColumn();
        ImGui::BeginDisabled(!light.on);
        ImGui::Checkbox("shadow", &light.casts);
        ImGui::EndDisabled();
        ImGui::PopID();
    }
    ImGui::PopStyleColor();
    ImGui::EndTable();
    return clicked;
}

}  // namespace gnomon::panel
