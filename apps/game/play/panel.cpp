// SPDX-License-Identifier: MIT
#include "play/panel.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

namespace gnomon::game {

namespace {

constexpr std::array<ui::ChartSeries, 4> time_series{{
    {"rules", {0.45F, 0.80F, 0.50F, 1.0F}},
    {"shadows", {0.96F, 0.74F, 0.30F, 1.0F}},
    {"draw", {0.35F, 0.72F, 0.80F, 1.0F}},
    {"show", {0.45F, 0.50F, 0.62F, 1.0F}},
}};
constexpr std::array<ui::ChartSeries, 1> length_series{{{"frame", {0.70F, 0.76F, 0.86F, 1.0F}}}};

void counter_row(const char* name, const std::string& value) {
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", name);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(value.c_str());
}

void show_counts(const shadows::FrameStats& s) {
    if (!ImGui::BeginTable("counters", 2, ImGuiTableFlags_SizingStretchProp)) return;
    counter_row("casters, lights", fmt::format("{}, {}", s.casters, s.lights));
    counter_row("pairs drawn / of", fmt::format("{} / {}", s.zpass_pairs + s.zfail_pairs, s.pairs));
    counter_row("depth-pass / depth-fail", fmt::format("{} / {}", s.zpass_pairs, s.zfail_pairs));
    counter_row("found anew / kept", fmt::format("{} / {}", s.pairs_redetected, s.pairs_reused));
    counter_row("left out", fmt::format("{}", s.pairs_culled + s.pairs_hidden));
    counter_row("silhouette edges", fmt::format("{}", s.silhouette_edges));
    counter_row("faces tested", fmt::format("{}", s.detection.faces_tested));
    ImGui::EndTable();
}

void show_techniques(DrawingOptions& drawing) {
    using shadows::Technique;
    const auto choice = [&](const char* name, std::optional<Technique> technique) {
        if (ImGui::RadioButton(name, drawing.technique == technique)) drawing.technique = technique;
    };
    choice("cheapest", std::nullopt);
    ImGui::SameLine();
    choice("depth-pass", Technique::DepthPass);
    ImGui::SameLine();
    choice("depth-fail", Technique::DepthFail);
}

}  // namespace

std::array<bool*, 6> overlay_switches(render::Overlays& show) {
    return {&show.volumes, &show.silhouettes, &show.caps, &show.wireframe, &show.count, &show.fill};
}

void PanelState::add_times(const std::array<float, 4>& cpu_ms, float frame_ms) {
    cpu_times.add(cpu_ms);
    frame_lengths.add(std::array{frame_ms});
}

void show_panel(PanelState& state, float unit) {
    if (!state.shown) return;
    const float margin = 12.0F * unit;
    const float width = 420.0F * unit;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({margin, 70.0F * unit});
    ImGui::SetNextWindowSizeConstraints({width, margin}, {width, screen.y - 82.0F * unit});
    ImGui::Begin("shadows", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav);
    const bool gl = state.backend == "gl";
    if (ImGui::RadioButton("OpenGL", gl) && !gl) state.wants_other_backend = true;
    ImGui::SameLine();
    if (ImGui::RadioButton("Vulkan", !gl) && gl) state.wants_other_backend = true;
    ImGui::TextDisabled("%s", state.adapter.c_str());

    ImGui::Spacing();
    ui::draw_chart("cpu", state.cpu_times, time_series, "ms, CPU", 44.0F * unit);
    ImGui::Spacing();
    ui::draw_chart("frames", state.frame_lengths, length_series, "ms, frame to frame",
                   34.0F * unit);

    ImGui::Spacing();
    constexpr std::array names{"1 volumes",   "2 silhouettes", "3 caps",
                               "4 wireframe", "5 count",       "6 fill"};
    const auto switches = overlay_switches(state.drawing.overlays);
    if (ImGui::BeginTable("overlays", 2, ImGuiTableFlags_SizingStretchSame)) {
        for (std::size_t i = 0; i < switches.size(); ++i) {
            ImGui::TableNextColumn();
            ImGui::Checkbox(names[i], switches[i]);
        }
        ImGui::EndTable();
    }
    ImGui::Spacing();
    show_techniques(state.drawing);
    ImGui::Spacing();
    show_counts(state.shadows);
    ImGui::End();
}

}  // namespace gnomon::game
