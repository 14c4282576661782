// SPDX-License-Identifier: MIT
#include "play/panel.hpp"

#include <algorithm>

#include <imgui.h>
#include <gnomon/panel/figures.hpp>
#include <gnomon/panel/light_table.hpp>

namespace gnomon::game {

namespace {

constexpr std::array<ui::ChartSeries, 4> time_series{{
    {"rules", {0.45F, 0.80F, 0.50F, 1.0F}},
    {"shadows", {0.96F, 0.74F, 0.30F, 1.0F}},
    {"draw", {0.35F, 0.72F, 0.80F, 1.0F}},
    {"show", {0.45F, 0.50F, 0.62F, 1.0F}},
}};
constexpr std::array<ui::ChartSeries, 1> length_series{{{"frame", {0.70F, 0.76F, 0.86F, 1.0F}}}};

float number(double value) { return static_cast<float>(std::max(value, 0.0)); }

void show_backends(PanelState& state) {
    const bool gl = state.backend == "gl";
    if (ImGui::RadioButton("OpenGL", gl) && !gl) state.wants_other_backend = true;
    ImGui::SameLine();
    if (ImGui::RadioButton("Vulkan", !gl) && gl) state.wants_other_backend = true;
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("%s", state.adapter.c_str());
    ImGui::PopStyleColor();
}

void show_times(const PanelState& state, float unit) {
    if (!panel::section("Times")) return;
    panel::show_shadow_times(state.shadow_times, 34.0F * unit);
    ImGui::Spacing();
    ui::draw_chart("cpu", state.cpu_times, time_series, "ms, CPU", 34.0F * unit);
    ImGui::Spacing();
    ui::draw_chart("frames", state.frame_lengths, length_series, "ms, frame to frame",
                   26.0F * unit);
}

}  // namespace

void PanelState::add_figures(const Drawing& drawn) {
    shadows = drawn.shadow_stats();
    uploaded_bytes = drawn.uploaded_bytes();
    draw_calls = drawn.draw_calls();
    shadow_times.add(std::array{number(shadows.detect_ms), number(shadows.build_ms),
                                number(drawn.renderer().times().record_ms)});
}

void PanelState::add_times(const std::array<float, 4>& cpu_ms, float frame_ms) {
    cpu_times.add(cpu_ms);
    frame_lengths.add(std::array{frame_ms});
}

void PanelState::forget_times() {
    shadow_times.clear();
    cpu_times.clear();
    frame_lengths.clear();
}

void show_panel(PanelState& state, float unit) {
    if (!state.shown) return;
    const float margin = 12.0F * unit;
    const float width = 400.0F * unit;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    // At the right: menus are at the left, or in the middle.
    ImGui::SetNextWindowPos({screen.x - margin - width, 70.0F * unit});
    ImGui::SetNextWindowSizeConstraints({width, margin}, {width, screen.y - 82.0F * unit});
    ImGui::Begin("shadows", nullptr,
                 // Where it is too high for the window it scrolls by the wheel.
                 ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoTitleBar |
                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav);
    show_backends(state);
    show_times(state, unit);
    if (panel::section("Show")) {
        panel::show_views(state.drawing.overlays, state.marks, nullptr);
    }
    if (panel::section("Shadows")) {
        panel::choose_technique(state.drawing.technique);
        panel::choose_strategy(state.drawing.silhouette);
    }
    if (panel::section("Lights")) {
        panel::show_lights(state.lights);
        ImGui::TextDisabled("In the picture: who looks for you has all.");
    }
    if (panel::section("Counters", false)) {
        panel::show_counters({.shadows = state.shadows,
                              .upload_bytes = state.uploaded_bytes,
                              .draw_calls = state.draw_calls},
                             state.marks.reasons);
    }
    ImGui::End();
}

}  // namespace gnomon::game
