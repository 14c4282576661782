// SPDX-License-Identifier: MIT
#include "internal/theme.hpp"

#include <imgui.h>

#include <gnomon/ui/context.hpp>

namespace gnomon::ui {

namespace {

ImVec4 with_alpha(const glm::vec4& color, float alpha) {
    return {color.r, color.g, color.b, alpha};
}

}  // namespace

Palette palette() { return {}; }

void internal::apply_theme(float font_px) {
    ImGuiStyle& style = ImGui::GetStyle();
    ImGui::StyleColorsDark(&style);
    const float unit = font_px / 16.0F;
    style.WindowPadding = {12.0F * unit, 10.0F * unit};
    style.FramePadding = {8.0F * unit, 3.0F * unit};
    style.ItemSpacing = {8.0F * unit, 5.0F * unit};
    style.ItemInnerSpacing = {6.0F * unit, 4.0F * unit};
    style.IndentSpacing = 14.0F * unit;
    style.ScrollbarSize = 10.0F * unit;
    style.GrabMinSize = 9.0F * unit;
    style.WindowRounding = 8.0F;
    style.FrameRounding = 4.0F;
    style.PopupRounding = 6.0F;
    style.GrabRounding = 4.0F;
    style.ScrollbarRounding = 5.0F;
    style.WindowBorderSize = 0.0F;
    style.PopupBorderSize = 0.0F;
    style.WindowTitleAlign = {0.0F, 0.5F};
    style.WindowMenuButtonPosition = ImGuiDir_None;

    const glm::vec4 accent = palette().accent;
    const ImVec4 field{0.20F, 0.22F, 0.26F, 1.0F};
    const ImVec4 field_hovered{0.27F, 0.30F, 0.35F, 1.0F};
    const ImVec4 field_active{0.33F, 0.36F, 0.42F, 1.0F};
    ImVec4* colors = style.Colors;
    colors[ImGuiCol_Text] = {0.90F, 0.92F, 0.94F, 1.0F};
    colors[ImGuiCol_TextDisabled] = with_alpha(palette().dim, 1.0F);
    colors[ImGuiCol_WindowBg] = {0.085F, 0.095F, 0.115F, 0.90F};
    colors[ImGuiCol_PopupBg] = {0.11F, 0.12F, 0.145F, 0.97F};
    colors[ImGuiCol_TitleBg] = {0.085F, 0.095F, 0.115F, 0.90F};
    colors[ImGuiCol_TitleBgActive] = {0.085F, 0.095F, 0.115F, 0.90F};
    colors[ImGuiCol_TitleBgCollapsed] = {0.085F, 0.095F, 0.115F, 0.75F};
    colors[ImGuiCol_FrameBg] = field;
    colors[ImGuiCol_FrameBgHovered] = field_hovered;
    colors[ImGuiCol_FrameBgActive] = field_active;
    colors[ImGuiCol_Button] = field;
    colors[ImGuiCol_ButtonHovered] = field_hovered;
    colors[ImGuiCol_ButtonActive] = with_alpha(accent, 0.55F);
    colors[ImGuiCol_Header] = {0.16F, 0.175F, 0.205F, 1.0F};
    colors[ImGuiCol_HeaderHovered] = field_hovered;
    colors[ImGuiCol_HeaderActive] = field_active;
    colors[ImGuiCol_CheckMark] = with_alpha(accent, 1.0F);
    colors[ImGuiCol_SliderGrab] = with_alpha(accent, 0.85F);
    colors[ImGuiCol_SliderGrabActive] = with_alpha(accent, 1.0F);
    colors[ImGuiCol_Separator] = {0.30F, 0.33F, 0.38F, 0.6F};
    colors[ImGuiCol_ScrollbarBg] = {0.0F, 0.0F, 0.0F, 0.0F};
    colors[ImGuiCol_ScrollbarGrab] = field_hovered;
    colors[ImGuiCol_ResizeGrip] = {0.0F, 0.0F, 0.0F, 0.0F};
    colors[ImGuiCol_ResizeGripHovered] = field_hovered;
    colors[ImGuiCol_ResizeGripActive] = field_active;
    colors[ImGuiCol_TextSelectedBg] = with_alpha(accent, 0.35F);
    colors[ImGuiCol_NavHighlight] = with_alpha(accent, 0.8F);
}

}  // namespace gnomon::ui
